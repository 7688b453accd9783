// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/offset_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::app {
namespace {

/// In every station of the table the first node that the surface does not reach; -1 where it reaches all. Nodes without
/// a deviation may lie beside the surface.
std::vector<int> nodes_beside(const OffsetMap& map, const NaturalSurface& natural) {
  const Grid2& g = map.grid;
  const auto ny = static_cast<std::size_t>(g.ny);
  std::vector<int> first(static_cast<std::size_t>(g.nx), -1);
  std::vector<double> y(ny);
  for (int iy = 0; iy < g.ny; ++iy) y[static_cast<std::size_t>(iy)] = g.y(iy);
  parallel_for(first.size(), [&](std::size_t i) {
    const int iu = static_cast<int>(i);
    std::vector<double> height(ny);
    section_heights(*natural.surface, natural.spec.body, g.x(iu), y, {height, {}, {}});
    for (int iy = g.ny - 1; iy >= 0; --iy)
      if (std::isnan(height[static_cast<std::size_t>(iy)]) && map.offset[g.index(iu, iy)] != 0.0F) first[i] = iy;
  });
  return first;
}

/// The greatest deviation at the ends of the table [m].
double at_border(const OffsetMap& map, bool closed) {
  const Grid2& g = map.grid;
  double most = 0.0;
  const auto look = [&](int iu, int iy) {
    most = std::max(most, std::fabs(static_cast<double>(map.offset[g.index(iu, iy)])));
  };
  for (int iu = 0; iu < g.nx; ++iu) look(iu, 0), look(iu, g.ny - 1);
  if (closed) return most;
  for (int iy = 0; iy < g.ny; ++iy) look(0, iy), look(g.nx - 1, iy);
  return most;
}

/// The first node from which the deviations rise or fall by more than the way to a neighbour [m]; the surface would
/// hide itself from tilted views. along: of a step in u.
std::optional<std::pair<int, int>> too_steep(const OffsetMap& map, double along) {
  const Grid2& g = map.grid;
  const auto offset = [&](int iu, int iy) { return static_cast<double>(map.offset[g.index(iu, iy)]); };
  for (int iu = 0; iu < g.nx; ++iu)
    for (int iy = 0; iy < g.ny; ++iy) {
      const bool across = iy > 0 && std::fabs(offset(iu, iy) - offset(iu, iy - 1)) > g.dy;
      const bool lengthwise = iu > 0 && std::fabs(offset(iu, iy) - offset(iu - 1, iy)) > along;
      if (across || lengthwise) return std::pair{iu, iy};
    }
  return std::nullopt;
}

}  // namespace

OffsetMap read_offset_table(const io::OffsetsInput& table, NaturalSurface& surface) {
  const Body body = surface.spec.body;
  io::MapReadOptions how;
  how.body = body;
  how.nominal_radius = surface.spec.nominal_radius;
  how.unit = table.unit;
  how.height_unit = table.deviation_unit;
  how.angles_deg = table.angles_deg;
  how.complete = true;
  how.asked_by = table.where;
  OffsetMap map = io::read_deviation_map(table.file, how);
  const std::vector<int> beside = nodes_beside(map, surface);
  const auto bad = ranges::find_if(beside, [](int iy) { return iy >= 0; });
  if (bad != beside.end()) {
    const int iu = static_cast<int>(bad - beside.begin());
    const double u = map.grid.x(iu);
    const std::string place = body == Body::wheel ? fmt::format("{:.6g} degrees", u * 180.0 / std::numbers::pi)
                                                  : fmt::format("x = {:.6g} mm", 1e3 * u);
    how.objection = {iu, *bad,
                     fmt::format("a deviation beside the {}, which has no surface at {}, y = {:.6g} mm",
                                 body_name(body), place, 1e3 * map.grid.y(*bad)),
                     "end the table where the surface ends, or write 0 there; are its units and signs right?"};
    io::read_deviation_map(table.file, how);
  }
  if (const auto node = too_steep(map, body == Body::wheel ? map.grid.dx * how.nominal_radius : map.grid.dx)) {
    how.objection = {
        node->first, node->second,
        fmt::format("a deviation of {:.6g} mm, steeper than 45 degrees from the one before",
                    1e3 * static_cast<double>(map.offset[map.grid.index(node->first, node->second)])),
        "are the units right? offsets.unit is that of the positions, offsets.deviation_unit that of the deviations"};
    io::read_deviation_map(table.file, how);
  }
  constexpr double kStep = 1e-6;  // [m] steps below are those of rounded tables
  const bool closed = body == Body::wheel && (map.grid.nx + 0.5) * map.grid.dx > 2.0 * std::numbers::pi;
  if (const double step = at_border(map, closed); step > kStep)
    surface.note += fmt::format(
        "the deviations of {} are up to {:.3g} mm at its border, where the surface steps back to what it was. ",
        table.file.filename().string(), 1e3 * step);
  return map;
}

}  // namespace treadmark::app
