// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/scans/map_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/io/files/line_scanner.hpp"

namespace treadmark::io::scans {

std::optional<std::size_t> uneven_position(const std::vector<double>& positions) {
  constexpr double kTolerance = 0.05;  // of a step
  const std::size_t n = positions.size();
  if (n < 2) return 0;
  const double step = (positions.back() - positions.front()) / static_cast<double>(n - 1);
  bool even = step > 0.0 && std::isfinite(step);
  for (std::size_t i = 0; even && i < n; ++i)
    even = std::abs(positions[i] - (positions.front() + static_cast<double>(i) * step)) <= kTolerance * step;
  if (even) return std::nullopt;

  // the usual step shows which one is out of line
  std::vector<double> steps(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) steps[i] = positions[i + 1] - positions[i];
  std::vector<double> sorted = steps;
  for (double& s : sorted)
    if (std::isnan(s)) s = 0.0;
  const std::size_t middle = (sorted.size() - 1) / 2;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(middle), sorted.end());
  const double usual = sorted[middle];
  std::size_t worst = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!(steps[i] > 0.0 && std::abs(steps[i] - usual) <= kTolerance * usual)) return i + 1;
    if (std::abs(steps[i] - usual) > std::abs(steps[worst] - usual)) worst = i;
  }
  return worst + 1;
}

MapScales map_scales(const MapReadOptions& options, std::optional<LengthUnit> unit,
                     std::optional<LengthUnit> height_unit) {
  const LengthUnit position = options.unit.value_or(unit.value_or(LengthUnit::millimetre));
  const LengthUnit height = options.height_unit.value_or(height_unit.value_or(position));
  MapScales scales;
  scales.y = scales.u = metres_per(position);
  scales.height = metres_per(height);
  if (options.body == Body::wheel)
    scales.u = options.angles_deg ? std::numbers::pi / 180.0 : metres_per(position) / options.nominal_radius;
  return scales;
}

void MapUnitWords::look_at(std::string_view comment) {
  // "positions in mm, deviations in um" are two statements
  for (std::size_t start = 0; start <= comment.size();) {
    const std::size_t end = std::min(comment.find_first_of(",;", start), comment.size());
    const std::string part = profiles::lower(comment.substr(start, end - start));
    const bool height = part.find("height") != std::string::npos || part.find("deviation") != std::string::npos ||
                        part.find("offset") != std::string::npos || part.find("value") != std::string::npos;
    (height ? height_ : unit_).look_at(part);
    start = end + 1;
  }
}

float deviation_in_metres(const LineBlocks& lines, double value, double scale, int column) {
  constexpr double kMost = 0.05;
  const double metres = value * scale;
  if (std::abs(metres) > kMost)
    lines.fail(fmt::format("a deviation of {:g} mm, more than 50 mm", 1e3 * metres), column,
               "is its unit right? it may differ from that of the positions");
  return static_cast<float>(metres);
}

void check_turn(const Grid2& grid, const MapReadOptions& options, const std::string& file) {
  if (options.body != Body::wheel) return;
  const double turns = grid.dx * (grid.nx - 1) / (2.0 * std::numbers::pi);
  if (turns > 1.0 + 1e-3)
    throw Error(ErrorKind::input_data, fmt::format("the map goes {:g} times round the wheel", turns), {file, 0, 0},
                options.angles_deg ? "are the rows' positions degrees?"
                                   : "are unit and nominal radius right, or are the positions degrees?");
}

void no_data(const std::string& file) {
  throw Error(ErrorKind::input_data, "the map has no data at all", {file, 0, 0}, "is every cell empty, nan or NODATA?");
}

}  // namespace treadmark::io::scans
