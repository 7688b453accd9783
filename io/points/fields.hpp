// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/files/line_scanner.hpp"

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
/// numbers, every one has digits on both sides, and nowhere is a decimal point.
FieldStyle find_style(const std::vector<std::string>& lines);

}  // namespace treadmark::io::points
