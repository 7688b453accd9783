// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/region_extent.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/to_whole.hpp"

namespace treadmark::detection {
namespace {

// Least and greatest zero crossing over all lines; gap(line, i) along a line, position(i). Of a line the outermost
// points that penetrate have them.
template <class Gap, class Position>
void crossings(int lines_begin, int lines_end, int begin, int end, Gap&& gap, Position&& position, double& low,
               double& high) {
  for (int line = lines_begin; line <= lines_end; ++line) {
    const auto towards = [&](int i, int j) {
      if (j < begin || j > end) return position(i);
      const double here = gap(line, i), there = gap(line, j);
      if (!(there >= 0.0)) return std::isnan(there) ? position(j) : position(i);
      return position(i) + (position(j) - position(i)) * here / (here - there);
    };
    int first = begin, last = end;
    while (first <= end && !(gap(line, first) < 0.0)) ++first;
    if (first > end) continue;
    while (!(gap(line, last) < 0.0)) --last;
    low = std::min(low, towards(first, first - 1));
    high = std::max(high, towards(last, last + 1));
  }
}

}  // namespace

Rectangle crossing_extent(const GapField& field, double wheel_dz, const Region& r) {
  const Grid2& g = field.grid();
  Rectangle box{g.x(r.ix_deepest), g.x(r.ix_deepest), g.y(r.iy_deepest), g.y(r.iy_deepest)};
  crossings(
      r.iy_min, r.iy_max, r.ix_min, r.ix_max, [&](int iy, int ix) { return field.gap(ix, iy) - wheel_dz; },
      [&](int ix) { return g.x(ix); }, box.x_min, box.x_max);
  crossings(
      r.ix_min, r.ix_max, r.iy_min, r.iy_max, [&](int ix, int iy) { return field.gap(ix, iy) - wheel_dz; },
      [&](int iy) { return g.y(iy); }, box.y_min, box.y_max);
  return box;
}

double rail_height_near(const GapField& field, int ix, double y) {
  const Grid2& g = field.grid();
  const double position = std::clamp((y - g.y0) / g.dy, 0.0, static_cast<double>(g.ny - 1));
  const int iy = std::min(to_whole<int>(position), g.ny - 2);
  const double fraction = position - iy;
  const double low = field.rail_z(ix, iy), high = field.rail_z(ix, iy + 1);
  if (std::isnan(low) && std::isnan(high)) {
    for (int step = 1; step < g.ny; ++step)
      for (const int candidate : {iy - step, iy + step})
        if (candidate >= 0 && candidate < g.ny && !std::isnan(field.rail_z(ix, candidate)))
          return field.rail_z(ix, candidate);
    return low;
  }
  if (std::isnan(low)) return high;
  if (std::isnan(high)) return low;
  return low + fraction * (high - low);
}

}  // namespace treadmark::detection
