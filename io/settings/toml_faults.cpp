// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/settings/toml_faults.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/settings/toml_nesting.hpp"

namespace treadmark::io {
namespace {

constexpr std::string_view kDigits = "0123456789", kBlanks = " \t\r";
constexpr std::size_t kLongestQuoted = 80;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_bare(char c) { return is_digit(c) || is_letter(c) || c == '_' || c == '-'; }

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view shown(std::string_view text) { return text.substr(0, kLongestQuoted); }

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

/// A text in quotes, with slashes, which every system takes, in place of backslashes.
std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : without_blanks(text))
    if (c != '"') out += c == '\\' ? '/' : c;
  return out + '"';
}

/// Characters that stand for others of ASCII in what word processors and web pages make of a text.
struct LookAlike {
  std::string_view bytes, name;
  char meant;
};
constexpr LookAlike kLookAlikes[] = {{"\u2212", "a minus sign (U+2212)", '-'},
                                     {"\u2013", "a dash (U+2013)", '-'},
                                     {"\u2014", "a dash (U+2014)", '-'},
                                     {"\u2010", "a hyphen (U+2010)", '-'},
                                     {"\u2011", "a hyphen (U+2011)", '-'},
                                     {"\u201c", "a typographic quote", '"'},
                                     {"\u201d", "a typographic quote", '"'},
                                     {"\u201e", "a typographic quote", '"'},
                                     {"\u00ab", "a typographic quote", '"'},
                                     {"\u00bb", "a typographic quote", '"'},
                                     {"\u2018", "a typographic quote", '\''},
                                     {"\u2019", "a typographic quote", '\''},
                                     {"\u201a", "a typographic quote", '\''},
                                     {"\u00a0", "an invisible no-break space (U+00A0)", ' '},
                                     {"\u202f", "an invisible no-break space (U+202F)", ' '},
                                     {"\u2009", "an invisible thin space (U+2009)", ' '},
                                     {"\u3000", "a wide space (U+3000)", ' '},
                                     {"\u200b", "an invisible character (U+200B)", ' '},
                                     {"\ufeff", "an invisible byte order mark (U+FEFF)", ' '},
                                     {"\uff1d", "a wide equals sign (U+FF1D)", '='}};

const LookAlike* look_alike_at(std::string_view text) {
  const auto* found = ranges::find_if(kLookAlikes, [&](const LookAlike& one) { return text.starts_with(one.bytes); });
  return found == std::end(kLookAlikes) ? nullptr : found;
}

/// The text with what was meant in place of all look-alikes.
std::string plain_characters(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    if (const LookAlike* one = look_alike_at(text.substr(at))) {
      out += one->meant;
      at += one->bytes.size();
    } else {
      out += text[at++];
    }
  }
  return out;
}

/// Digits with separators: a number as people write it, as far as it goes.
struct WrittenNumber {
  std::string sign, digits;  ///< digits: with all separators
  std::string exponent;      ///< with its letter
  std::string_view rest;     ///< behind it
};

std::optional<WrittenNumber> written_number(std::string_view text) {
  WrittenNumber number;
  std::size_t at = 0;
  while (at < text.size() && (text[at] == '+' || text[at] == '-')) number.sign += text[at++];
  const auto digit_at = [&](std::size_t i) { return i < text.size() && is_digit(text[i]); };
  bool any = false;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    const bool separates = (c == '.' || ((c == ',' || c == '\'' || c == '_') && digit_at(at + 1) && any)) ||
                           (c == ' ' && any && digit_at(at + 1));
    if (!is_digit(c) && !separates) break;
    any = any || is_digit(c);
    number.digits += c;
  }
  if (!any) return std::nullopt;
  if (at < text.size() && std::string_view("eEdD").find(text[at]) != std::string_view::npos) {
    std::size_t end = at + 1;
    if (end < text.size() && (text[end] == '+' || text[end] == '-')) ++end;
    if (digit_at(end)) {
      while (digit_at(end)) ++end;
      number.exponent = text.substr(at, end - at);
      at = end;
    }
  }
  number.rest = without_blanks(text.substr(at));
  return number;
}

/// Whether a mark stands between groups of three digits only.
bool groups_of_three(std::string_view digits, char mark) {
  const std::size_t first = digits.find(mark);
  if (first == 0 || first > 3) return false;
  std::size_t at = first;
  while (at != std::string_view::npos) {
    const std::size_t next = digits.find(mark, at + 1);
    if ((next == std::string_view::npos ? digits.size() : next) - at - 1 != 3) return false;
    at = next;
  }
  return true;
}

