// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/points/byte_blocks.hpp"
#include "treadmark/io/points/fields.hpp"
#include "treadmark/model/length_unit.hpp"

namespace treadmark::io::scans {

using namespace points;

/// What a line of a text of numbers is.
enum class LineKind { empty, comment, words, numbers };
LineKind kind_of_line(std::string_view line);

/// The text of a comment without the signs before it.
std::string_view comment_text(std::string_view line);

/// Which column (from 0) of a list of points holds what.
struct ColumnLayout {
  static constexpr int kPass = 6, kValues = 7;
  FieldStyle style;
  std::vector<int> value;  ///< per column: 0 to 6 for x y z nx ny nz pass, -1: none
  bool normals = false, pass = false;
  bool loose_pass =
      false;  ///< the column may hold something else (numbers of lines): ignored where it cannot be a pass
  bool count_first = false;  ///< the first line is the number of points
  int first_points = 0;      ///< number of the first line of points (or of that count)
  std::optional<LengthUnit> unit;
  std::string in_words;  ///< what was found or assumed
};

/// Names of columns: what they hold.
struct ColumnNames {
  std::vector<int> value;
  int passes = 0;  ///< columns that may be the pass
  bool loose_pass = false;
  std::optional<LengthUnit> unit;
  bool units_differ = false;
  bool has_xyz = false, has_normals = false, twice = false;
};
ColumnNames find_names(const std::vector<std::string>& names);

/// The names in a header line. In a header separated by blanks a unit in brackets belongs to the name before it.
std::vector<std::string> names_in(std::string_view line, char separator);

/// Looks at the first lines. Error(input_data) at the line that makes no sense.
ColumnLayout find_layout(ByteBlocks& bytes);

}  // namespace treadmark::io::scans
