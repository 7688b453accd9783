// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/points/fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/platform/from_chars.hpp"

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

FieldStyle find_style(const std::vector<std::string>& lines, std::size_t coordinates) {
  if (all_contain(lines, ';')) return {';', commas_are_decimal(lines, ';', 1)};
  if (all_contain(lines, '\t')) {
    const bool decimal = commas_are_decimal(lines, ' ', 1);
    if (decimal || !any_contains(lines, ',')) return {tabs_are_strict(lines) ? '\t' : ' ', decimal};
    return {',', false};
  }
  if (any_contains(lines, ',')) {
    if (commas_are_decimal(lines, ' ', coordinates)) return {' ', true};
    return {',', false};
  }
  return {' ', false};
}

bool parse_number_slowly(std::string_view word, bool decimal_comma, double& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  char copy[400];
  if (word.empty() || word.size() > sizeof copy) return false;
  std::copy(word.begin(), word.end(), copy);
  char* const end = copy + word.size();
  if (decimal_comma && std::count(copy, end, ',') == 1) std::replace(copy, end, ',', '.');

  std::from_chars_result result = from_chars(copy, end, value);
  if (result.ptr != end && result.ptr != copy && (*result.ptr == 'd' || *result.ptr == 'D')) {
    *const_cast<char*>(result.ptr) = 'e';  // Fortran writes 1d-5
    result = from_chars(copy, end, value);
  }
  if (result.ptr == end && result.ec == std::errc::result_out_of_range) {
    // too small is as good as zero, too large is no number to go on with
    const std::string_view text(copy, word.size());
    const std::size_t exponent = text.find_first_of("eE");
    const bool small = exponent != std::string_view::npos ? text[exponent + 1] == '-'
                                                          : text.find_first_of("123456789") > text.find('.');
    value = small ? 0.0 : std::numeric_limits<double>::infinity();
    return true;
  }
  if (result.ptr == end && result.ec == std::errc{}) return true;
  std::string_view rest(copy, word.size());
  if (rest[0] == '-') rest.remove_prefix(1);
  if (rest == "1.#IND" || rest == "1.#QNAN" || rest == "1.#INF" || rest == "1.#SNAN" || rest == "1.#J") {
    value = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  return false;
}

bool is_whole(double value) { return std::abs(value) <= 9e15 && value == std::floor(value); }

}  // namespace treadmark::io::points
