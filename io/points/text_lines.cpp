// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/points/text_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/points/fields.hpp"

namespace treadmark::io::points {

LineKind kind_of_line(std::string_view line) {
  const std::size_t start = line.find_first_not_of(" \t\v\f");
  if (start == std::string_view::npos) return LineKind::empty;
  line.remove_prefix(start);
  if (line.find_first_of("#!%") == 0 || line.starts_with("//")) return LineKind::comment;
  const std::size_t end = line.find_first_of(" \t\v\f;,");
  if (end == 0) {
    // an empty first field; ';' before words is a comment
    const std::size_t next = line.find_first_not_of(" \t\v\f;,");
    if (next == std::string_view::npos || line[0] != ';') return LineKind::numbers;
    return kind_of_line(line.substr(next)) == LineKind::numbers ? LineKind::numbers : LineKind::comment;
  }
  double value = 0.0;
  return parse_number(line.substr(0, end), false, value) ? LineKind::numbers : LineKind::words;
}

std::string_view comment_text(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t\v\f"), line.size()));
  line.remove_prefix(std::min(line.find_first_not_of("#!%/;"), line.size()));
  return line;
}

std::string_view without_comment(std::string_view line) {
  for (std::size_t k = 1; k < line.size(); ++k) {
    const bool sign = line[k] == '#' || line[k] == '!' || line[k] == '%' || line.substr(k).starts_with("//");
    if (sign && std::string_view(" \t,;").find(line[k - 1]) != std::string_view::npos) return line.substr(0, k);
  }
  return line;
}

std::vector<std::string> names_in(std::string_view line, char separator) {
  std::vector<std::string> names;
  bool open = false;
  for (const Field& field : fields_of(line, separator)) {
    std::string_view text = field.text;
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    const bool goes_on = separator == ' ' && !names.empty() && (open || text.starts_with('[') || text.starts_with('('));
    if (goes_on)
      names.back().append(" ").append(text);
    else
      names.emplace_back(text);
    open = (open || text.find_first_of("[(") != std::string_view::npos) &&
           text.find_first_of("])") == std::string_view::npos;
  }
  return names;
}

std::string plain_signs(std::string_view line) {
  constexpr std::array<std::pair<std::string_view, char>, 8> kSigns{{{"\xE2\x88\x92", '-'},    // U+2212 minus
                                                                     {"\xE2\x80\x93", '-'},    // en dash
                                                                     {"\xE2\x80\x90", '-'},    // hyphen
                                                                     {"\xEF\xBC\x8D", '-'},    // full width
                                                                     {"\xC2\xA0", ' '},        // no-break space
                                                                     {"\xE2\x80\xAF", ' '},    // narrow one
                                                                     {"\xE2\x80\x89", ' '},    // thin space
                                                                     {"\xE2\x80\x87", ' '}}};  // as wide as a digit
  if (ranges::none_of(line, [](char c) { return static_cast<unsigned char>(c) >= 0x80 || c == '('; })) return {};
  std::string plain;
  bool changed = false;
  for (std::size_t k = 0; k < line.size();) {
    const auto sign = ranges::find_if(kSigns, [&](const auto& s) { return line.substr(k).starts_with(s.first); });
    plain += sign == kSigns.end() ? line[k] : sign->second;
    changed = changed || sign != kSigns.end();
    k += sign == kSigns.end() ? 1 : sign->first.size();
  }
  for (std::size_t open = plain.find('('); open != std::string::npos; open = plain.find('(', open + 1)) {
    const std::size_t close = plain.find(')', open);
    if (close == std::string::npos) break;
    double value = 0.0;
    const std::string_view inside = std::string_view(plain).substr(open + 1, close - open - 1);
    const bool apart = open == 0 || std::string_view(" \t;,").find(plain[open - 1]) != std::string_view::npos;
    if (!apart || !parse_number(inside, true, value) || !(value >= 0.0)) continue;
    plain[open] = '-', plain[close] = ' ';
    changed = true;
  }
  return changed ? plain : std::string();
}

bool is_void_word(std::string_view word) {
  constexpr std::array<std::string_view, 17> kVoid{"",     "nan",     "n/a",    "na",     "#n/a",   "null",
                                                   "none", "nil",     "void",   "inf",    "-inf",   "-nan",
                                                   "miss", "#value!", "#wert!", "nodata", "invalid"};
  if (word.size() >= 2 && word.front() == '"' && word.back() == '"') word = word.substr(1, word.size() - 2);
  if (ranges::none_of(word, [](char c) { return c >= '0' && c <= '9'; })) {
    const std::string plain = profiles::lower(word);
    if (ranges::find(kVoid, plain) != kVoid.end()) return true;
    if (ranges::all_of(plain, [](char c) { return c == '-' || c == '*' || c == '?' || c == '.'; })) return true;
  }
  double value = 0.0;
  return parse_number(word, true, value) && !std::isfinite(value);
}

bool unquote_numbers(std::string_view line, std::string& plain) {
  bool changed = false;
  // with commas between the fields a decimal comma would be one of them
  const bool commas_may_stay = line.find_first_of(";\t") != std::string_view::npos;
  for (std::size_t open = line.find('"'); open != std::string_view::npos;) {
    const std::size_t close = line.find('"', open + 1);
    if (close == std::string_view::npos) break;
    const std::string_view inside = line.substr(open + 1, close - open - 1);
    double value = 0.0;
    if (parse_number(inside, true, value)) {
      if (!changed) plain = line;
      changed = true;
      plain[open] = plain[close] = ' ';
      if (!commas_may_stay)
        std::replace(plain.begin() + static_cast<std::ptrdiff_t>(open),
                     plain.begin() + static_cast<std::ptrdiff_t>(close), ',', '.');
    }
    open = line.find('"', close + 1);
  }
  return changed;
}

}  // namespace treadmark::io::points
