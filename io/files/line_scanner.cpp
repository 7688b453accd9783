// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/files/line_scanner.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/platform/from_chars.hpp"

namespace treadmark::io::profiles {
namespace {

enum class Numeric { finite, not_finite, out_of_range, no };

struct Parsed {
  Numeric kind = Numeric::no;
  double value = 0.0;
};

Parsed parse(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  char copy[64];
  const char* const last = word.data() + word.size();
  double value = 0.0;
  std::from_chars_result result = from_chars(word.data(), last, value);

  // Fortran writes 1d-5: try again with an e where the mantissa ended.
  if (result.ptr != last && (*result.ptr == 'd' || *result.ptr == 'D') && result.ptr != word.data() &&
      word.size() < sizeof copy) {
    const auto mantissa = static_cast<std::size_t>(result.ptr - word.data());
    std::copy(word.begin(), word.end(), copy);
    copy[mantissa] = 'e';
    result = from_chars(copy, copy + word.size(), value);
    if (result.ptr != copy + word.size()) return {};
  } else if (result.ptr != last) {
    return {};
  }
  if (result.ec == std::errc::result_out_of_range) return {Numeric::out_of_range};
  if (result.ec != std::errc{}) return {};
  return {std::isfinite(value) ? Numeric::finite : Numeric::not_finite, value};
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown = "'";
  for (const char c : text.substr(0, 40)) shown += (c >= ' ' && c <= '~') ? c : '?';
  if (text.size() > 40) shown += "...";
  return shown + "'";
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

LineScanner::LineScanner(std::string_view text, std::string file) : TextLine(std::move(file)), rest_(text) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
    const std::string_view before = text.substr(0, nul);
    const auto lines = std::count(before.begin(), before.end(), '\n');
    const std::size_t start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    throw Error(ErrorKind::input_data, "a NUL byte: this is not a plain text file",
                {file_, static_cast<int>(lines + 1), static_cast<int>(nul - start + 1)}, "save it as plain text");
  }
}

bool LineScanner::next_line() {
  if (rest_.empty()) return false;
  if (number_ == kMaxLines) fail("more than 10 million lines", 0, "thin out the points");
  ++number_;
  offset_ = 0;
  const std::size_t end = rest_.find_first_of("\r\n");
  line_ = rest_.substr(0, end);
  if (end == std::string_view::npos) {
    rest_ = {};
  } else {
    const bool pair = rest_[end] == '\r' && end + 1 < rest_.size() && rest_[end + 1] == '\n';
    rest_.remove_prefix(end + (pair ? 2 : 1));
  }
  return true;
}

std::optional<Word> LineScanner::next_word() {
  while (offset_ < line_.size() && is_blank(line_[offset_])) ++offset_;
  if (offset_ >= line_.size()) return std::nullopt;
  const std::size_t start = offset_;
  while (offset_ < line_.size() && !is_blank(line_[offset_])) ++offset_;
  return Word{line_.substr(start, offset_ - start), static_cast<int>(start + 1)};
}

void TextLine::fail(const std::string& message, int column, const std::string& advice) const {
  // what looks like a wrong number may be a file of another kind
  if (line_.find('\0') != std::string_view::npos)
    throw Error(ErrorKind::input_data, "a NUL byte: this is not a plain text file",
                at(static_cast<int>(line_.find('\0') + 1)), "check the extension, or save it as plain text");
  throw Error(ErrorKind::input_data, message, at(column), advice);
}

bool looks_numeric(std::string_view word) { return parse(word).kind != Numeric::no; }

double to_number(const TextLine& line, const Word& word) {
  const Parsed parsed = parse(word.text);
  switch (parsed.kind) {
    case Numeric::finite:
      return parsed.value;
    case Numeric::not_finite:
      line.fail("the number " + printable(word.text) + " is not finite", word.column, "remove or repair the point");
    case Numeric::out_of_range:
      line.fail("the number " + printable(word.text) + " is out of range", word.column);
    case Numeric::no:
      break;
  }
  const bool comma = word.text.find(',') != std::string_view::npos;
  line.fail("a number is expected, this is " + printable(word.text), word.column,
            comma ? "write decimal points and separate numbers by blanks" : "");
}

int to_integer(const TextLine& line, const Word& word) {
  std::string_view text = word.text;
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  int value = 0;
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value > 1'000'000'000 || value < -1'000'000'000)
    line.fail("a whole number is expected, this is " + printable(word.text), word.column);
  return value;
}

}  // namespace treadmark::io::profiles
