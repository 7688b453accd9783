// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/simulations/recording_names.hpp"
#include "treadmark/io/simulations/recording_text.hpp"

namespace treadmark::io::recording {

/// A column whose numbers are used.
struct Column {
  RecordedColumn meaning;
  std::string name;
  int place = 0;  ///< in the header line, for messages
  std::size_t cell = 0;
};

/// The line or lines that name the columns.
struct Header {
  int line = 0, lines = 1;
  char separator = ',';
  std::size_t cells = 0;
  std::vector<Column> columns;
  std::vector<Cell> unknown;
  std::vector<std::string> unknown_names;
  bool has(Recorded what) const {
    return ranges::any_of(columns, [what](const Column& c) { return c.meaning.what == what; });
  }
  bool has_function() const {
    return has(Recorded::level) || has(Recorded::cross_level) || has(Recorded::cant) || has(Recorded::alignment) ||
           has(Recorded::gauge);
  }
  bool complete() const { return (has(Recorded::distance) || has(Recorded::metres)) && has_function(); }
  std::size_t score() const { return columns.size() + (complete() ? 100 : 0); }
};

/// A line with its number.
using NumberedLine = std::pair<int, std::string_view>;

/// The line that names most columns, or the first two that do so together. Blanks separate names only where nothing
/// else does, and comments hold them where no other line does.
Header find_header(const std::vector<NumberedLine>& lines, const std::vector<NumberedLine>& comments);

/// The name of such a column in the own format, "alignment_left_mm".
std::string own_name(const RecordedColumn& column);
/// The same without its unit.
std::string function_name(const RecordedColumn& column);

/// Errors: Error(input_data) at the line, for names of the own format with a slip in them.
void refuse_slips(const profiles::TextLine& line, const Header& header);

/// Of columns with the same meaning one is left, or the bands of wavelengths that follow each other. Errors:
/// Error(input_data) for two that do not differ.
void choose_among_equals(const profiles::TextLine& line, Header& header, std::vector<std::string>& notes);

/// Errors: Error(input_data) without a distance or a function, and where one rail of two is given.
void check_columns(const profiles::TextLine& line, const Header& header);

}  // namespace treadmark::io::recording