std::string without(std::string_view text, std::string_view characters) {
  std::string out;
  for (const char c : text)
    if (characters.find(c) == std::string_view::npos) out += c;
  return out;
}

/// Digits on both sides of a point, none too many.
std::string regular(std::string digits, const std::string& exponent) {
  const std::size_t point = digits.find('.');
  if (point == 0) digits.insert(0, "0");
  if (digits.back() == '.') digits += '0';
  const std::size_t first = digits.find_first_not_of('0');
  if (first == std::string::npos && digits.size() > 1)
    digits = "0";
  else if (first != std::string::npos && first > 0)
    digits.erase(0, digits[first] == '.' ? first - 1 : first);
  return digits + (exponent.empty() ? "" : 'e' + exponent.substr(1));
}

/// The number without what is wrong within it, which message says; empty message: nothing is.
std::string mended(const WrittenNumber& n, std::string& message, std::string& other) {
  const std::string& d = n.digits;
  const auto count = [&](char c) { return ranges::count(d, c); };
  std::string digits = d;
  if (count(',') > 0 && count('.') > 0) {
    const bool decimal_comma = d.rfind(',') > d.rfind('.');
    message = decimal_comma ? "decimals are separated by a point" : "thousands are not separated";
    digits = without(d, decimal_comma ? "._' " : ",_' ");
    ranges::replace(digits, ',', '.');
  } else if (count(',') > 1 || (count(',') == 1 && groups_of_three(d, ',') && d[0] != '0')) {
    message = "thousands are not separated, and decimals are separated by a point";
    digits = without(d, ",_' ");
    if (count(',') == 1)
      other = ", or " + regular(without(d.substr(0, d.find(',')), "_' ") + '.' + d.substr(d.find(',') + 1), n.exponent);
  } else if (count(',') == 1) {
    message = "decimals are separated by a point";
    digits = without(d, "_' ");
    ranges::replace(digits, ',', '.');
  } else if (count('.') > 1) {
    if (!groups_of_three(d, '.')) {
      message = "it has more than one point";
      return {};
    }
    message = "thousands are not separated";
    digits = without(d, "._' ");
  } else if (count('\'') + count(' ') > 0) {
    if (!groups_of_three(d.substr(0, d.find('.')), count(' ') > 0 ? ' ' : '\'')) {
      message = "values are separated by commas, in a list in square brackets";
      std::string list = d;
      for (std::size_t at = 0; (at = list.find_first_of(" '", at)) != std::string::npos; at += 2)
        list.replace(at, 1, ", ");
      return '[' + list + ']';
    }
    message = "thousands are not separated";
    digits = without(d, "' ");
  } else if (d.front() == '.' || d.back() == '.') {
    message = "a digit must stand before and behind the point";
  } else if (d.size() > 1 && d[0] == '0' && is_digit(d[1])) {
    message = "numbers do not begin with 0";
  }
  if (message.empty() && !n.exponent.empty() && (n.exponent[0] == 'd' || n.exponent[0] == 'D'))
    message = "exponents are written with e";
  if (message.empty() && n.sign.size() > 1) {
    message = "it has more than one sign";
    return {};
  }
  return n.sign + regular(without(digits, "_"), n.exponent);
}

double value_of(const std::string& number) {
  double value = 0.0;
  from_chars(number.data() + (number.starts_with('+') ? 1 : 0), number.data() + number.size(), value);
  return value;
}

/// "mm", "kN", "%", "µm", "N/mm": letters and signs, nothing that a name would hold.
bool is_unit(std::string_view text) {
  constexpr std::size_t kLongestUnit = 12;
  if (text.empty() || text.size() > kLongestUnit) return false;
  return ranges::all_of(text,
                        [](char c) {
                          return is_letter(c) || static_cast<unsigned char>(c) >= 0x80 ||
                                 std::string_view("%/*^23 \"'").find(c) != std::string_view::npos;
                        }) &&
         !is_digit(text[0]) && text[0] != '/' && text[0] != '*';
}

