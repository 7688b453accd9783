// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/head_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark::analytic {

namespace {

constexpr double kWidest = 0.25;  ///< [m] for bases without lateral ends
constexpr int kAlong = 33, kAcross = 2001;

/// Grid over a stretch of a base; no width where the base has none.
Grid2 stretch_grid(const Surface& base, const FlattenedHead& head) {
  const Box3 box = base.bounds();
  const double y = std::max(box.min.y(), -kWidest), width = std::min(box.max.y(), kWidest) - y;
  return {head.x_start, y, (head.x_end - head.x_start) / (kAlong - 1), width / (kAcross - 1), kAlong, kAcross};
}

/// Least z - y tan(roll) of a base over a stretch: the least of a fine grid, then of ever finer grids about it.
double least_height(const Surface& base, const FlattenedHead& head, double tan_roll) {
  constexpr int kFiner = 9, kRounds = 6;
  Grid2 g = stretch_grid(base, head);
  if (!(g.dy > 0.0)) return std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> z(g.size());
    base.heights({Pose{}, g}, {z, {}, {}});
    double x_least = g.x0, y_least = g.y0;
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) {
        const double h = z[g.index(ix, iy)] - g.y(iy) * tan_roll;
        if (!(h < least)) continue;
        least = h;
        x_least = g.x(ix);
        y_least = g.y(iy);
      }
    if (std::isinf(least)) return least;
    if (x_least == g.x0 && y_least == g.y0) break;
    const double x = std::max(head.x_start, x_least - g.dx), x_end = std::min(head.x_end, x_least + g.dx);
    g = {x, y_least - g.dy, (x_end - x) / (kFiner - 1), g.dy / (4 * kFiner), kFiner, 8 * kFiner + 1};
  }
  return least;
}

}  // namespace

HeadPlane::HeadPlane(const FlattenedHead& head, const Surface& base)
    : tan_roll(std::tan(head.roll)),
      touching(least_height(base, head, tan_roll)),
      x_start(head.x_start),
      x_end(head.x_end),
      ramp(head.ramp),
      depth(head.depth) {
  if (std::isinf(touching))
    throw Error(ErrorKind::configuration, "a flattened head lies where the rail has no surface");
  const Grid2 g = stretch_grid(base, head);
  std::vector<double> z(g.size()), z_x(g.size()), z_y(g.size());
  base.heights({Pose{}, g}, {z, z_x, z_y});
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const std::size_t i = g.index(ix, iy);
      if (!(z[i] - g.y(iy) * tan_roll < touching + depth)) continue;
      steepest_x = std::max(steepest_x, std::fabs(z_x[i]));
      steepest_y = std::max(steepest_y, std::fabs(z_y[i] - tan_roll));
    }
}

Jet HeadPlane::level(double x) const {
  const bool first = x < 0.5 * (x_start + x_end);
  const double t = (first ? x - x_start : x_end - x) / ramp, sign = first ? 1.0 : -1.0;
  if (t >= 1.0) return {touching + depth, 0.0, 0.0};
  return {touching + depth * t * t * (3.0 - 2.0 * t), sign * depth * 6.0 * t * (1.0 - t) / ramp,
          depth * 6.0 * (1.0 - 2.0 * t) / (ramp * ramp)};
}

}  // namespace treadmark::analytic
