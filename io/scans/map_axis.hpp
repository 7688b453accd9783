// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/io/points/byte_blocks.hpp"
#include "treadmark/io/points/line_blocks.hpp"
#include "treadmark/io/points/unit_words.hpp"
#include "treadmark/io/scans/column_layout.hpp"
#include "treadmark/io/scans/read_scan.hpp"

namespace treadmark::io::scans {

using namespace points;

/// The first of at least two positions that breaks an even increase; nothing where they increase evenly, within 5 % of
/// a step (printed positions are rounded). A single position breaks it.
std::optional<std::size_t> uneven_position(const std::vector<double>& positions);

/// Metres or radians of one in the file.
struct MapScales {
  double u = 1.0, y = 1.0, height = 1.0;
};

/// From the options and what the file says.
MapScales map_scales(const MapReadOptions& options, std::optional<LengthUnit> unit,
                     std::optional<LengthUnit> height_unit);

/// What comments say on units: one that speaks of heights or deviations tells theirs.
class MapUnitWords {
 public:
  void look_at(std::string_view comment);
  std::optional<LengthUnit> unit() const { return unit_.unit(); }
  std::optional<LengthUnit> height_unit() const { return height_.unit(); }

 private:
  UnitFinder unit_, height_;
};

/// The deviation in metres; NaN stays. Error(input_data) at the column for more than 50 mm.
float deviation_in_metres(const LineBlocks& lines, double value, double scale, int column);

/// Error(input_data) where a wheel's rows go round more than once.
void check_turn(const Grid2& grid, const MapReadOptions& options, const std::string& file);

[[noreturn]] void no_data(const std::string& file);

/// The first lines of a matrix, without comments and empty lines.
struct MapHead {
  std::vector<std::string> lines;
  FieldStyle style;
  bool corner_missing = false;  ///< separated by blanks, the first row has one field less than the others
};

/// Leaves the bytes where they are.
MapHead find_map_head(ByteBlocks& bytes);

}  // namespace treadmark::io::scans