/// What stands behind a number.
TextFault rest_fault(const std::string& number, std::string_view rest) {
  if (rest.find('=') != std::string_view::npos)
    return {"'=' stands twice on the line, which holds one key", "begin a new line for the next key"};
  if (rest.starts_with("//") || rest.starts_with("/*") || (rest[0] == ';' && rest.size() > 1) || rest[0] == '!')
    return {"comments begin with '#'", fmt::format("write {} # ...", number)};
  if (rest == ";" || rest == ",")
    return {fmt::format("nothing stands behind a value, here '{}' does", rest), "leave it out"};
  if (rest[0] == ':') {
    const std::string whole = number + std::string(rest);
    return {fmt::format("'{}' is text, and text stands in quotes", whole), fmt::format("write {}", in_quotes(whole))};
  }
  if (rest[0] == ',') return {"several values are a list", fmt::format("write [{}{}]", number, shown(rest))};
  if (rest[0] == '/' || rest[0] == '*' || rest[0] == '^' || ((rest[0] == '+' || rest[0] == '-') && rest.size() > 1)) {
    const std::optional<WrittenNumber> second = written_number(without_blanks(rest.substr(1)));
    const double by = second && second->rest.empty() ? value_of(second->sign + second->digits + second->exponent) : 0.0;
    return {"a calculation stands in place of a number",
            rest[0] == '/' && by != 0.0 ? fmt::format("write {:.8g}", value_of(number) / by) : "write its result"};
  }
  if (is_unit(rest))
    return {fmt::format("a number stands without its unit, here '{}' follows", rest),
            "write it alone, in the unit that the key's name ends with"};
  return {};
}

}  // namespace

TextFault number_fault(std::string_view given) {
  const std::string plain = plain_characters(given);
  const std::string_view text = without_blanks(plain);
  const std::optional<WrittenNumber> number = written_number(text);
  if (!number) return {};
  std::string message, other;
  const std::string right = mended(*number, message, other);
  if (!number->rest.empty()) {
    if (number->digits.back() == '.') return {};  // 2024.csv
    return rest_fault(right.empty() ? number->sign + number->digits : right, number->rest);
  }
  if (message.empty() && text != given && plain != given) message = "a character in it only looks like one of a number";
  if (message.empty()) return {"", fmt::format("write {} without quotes", right)};
  return {fmt::format("'{}' is no number: {}", shown(without_blanks(given)), message),
          right.empty() ? "" : fmt::format("write {}{}", right, other)};
}

