// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/closest_gap.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "treadmark/core/cancellation.hpp"

namespace treadmark::detection {
namespace {

std::pair<int, int> deepest_point(const GapField& field) {
  const Grid2& g = field.grid();
  std::pair<int, int> at{0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix)
      if (field.gap(ix, iy) < least) least = field.gap(ix, iy), at = {ix, iy};
  return at;
}

}  // namespace

double vertex(double before, double here, double after) {
  const double bend = before - 2.0 * here + after, slope = 0.5 * (after - before);
  if (!(bend > 0.0) || !(before >= here && after >= here)) return here;
  return here - 0.5 * slope * slope / bend;
}

double vertex(const GapField& field, int ix, int iy) {
  const Grid2& g = field.grid();
  const double here = field.gap(ix, iy);
  if (ix < 1 || iy < 1 || ix + 1 >= g.nx || iy + 1 >= g.ny) return here;
  const double west = field.gap(ix - 1, iy), east = field.gap(ix + 1, iy), south = field.gap(ix, iy - 1),
               north = field.gap(ix, iy + 1);
  const double slope_x = 0.5 * (east - west), slope_y = 0.5 * (north - south);
  const double xx = east - 2.0 * here + west, yy = north - 2.0 * here + south;
  const double xy = 0.25 * (field.gap(ix + 1, iy + 1) - field.gap(ix - 1, iy + 1) - field.gap(ix + 1, iy - 1) +
                            field.gap(ix - 1, iy - 1));
  const double determinant = xx * yy - xy * xy;
  if (!(xx > 0.0 && determinant > 0.0)) return here;
  const double step_x = -(yy * slope_x - xy * slope_y) / determinant,
               step_y = -(xx * slope_y - xy * slope_x) / determinant;
  constexpr double kFarthest = 1.0;  // beyond the neighbours it is no paraboloid
  if (!(std::abs(step_x) <= kFarthest && std::abs(step_y) <= kFarthest)) return here;
  return here + 0.5 * (slope_x * step_x + slope_y * step_y);
}

double closest_about(const BodyPair& bodies, const GapField& field, int ix, int iy) {
  // Curvature of profiles jumps: a parabola over steps of a few micrometres is good to a nanometre there too.
  constexpr double kFinest = 4e-6;
  constexpr int kPoints = 9;
  const Grid2& g = field.grid();
  Grid2 fine = g;
  double x = g.x(ix), y = g.y(iy), least = vertex(field, ix, iy);
  constexpr int kMostGrids = 60;  // each is four times as fine
  for (int left = kMostGrids; left > 0 && std::fmax(fine.dx, fine.dy) > kFinest; --left) {
    check_cancelled();
    const double step_x = 2.0 * fine.dx / (kPoints - 1), step_y = 2.0 * fine.dy / (kPoints - 1);
    fine = {x - fine.dx, y - fine.dy, step_x, step_y, kPoints, kPoints};
    const GapField closer = gap_field(bodies, fine);
    const auto [jx, jy] = deepest_point(closer);
    least = std::fmin(closer.gap(jx, jy), vertex(closer, jx, jy));
    x = fine.x(jx), y = fine.y(jy);
  }
  return least;
}

}  // namespace treadmark::detection
