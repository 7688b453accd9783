// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/patch_memory.hpp"

#include <algorithm>
#include <cmath>
#include <compare>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::wheelrail {
namespace {

/// Columns ix_min .. ix_max and rows iy_min .. iy_max of a raster.
struct Lines {
  long ix_min, ix_max, iy_min, iy_max;
};

Lines lines_of(const Grid2& g) {
  const long ix = to_whole<long>(std::round(g.x0 / g.dx)), iy = to_whole<long>(std::round(g.y0 / g.dy));
  return {ix, ix + g.nx - 1, iy, iy + g.ny - 1};
}

Lines united(const Lines& a, const Lines& b) {
  return {std::min(a.ix_min, b.ix_min), std::max(a.ix_max, b.ix_max), std::min(a.iy_min, b.iy_min),
          std::max(a.iy_max, b.iy_max)};
}

Grid2 grid_of(const Lines& l, double dx, double ds) {
  return {static_cast<double>(l.ix_min) * dx,        static_cast<double>(l.iy_min) * ds,       dx, ds,
          static_cast<int>(l.ix_max - l.ix_min + 1), static_cast<int>(l.iy_max - l.iy_min + 1)};
}

/// How far a point lies from a rectangle, and within it from its middle.
struct Farness {
  double outside = 0.0, from_middle = 0.0;

  Farness(const Rectangle& r, double x, double y) {
    outside = std::hypot(std::max({r.x_min - x, x - r.x_max, 0.0}), std::max({r.y_min - y, y - r.y_max, 0.0}));
    from_middle = std::hypot((2.0 * x - r.x_min - r.x_max) / (r.x_max - r.x_min),
                             (2.0 * y - r.y_min - r.y_max) / (r.y_max - r.y_min));
  }
  auto operator<=>(const Farness&) const = default;
};

void add(std::vector<double>& sum, const std::vector<double>& field) {
  if (field.empty()) return;
  if (sum.empty()) sum.assign(field.size(), 0.0);
  for (std::size_t i = 0; i < field.size(); ++i) sum[i] += field[i];
}

}  // namespace

std::vector<const PatchMemory*> overlapping(const Instant& instant, const Rectangle& box) {
  std::vector<const PatchMemory*> found;
  for (const PatchMemory& m : instant.patches)
    if (m.box.x_min <= box.x_max && box.x_min <= m.box.x_max && m.box.y_min <= box.y_max && box.y_min <= m.box.y_max)
      found.push_back(&m);
  return found;
}

kalker::ContactHistory on_raster(const kalker::ContactHistory& history, double shift_x, double dx, double ds) {
  constexpr double kSameSize = 1e-4;
  const Grid2& g = history.grid;
  if (std::abs(g.dx - dx) > kSameSize * dx || std::abs(g.dy - ds) > kSameSize * ds)
    throw Error(ErrorKind::configuration, "elements of another size than at the previous instant", {},
                "keep dx, ds through a sequence in time, or start without history");
  kalker::ContactHistory moved = history;
  moved.grid.dx = dx;
  moved.grid.dy = ds;
  moved.grid.x0 = std::round((g.x0 + shift_x) / dx) * dx;
  moved.grid.y0 = std::round(g.y0 / ds) * ds;
  return moved;
}

kalker::ContactHistory own_share(kalker::ContactHistory history, const Rectangle& box,
                                 const std::vector<Rectangle>& others) {
  if (others.empty()) return history;
  const Grid2& g = history.grid;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const double x = g.x(ix), y = g.y(iy);
      const Farness own(box, x, y);
      if (ranges::none_of(others, [&](const Rectangle& other) { return Farness(other, x, y) < own; })) continue;
      for (auto* field :
           {&history.pressure, &history.traction_x, &history.traction_y, &history.layer_x, &history.layer_y})
        if (!field->empty()) (*field)[g.index(ix, iy)] = 0.0;
    }
  return history;
}

kalker::ContactHistory united(const std::vector<kalker::ContactHistory>& histories, double static_friction,
                              double first_yield_stress) {
  if (histories.size() == 1) return histories.front();
  Lines lines = lines_of(histories.front().grid);
  for (const auto& h : histories) lines = united(lines, lines_of(h.grid));
  kalker::ContactHistory sum;
  sum.grid = grid_of(lines, histories.front().grid.dx, histories.front().grid.dy);
  std::vector<double> most(sum.grid.size(), 0.0);
  for (const auto& h : histories) {
    const kalker::ContactHistory part = kalker::on_grid(h, sum.grid, static_friction, first_yield_stress);
    add(sum.pressure, part.pressure);
    add(sum.traction_x, part.traction_x);
    add(sum.traction_y, part.traction_y);
    add(sum.plastic_x, part.plastic_x);
    add(sum.plastic_y, part.plastic_y);
    add(sum.layer_x, part.layer_x);
    add(sum.layer_y, part.layer_y);
    const auto take = [&](std::vector<double>& field, const std::vector<double>& from) {
      if (from.empty()) return;
      if (field.empty()) field = from;
      for (std::size_t i = 0; i < field.size(); ++i)
        if (part.pressure[i] > most[i]) field[i] = from[i];
    };
    take(sum.friction, part.friction);
    take(sum.yield_stress, part.yield_stress);
    for (std::size_t i = 0; i < most.size(); ++i) most[i] = std::max(most[i], part.pressure[i]);
  }
  return sum;
}

Grid2 extended(const Grid2& grid, const kalker::ContactHistory& history) {
  const Grid2& g = history.grid;
  Lines lines = lines_of(grid);
  const Lines from = lines_of(g);
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      if (!(history.pressure[g.index(ix, iy)] > 0.0)) continue;
      const long jx = from.ix_min + ix, jy = from.iy_min + iy;
      lines = united(lines, {jx, jx, jy, jy});
    }
  return grid_of(lines, grid.dx, grid.dy);
}

}  // namespace treadmark::wheelrail
