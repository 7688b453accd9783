// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/points/line_blocks.hpp"

namespace treadmark::io::points {

/// How the numbers of a line are told apart.
struct FieldStyle {
  char separator = ' ';  ///< ' ': any number of blanks and tabs; ',', ';' and '\t': one of them, with blanks around
  bool decimal_comma = false;

  /// "separated by ';', decimal comma"
  std::string in_words() const;
};

/// A piece of a line without blanks around; may be empty. The column counts from 1.
using Field = profiles::Word;

/// Walks over the fields of a line.
class FieldScanner {
 public:
  FieldScanner(std::string_view line, char separator) : line_(line), separator_(separator) {}

  bool next(Field& field) {
    if (separator_ == ' ') {
      while (at_ < line_.size() && profiles::is_blank(line_[at_])) ++at_;
      if (at_ == line_.size()) return false;
      const std::size_t start = at_;
      while (at_ < line_.size() && !profiles::is_blank(line_[at_])) ++at_;
      field = {line_.substr(start, at_ - start), static_cast<int>(start + 1)};
      return true;
    }
    if (at_ > line_.size()) return false;
    std::size_t start = at_;
    while (at_ < line_.size() && line_[at_] != separator_) ++at_;
    std::size_t end = at_++;
    while (start < end && profiles::is_blank(line_[start])) ++start;
    while (end > start && profiles::is_blank(line_[end - 1])) --end;
    field = {line_.substr(start, end - start), static_cast<int>(start + 1)};
    return true;
  }

 private:
  std::string_view line_;
  char separator_;
  std::size_t at_ = 0;
};

/// All fields but empty ones at the end.
std::vector<Field> fields_of(std::string_view line, char separator);

/// The style that all of these lines of numbers share. Commas are decimal commas where something else separates the
/// numbers, every one has digits on both sides, and nowhere is a decimal point. coordinates: numbers that a point
/// needs.
FieldStyle find_style(const std::vector<std::string>& lines, std::size_t coordinates = 3);

/// The number that a whole word says: exponents e, E, d and D, a leading '+', nan and infinities in the spellings of C,
/// and of Windows ("-1.#IND"); a decimal comma where asked for. Out of range counts as infinite. False for anything
/// else.
bool parse_number_slowly(std::string_view word, bool decimal_comma, double& value);

inline bool parse_number(std::string_view word, bool decimal_comma, double& value) {
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = from_chars(word.data(), end, value);
  if (result.ptr == end && result.ec == std::errc{}) return true;
  return parse_number_slowly(word, decimal_comma, value);
}

/// A whole number that a double holds exactly.
bool is_whole(double value);

/// The number in a field, which may be NaN or infinite. Error(input_data) at the field for anything else.
inline double number_in(const LineBlocks& lines, const Field& field, bool decimal_comma = false) {
  double value = 0.0;
  if (parse_number(field.text, decimal_comma, value)) return value;
  const bool comma = !decimal_comma && field.text.find(',') != std::string_view::npos;
  lines.fail("a number is expected, this is " + profiles::printable(field.text), field.column,
             comma ? "write decimal points, or separate numbers with decimal commas by ';'" : "");
}

/// A number of elements. Error(input_data) at the field for anything but a whole number up to 1e12.
inline std::uint64_t count_in(const LineBlocks& lines, const Field& field) {
  double value = 0.0;
  if (!parse_number(field.text, false, value) || !is_whole(value) || value < 0.0 || value > 1e12)
    lines.fail("a number of elements is expected, this is " + profiles::printable(field.text), field.column);
  return to_whole<std::uint64_t>(value);
}

/// The three numbers behind a key, as the sink reads numbers. what: the message where they are fewer.
template <class Sink>
Vec3 three_in(const LineBlocks& lines, FieldScanner& fields, const Field& key, const char* what) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) {
    Field field;
    if (!fields.next(field)) Sink::too_few(lines, key, what);
    p[k] = Sink::number(lines, field);
  }
  return p;
}

}  // namespace treadmark::io::points
