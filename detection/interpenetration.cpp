// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/interpenetration.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::detection {
namespace {

struct Minimum {
  int ix, iy;
  double gap;
};

// A point is a local minimum if it is strictly below its lower-index neighbours and not above the others,
// so that one point of a plateau remains. NaN compares false: a missing neighbour never vetoes.
std::vector<Minimum> local_minima(const GapField& field, double below) {
  const Grid2& g = field.grid;
  const auto at = [&](int ix, int iy) { return field.gap[g.index(ix, iy)]; };
  std::vector<Minimum> minima;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const double v = at(ix, iy);
      if (!(v < below)) continue;
      if (ix > 0 && at(ix - 1, iy) <= v) continue;
      if (iy > 0 && at(ix, iy - 1) <= v) continue;
      if (ix + 1 < g.nx && at(ix + 1, iy) < v) continue;
      if (iy + 1 < g.ny && at(ix, iy + 1) < v) continue;
      minima.push_back({ix, iy, v});
    }
  std::stable_sort(minima.begin(), minima.end(), [](const Minimum& a, const Minimum& b) { return a.gap < b.gap; });
  return minima;
}

// Box around all penetration that hangs together with the minimum, diagonals included, plus a guard row all round.
void grow_box(const GapField& field, Region& r) {
  const Grid2& g = field.grid;
  const auto penetrates = [&](int ix, int iy) {
    return ix >= 0 && iy >= 0 && ix < g.nx && iy < g.ny && field.gap[g.index(ix, iy)] < 0.0;
  };
  const auto column = [&](int ix) {
    for (int iy = r.iy_min - 1; iy <= r.iy_max + 1; ++iy)
      if (penetrates(ix, iy)) return true;
    return false;
  };
  const auto row = [&](int iy) {
    for (int ix = r.ix_min - 1; ix <= r.ix_max + 1; ++ix)
      if (penetrates(ix, iy)) return true;
    return false;
  };
  for (bool grown = true; grown;) {
    grown = false;
    if (column(r.ix_min - 1)) --r.ix_min, grown = true;
    if (column(r.ix_max + 1)) ++r.ix_max, grown = true;
    if (row(r.iy_min - 1)) --r.iy_min, grown = true;
    if (row(r.iy_max + 1)) ++r.iy_max, grown = true;
  }
  r.ix_min = std::max(0, r.ix_min - 1);
  r.iy_min = std::max(0, r.iy_min - 1);
  r.ix_max = std::min(g.nx - 1, r.ix_max + 1);
  r.iy_max = std::min(g.ny - 1, r.iy_max + 1);
}

void weigh(const GapField& field, PenetrationWeight weight, Region& r) {
  const Grid2& g = field.grid;
  double sum = 0.0, sum_x = 0.0, sum_y = 0.0, sum_z = 0.0, sum_a = 0.0;
  for (int iy = r.iy_min; iy <= r.iy_max; ++iy)
    for (int ix = r.ix_min; ix <= r.ix_max; ++ix) {
      const std::size_t i = g.index(ix, iy);
      const double gap = field.gap[i];
      if (!(gap < 0.0)) continue;
      const double w = weight == PenetrationWeight::squared ? gap * gap : -gap;
      sum += w;
      sum_x += w * g.x(ix);
      sum_y += w * g.y(iy);
      sum_z += w * field.rail_z[i];
      sum_a += w * field.inclination[i];
    }
  r.weight = sum * g.cell_area();
  r.x = sum_x / sum;
  r.y = sum_y / sum;
  r.z = sum_z / sum;
  r.inclination = sum_a / sum;
}

}  // namespace

std::vector<Region> find_regions(const GapField& field, PenetrationWeight weight, double near_miss_gap) {
  constexpr int kMaxNearMisses = 2;
  std::vector<Region> regions;
  int near_misses = 0;
  for (const Minimum& m : local_minima(field, std::max(0.0, near_miss_gap))) {
    const bool known = std::any_of(regions.begin(), regions.end(), [&](const Region& r) {
      return m.ix >= r.ix_min && m.ix <= r.ix_max && m.iy >= r.iy_min && m.iy <= r.iy_max;
    });
    if (known) continue;
    Region r;
    r.ix_min = r.ix_max = r.ix_deepest = m.ix;
    r.iy_min = r.iy_max = r.iy_deepest = m.iy;
    r.least_gap = m.gap;
    if (m.gap < 0.0) {
      grow_box(field, r);
      weigh(field, weight, r);
    } else {
      if (++near_misses > kMaxNearMisses) break;
      const std::size_t i = field.grid.index(m.ix, m.iy);
      r.x = field.grid.x(m.ix);
      r.y = field.grid.y(m.iy);
      r.z = field.rail_z[i];
      r.inclination = field.inclination[i];
    }
    regions.push_back(r);
  }
  return regions;
}

}  // namespace treadmark::detection