namespace {

/// A line of the text, from 1.
std::string_view line_of(std::string_view text, int line) {
  for (int k = 1; k < line; ++k) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

/// Bytes before a column, which counts characters of UTF-8 from 1.
std::size_t bytes_before(std::string_view line, int column) {
  std::size_t at = 0;
  for (int k = 1; k < column && at < line.size(); ++k) {
    ++at;
    while (at < line.size() && (static_cast<unsigned char>(line[at]) & 0xc0u) == 0x80u) ++at;
  }
  return at;
}

/// The line without its comment.
std::string_view without_comment(std::string_view line) {
  for (std::size_t at = 0; at < line.size();) {
    if (line[at] == '#') return line.substr(0, at);
    at = line[at] == '"' || line[at] == '\'' ? after_toml_string(line, at) : at + 1;
  }
  return line;
}

/// An open bracket, and the line where it opens.
struct OpenBracket {
  char bracket;
  int line;
};

/// Brackets of values that are open where the text ends.
std::vector<OpenBracket> open_brackets(std::string_view text) {
  std::vector<OpenBracket> open;
  int line = 1;
  bool in_value = false;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    const std::size_t from = at;
    if (c == '"' || c == '\'')
      at = after_toml_string(text, at);
    else if (c == '#')
      at = std::min(text.find('\n', at), text.size());
    else
      ++at;
    line += static_cast<int>(ranges::count(text.substr(from, at - from), '\n'));
    if (c == '=') in_value = true;
    if (c == '\n' && open.empty()) in_value = false;
    if (in_value && (c == '[' || c == '{')) open.push_back({c, line});
    if (!open.empty() && (c == ']' || c == '}')) open.pop_back();
  }
  return open;
}

/// The header of a table, "[wheel]", as a line holds it; empty: none.
std::string_view header_of(std::string_view line) {
  line = without_blanks(without_comment(line));
  return line.starts_with('[') ? line : std::string_view();
}

std::string_view key_of_line(std::string_view line) {
  line = without_comment(line);
  const std::size_t equals = line.find('=');
  return equals == std::string_view::npos ? std::string_view() : without_blanks(line.substr(0, equals));
}

TextFault given_twice(std::string_view text, int number) {
  const std::string_view line = line_of(text, number), header = header_of(line);
  const std::string_view key = key_of_line(line);
  int first = 0;
  for (int k = 1; k < number; ++k)
    if (!header.empty() && header_of(line_of(text, k)) == header) first = k;
  if (!header.empty()) {
    const std::string name(without(header, "[] \t"));
    const bool list = header.starts_with("[[");
    if (first > 0)
      return {
          fmt::format("the table {} stands in line {} already", header, first),
          fmt::format("put its keys together, or write [[{}]] for several tables where a list of them is taken", name)};
    return {fmt::format("{} is given above in another way", name),
            list ? fmt::format("write [[{0}]] each time, and no [{0}]", name) : "put its keys together in one place"};
  }
  for (int k = number - 1; k >= 1; --k) {
    const std::string_view one = line_of(text, k);
    if (!header_of(one).empty()) break;
    if (key_of_line(one) == key) first = k;
  }
  if (first > 0)
    return {fmt::format("the key {} stands in line {} already", shown(key), first), "leave one of them out"};
  return {fmt::format("{} is given above in another way", shown(key)), "leave one of them out"};
}

/// What is wrong with the text in quotes at the front of a value.
TextFault string_fault(std::string_view key, std::string_view value, std::string_view words) {
  const std::size_t second = value.find(value[0], 1);
  const std::string_view inside = value.substr(1, second == std::string_view::npos ? second : second - 1);
  if (value[0] == '"' && inside.find('\\') != std::string_view::npos)
    return {"a backslash in double quotes begins a special character",
            fmt::format("write {} = {}, or single quotes round it", key, in_quotes(inside))};
  const bool open =
      words.find("control characters") != std::string_view::npos || words.find("end-of-file") != std::string_view::npos;
  if (open)
    return {"the quote is not closed on its line",
            fmt::format("write {} = {}", key, in_quotes(without_comment(value.substr(1))))};
  const std::string_view rest = without_blanks(value.substr(after_toml_string(value, 0)));
  if (rest.starts_with("//") || rest.starts_with("/*") || rest.starts_with("; "))
    return {"comments begin with '#'", "write # before it"};
  if (rest == ";" || rest == ",")
    return {fmt::format("nothing stands behind a value, here '{}' does", rest), "leave it out"};
  if (rest.starts_with(',')) return {"several values are a list", fmt::format("write {} = [{}]", key, shown(value))};
  if (rest.find('=') != std::string_view::npos) return {"a line holds one key", "begin a new line for the next one"};
  if (!rest.empty())
    return {fmt::format("the text ends at its second quote, and '{}' stands behind it", shown(rest)),
            "within double quotes write single ones, and the other way round"};
  return {};
}

TextFault text_fault(std::string_view key, std::string_view value) {
  return {fmt::format("'{}' is text, and text stands in quotes", shown(value)),
          fmt::format("write {} = {}", key, in_quotes(value))};
}

/// What is wrong with the value of a key, as far as its line goes.
TextFault value_fault(std::string_view key, std::string_view value, std::string_view words) {
  if (value.empty())
    return {fmt::format("the value of {} is missing", key),
            fmt::format("write {} = and its value, or leave the line out", key)};
  if (value[0] == '=')
    return {"'=' stands twice", fmt::format("write {} = {}", key, shown(without_blanks(value.substr(1))))};
  if (value[0] == '"' || value[0] == '\'') return string_fault(key, value, words);
  if (const LookAlike* one = look_alike_at(value); one != nullptr && (one->meant == '"' || one->meant == '\''))
    return {"typographic quotes do not count",
            fmt::format("write {} = {}", key, in_quotes(without(plain_characters(value), "'\"")))};
  if (value[0] == '(')
    return {"a list stands in square brackets", fmt::format("write {} = [{}]", key, shown(without(value, "()")))};
  const std::string word = lower_case(value);
  if (word == "true" || word == "false")
    return {fmt::format("'{}' is written in small letters", value), fmt::format("write {} = {}", key, word)};
  if (word == "yes" || word == "no" || word == "on" || word == "off")
    return {fmt::format("'{}' is neither a number nor text in quotes", value),
            fmt::format("write {} = {}, or \"{}\" where a word is taken", key,
                        word == "yes" || word == "on" ? "true" : "false", word)};
  if (word == "none" || word == "null" || word == "nil")
    return {fmt::format("there is no value '{}'", value),
            "leave the line out, or write \"none\" where a word is taken"};
  TextFault number = number_fault(value);
  if (!number.message.empty()) {
    constexpr std::string_view kWrite = "write ";
    if (number.advice.starts_with(kWrite) && !number.advice.starts_with("write it"))
      number.advice = fmt::format("write {} = {}", key, std::string_view(number.advice).substr(kWrite.size()));
    return number;
  }
  const std::size_t equals = value.find('=');
  if (equals != std::string_view::npos)
    return {"'=' stands twice on the line, which holds one key", "begin a new line for the next key"};
  if (words.find("expected a comment") != std::string_view::npos)
    return {"nothing but a comment stands behind a value", "leave it out, or begin a new line for it"};
  if (value[0] == '[' || value[0] == '{') return {};
  if (words.find("could not be interpreted") != std::string_view::npos ||
      words.find("representable") != std::string_view::npos)
    return {fmt::format("the number '{}' is beyond what can be held", shown(value)), "is its exponent right?"};
  if (is_letter(value[0]) || std::string_view("./~\\").find(value[0]) != std::string_view::npos || is_digit(value[0]) ||
      static_cast<unsigned char>(value[0]) >= 0x80)
    return text_fault(key, value);
  return {};
}

/// What is wrong within a list or an inline table that is open at the fault.
TextFault bracket_fault(const OpenBracket& open, std::string_view line, std::size_t at, std::string_view words) {
  const std::string_view here = without_blanks(line.substr(at));
  const bool new_key = !key_of_line(line).empty() && without_blanks(line.substr(0, at)).empty();
  if (open.bracket == '{') {
    if (here.starts_with(':')) return {"keys and values are separated by '='", "write { key = value }"};
    if (words.find("dangling comma") != std::string_view::npos) return {"a comma stands before '}'", "leave it out"};
    if (here.empty() || new_key)
      return {"a table in braces ends on the line where it begins",
              "write it on one line, or as [table] with a key a line"};
    return {};
  }
  if (new_key || (here.empty() && words.find("end-of-file") != std::string_view::npos) || !header_of(line).empty())
    return {fmt::format("the list that begins in line {} is not closed", open.line), "write ] behind its last value"};
  if (here.starts_with(';')) return {"values of a list are separated by commas", "write , in place of ;"};
  const std::size_t begin = line.find_last_of("[,", at == 0 ? 0 : at - 1);
  std::string_view element = line.substr(begin == std::string_view::npos || begin >= at ? 0 : begin + 1);
  element = without_blanks(element.substr(0, element.find_first_of(",]")));
  if (words.find("expected comma") != std::string_view::npos && !element.empty() && !is_letter(element[0]))
    return {"a comma is missing between values of the list", "write [1, 2, 3]"};
  if (element.empty()) return {"a value of the list is missing", "write [1, 2, 3]"};
  TextFault number = number_fault(element);
  if (!number.message.empty()) return number;
  return {fmt::format("'{}' is text, and text stands in quotes", shown(element)),
          fmt::format("write {}", in_quotes(element))};
}

TextFault header_fault(std::string_view header) {
  const std::string name = without(header.substr(0, header.find(']')), "[] \t");
  const bool list = header.starts_with("[[");
  const std::string right = list ? fmt::format("[[{}]]", name) : fmt::format("[{}]", name);
  const std::size_t closed = header.find(list ? "]]" : "]");
  if (closed == std::string_view::npos) return {"the header of a table is not closed", fmt::format("write {}", right)};
  const std::string_view rest = without_blanks(header.substr(closed + (list ? 2 : 1)));
  if (!rest.empty())
    return {fmt::format("the header of a table stands alone on its line, here '{}' follows", shown(rest)),
            "begin a new line for it"};
  return {};
}

/// Where a line has no key, or no key that can be read.
TextFault key_fault(std::string_view line) {
  for (const std::string_view mark : {"//", "/*", ";", "%", "!", "--", "*", "REM "})
    if (line.starts_with(mark))
      return {fmt::format("comments begin with '#', not with '{}'", mark), "write # before it"};
  if (line.starts_with('{')) return {"this looks like JSON, and TOML is expected", "write key = value, a key a line"};
  if (line.starts_with('<')) return {"this looks like XML or HTML, and TOML is expected", "is it the right file?"};
  const std::size_t equals = line.find('='), colon = line.find(':');
  if (colon != std::string_view::npos && colon < equals) {
    const std::string_view key = without_blanks(line.substr(0, colon)), value = without_blanks(line.substr(colon + 1));
    if (value.empty()) return {"the header of a table stands in square brackets", fmt::format("write [{}]", key)};
    return {"keys and values are separated by '='", fmt::format("write {} = {}", key, shown(value))};
  }
  if (equals == std::string_view::npos) {
    const std::size_t blank = line.find_first_of(" \t");
    const std::string_view key = line.substr(0, blank), value = blank == std::string_view::npos
                                                                    ? std::string_view()
                                                                    : without_blanks(line.substr(blank));
    const bool simple = ranges::all_of(key, [](char c) { return is_bare(c) || c == '.'; });
    if (simple && !value.empty() && value.find(' ') == std::string_view::npos)
      return {"'=' is missing", fmt::format("write {} = {}", key, shown(value))};
    return {fmt::format("'{}' is neither key = value nor the [header] of a table", shown(line)),
            "comments begin with #"};
  }
  const std::string_view key = without_blanks(line.substr(0, equals));
  if (key.empty()) return {"the name of the key is missing before '='", "write key = value"};
  if (ranges::any_of(key, [](char c) { return c == ' ' || c == '\t'; }) &&
      ranges::all_of(key, [](char c) { return is_bare(c) || c == '.' || c == ' ' || c == '\t'; })) {
    std::string joined(key);
    ranges::replace(joined, ' ', '_');
    return {fmt::format("the name of a key has no blanks, '{}' has", shown(key)),
            fmt::format("did you mean {}?", joined)};
  }
  if (key.ends_with('.') || key.starts_with('.'))
    return {fmt::format("a part of the key '{}' is missing beside its point", shown(key)), ""};
  for (std::size_t at = 0; at < key.size(); ++at)
    if (!is_bare(key[at]) && key[at] != '.')
      return {fmt::format("'{}' is no name of a key", shown(key)),
              "names have the letters a to z, digits, _ and points between their parts"};
  return {};
}

TextFault encoding_fault(std::string_view line) {
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t length = utf8_length(line.substr(at));
    if (length == 0) {
      const auto byte = static_cast<unsigned char>(line[at]);
      // Latin-1 is the beginning of Unicode.
      std::string latin;
      if (byte >= 0xa0)
        latin = fmt::format(", '{}{}' in Latin-1", static_cast<char>(0xc0u | (byte >> 6u)),
                            static_cast<char>(0x80u | (byte & 0x3fu)));
      return {fmt::format("the byte 0x{:02X} is not of UTF-8{}", byte, latin), "save the file in the encoding UTF-8"};
    }
    at += length;
  }
  return {};
}

}  // namespace

