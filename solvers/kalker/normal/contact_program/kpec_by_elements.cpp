// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/contact_program/kpec_by_elements.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::kalker {
namespace {

/// A of A x^2 through the deepest element and two at the same distance on both sides, beyond the level.
double curvature_along(const Interpenetration& overlap, double level) {
  const int iy = overlap.deepest_row(), ix = overlap.deepest_column(iy);
  const double least = -overlap.depth();
  int reach = 1;
  const int most = overlap.grid().nx;
  while (reach < most && std::max(overlap.distance(ix - reach, iy), overlap.distance(ix + reach, iy)) <= level) ++reach;
  double behind = overlap.distance(ix - reach, iy), ahead = overlap.distance(ix + reach, iy);
  if (reach > 1 && !(std::isfinite(behind) && std::isfinite(ahead))) {  // at the border: the last pair inside
    --reach;
    behind = overlap.distance(ix - reach, iy);
    ahead = overlap.distance(ix + reach, iy);
  }
  if (!std::isfinite(behind)) behind = ahead;
  if (!std::isfinite(ahead)) ahead = behind;
  if (!std::isfinite(ahead)) return kLeastCurvature;
  const double step = reach * overlap.grid().dx;
  return std::max(kLeastCurvature, (ahead - 2.0 * least + behind) / (2.0 * step * step));
}

/// Where the rows' least distance passes a level [m], going outwards from a row (direction -1 or +1).
double lateral_end(const Interpenetration& overlap, int iy, int direction, double level) {
  const int ix = overlap.deepest_column(iy);
  const double share = share_to_level(overlap.distance(ix, iy), overlap.distance(ix, iy + direction), level);
  return overlap.grid().y(iy) + direction * share * overlap.grid().dy;
}

}  // namespace

Outline outline_of_elements(const Interpenetration& overlap, double level) {
  int first = overlap.deepest_row(), last = first;
  for (int iy = overlap.box().y0; iy < overlap.box().y1; ++iy)
    if (overlap.least_distance(iy) < level) {
      first = std::min(first, iy);
      last = std::max(last, iy);
    }
  const double low = lateral_end(overlap, first, -1, level), high = lateral_end(overlap, last, 1, level);
  const double middle = 0.5 * (low + high);
  return {curvature_along(overlap, level), middle, 0.5 * (high - low),
          std::abs(overlap.grid().y(overlap.deepest_row()) - middle)};
}

double scale_at_deepest(const Interpenetration& overlap, std::span<const double> displacement) {
  const int iy = overlap.deepest_row();
  return overlap.depth() / displacement[overlap.grid().index(overlap.deepest_column(iy), iy)];
}

}  // namespace treadmark::kalker
