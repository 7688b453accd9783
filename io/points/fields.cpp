// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/points/fields.hpp"

#include <algorithm>

#include "treadmark/io/points/number.hpp"

namespace treadmark::io::points {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool all_contain(const std::vector<std::string>& lines, char c) {
  return !lines.empty() &&
         std::all_of(lines.begin(), lines.end(), [c](const std::string& l) { return l.find(c) != std::string::npos; });
}

bool any_contains(const std::vector<std::string>& lines, char c) {
  return std::any_of(lines.begin(), lines.end(), [c](const std::string& l) { return l.find(c) != std::string::npos; });
}

/// Whether commas make sense as decimal commas when the lines are cut at the separator.
bool commas_are_decimal(const std::vector<std::string>& lines, char separator, std::size_t least_fields) {
  if (!any_contains(lines, ',') || any_contains(lines, '.')) return false;
  for (const std::string& line : lines) {
    const std::vector<Field> fields = fields_of(line, separator);
    if (fields.size() < least_fields) return false;
    for (const Field& field : fields) {
      const std::size_t comma = field.text.find(',');
      if (comma == std::string_view::npos) continue;
      double value = 0.0;
      if (comma == 0 || comma + 1 == field.text.size() || !is_digit(field.text[comma - 1]) ||
          !is_digit(field.text[comma + 1]) || !parse_number(field.text, true, value))
        return false;
    }
  }
  return true;
}

/// Whether single tabs separate: between tabs stands one word or nothing, and tabs are not mixed with blanks.
bool tabs_are_strict(const std::vector<std::string>& lines) {
  for (const std::string& line : lines)
    for (const Field& field : fields_of(line, '\t'))
      if (field.text.empty() || std::any_of(field.text.begin(), field.text.end(), profiles::is_blank)) return false;
  return true;
}

}  // namespace

std::string FieldStyle::in_words() const {
  std::string words = "separated by ";
  if (separator == ' ')
    words += "blanks";
  else if (separator == '\t')
    words += "tabs";
  else
    words.append("'").append(1, separator).append("'");
  return decimal_comma ? words + ", decimal comma" : words;
}

std::vector<Field> fields_of(std::string_view line, char separator) {
  std::vector<Field> fields;
  FieldScanner scanner(line, separator);
  for (Field field; scanner.next(field);) fields.push_back(field);
  while (!fields.empty() && fields.back().text.empty()) fields.pop_back();
  return fields;
}

FieldStyle find_style(const std::vector<std::string>& lines) {
  constexpr std::size_t kPoint = 3;
  if (all_contain(lines, ';')) return {';', commas_are_decimal(lines, ';', 1)};
  if (all_contain(lines, '\t')) {
    const bool decimal = commas_are_decimal(lines, ' ', 1);
    if (decimal || !any_contains(lines, ',')) return {tabs_are_strict(lines) ? '\t' : ' ', decimal};
    return {',', false};
  }
  if (any_contains(lines, ',')) {
    if (commas_are_decimal(lines, ' ', kPoint)) return {' ', true};
    return {',', false};
  }
  return {' ', false};
}

}  // namespace treadmark::io::points