TextFault toml_fault(std::string_view text, int number, int column, std::string_view words) {
  const std::string_view whole = line_of(text, number);
  if (words.find("utf-8") != std::string_view::npos) return encoding_fault(whole);
  if (words.find("after '\\r'") != std::string_view::npos)
    return {"lines end with a carriage return alone", "save the file with the line ends of Linux or Windows"};
  if (words.find("cannot redefine") != std::string_view::npos) return given_twice(text, number);
  const std::size_t at = bytes_before(whole, column);
  const std::size_t start =
      whole.data() == nullptr ? text.size() : static_cast<std::size_t>(whole.data() - text.data());
  if (const LookAlike* one = look_alike_at(whole.substr(at)); one != nullptr && one->meant == ' ')
    return {fmt::format("{} stands here", one->name), "write a blank in its place"};
  const std::vector<OpenBracket> open = open_brackets(text.substr(0, start + at));
  const bool in_string =
      words.find("string") != std::string_view::npos || words.find("unicode scalar") != std::string_view::npos;
  if (!open.empty() && !in_string) return bracket_fault(open.back(), whole, at, words);
  const std::string_view line = without_blanks(without_comment(whole));
  if (const std::string_view header = header_of(whole); !header.empty() && open.empty()) return header_fault(header);
  TextFault key = key_fault(line);
  if (!key.message.empty()) return key;
  return value_fault(key_of_line(whole), without_blanks(without_comment(whole).substr(whole.find('=') + 1)), words);
}

}  // namespace treadmark::io
