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
#include "treadmark/io/points/text_lines.hpp"
#include "treadmark/model/shape/length_unit.hpp"

namespace treadmark::io::scans {

using namespace points;

/// Which column (from 0) of a list of points holds what.
struct ColumnLayout {
  static constexpr int kPass = 6, kIntensity = 7, kValues = 8;
  FieldStyle style;
  std::vector<int> value;  ///< per column: 0 to 7 for x y z nx ny nz pass intensity, -1: none
  bool normals = false, pass = false, intensity = false;
  bool loose_pass =
      false;  ///< the column may hold something else (numbers of lines): ignored where it cannot be a pass
  bool text_first = false;   ///< lines of points begin with text: all from first_points on are such lines
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
  bool has_xyz = false, has_normals = false, has_intensity = false, twice = false;
};
ColumnNames find_names(const std::vector<std::string>& names);

/// What exports write where there is no number: "N/A", "--", "null" ...; nothing at all is one, too.
bool is_nothing(std::string_view text);

/// A line of such marks, or of them and numbers, that begins with one.
bool is_lost_row(std::string_view line);

/// Looks at the first lines. Error(input_data) at the line that makes no sense.
ColumnLayout find_layout(ByteBlocks& bytes);

}  // namespace treadmark::io::scans
