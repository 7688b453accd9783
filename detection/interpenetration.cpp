// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/interpenetration.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::detection {
namespace {

struct Minimum {
  int ix, iy;
  double gap;
};

// A point is a local minimum if it is strictly below its lower-index neighbours and not above the others,
// so that one point of a plateau remains. NaN compares false: a missing neighbour never vetoes.
std::vector<Minimum> local_minima(const GapField& field, double wheel_dz, double below) {
  const Grid2& g = field.grid();
  std::vector<Minimum> minima;
  for (const auto& tile : field.tiles()) {
    if (!tile || !(tile->least - wheel_dz < below)) continue;
    const IndexBox& box = tile->box;
    const auto nx = static_cast<std::size_t>(box.nx);
    for (int iy = box.iy; iy < box.iy + box.ny; ++iy)
      for (int ix = box.ix; ix < box.ix + box.nx; ++ix) {
        const std::size_t i = tile->index(ix, iy);
        const double v = tile->gap[i];
        if (!(v - wheel_dz < below)) continue;
        if (ix > 0 && (ix > box.ix ? tile->gap[i - 1] : field.gap(ix - 1, iy)) <= v) continue;
        if (iy > 0 && (iy > box.iy ? tile->gap[i - nx] : field.gap(ix, iy - 1)) <= v) continue;
        if (ix + 1 < g.nx && (ix + 1 < box.ix + box.nx ? tile->gap[i + 1] : field.gap(ix + 1, iy)) < v) continue;
        if (iy + 1 < g.ny && (iy + 1 < box.iy + box.ny ? tile->gap[i + nx] : field.gap(ix, iy + 1)) < v) continue;
        minima.push_back({ix, iy, v - wheel_dz});
      }
  }
  ranges::sort(minima, [](const Minimum& a, const Minimum& b) {
    return std::tie(a.gap, a.iy, a.ix) < std::tie(b.gap, b.iy, b.ix);
  });
  return minima;
}

// Box around all penetration that hangs together with the minimum, diagonals included, plus a guard row all round.
void grow_box(const GapField& field, double wheel_dz, Region& r) {
  const Grid2& g = field.grid();
  const auto penetrates = [&](int ix, int iy) {
    return ix >= 0 && iy >= 0 && ix < g.nx && iy < g.ny && field.gap(ix, iy) - wheel_dz < 0.0;
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
  // The cross through the minimum belongs to the box: a start that leaves little to grow.
  while (penetrates(r.ix_min - 1, r.iy_deepest)) --r.ix_min;
  while (penetrates(r.ix_max + 1, r.iy_deepest)) ++r.ix_max;
  while (penetrates(r.ix_deepest, r.iy_min - 1)) --r.iy_min;
  while (penetrates(r.ix_deepest, r.iy_max + 1)) ++r.iy_max;
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

void weigh(const GapField& field, double wheel_dz, PenetrationWeight weight, Region& r) {
  const Grid2& g = field.grid();
  double sum = 0.0, sum_x = 0.0, sum_y = 0.0, sum_z = 0.0, sum_a = 0.0;
  // A rail mostly has one slope along a row.
  double slope = 0.0, inclination = 0.0;
  for (int iy = r.iy_min; iy <= r.iy_max; ++iy) {
    const double y = g.y(iy);
    for (int ix = r.ix_min; ix <= r.ix_max; ++ix) {
      const GapField::Tile* tile = field.tile_of(ix, iy);
      if (tile == nullptr) continue;
      const std::size_t i = tile->index(ix, iy);
      const double gap = tile->gap[i] - wheel_dz;
      if (!(gap < 0.0)) continue;
      if (tile->rail_slope[i] != slope) slope = tile->rail_slope[i], inclination = std::atan(slope);
      const double w = weight == PenetrationWeight::squared ? gap * gap : -gap;
      sum += w;
      sum_x += w * g.x(ix);
      sum_y += w * y;
      sum_z += w * tile->rail_z[i];
      sum_a += w * inclination;
    }
  }
  r.weight = sum * g.cell_area();
  r.x = sum_x / sum;
  r.y = sum_y / sum;
  r.z = sum_z / sum;
  r.inclination = sum_a / sum;
}

}  // namespace

std::vector<Region> find_regions(const GapField& field, double wheel_dz, std::optional<PenetrationWeight> weight,
                                 double near_miss_gap) {
  const Grid2& g = field.grid();
  constexpr int kMaxNearMisses = 2;
  std::vector<Region> regions;
  int near_misses = 0;
  for (const Minimum& m : local_minima(field, wheel_dz, std::max(0.0, near_miss_gap))) {
    const bool known = std::any_of(regions.begin(), regions.end(), [&](const Region& r) {
      return m.ix >= r.ix_min && m.ix <= r.ix_max && m.iy >= r.iy_min && m.iy <= r.iy_max;
    });
    if (known) continue;
    Region r;
    r.ix_min = r.ix_max = r.ix_deepest = m.ix;
    r.iy_min = r.iy_max = r.iy_deepest = m.iy;
    r.least_gap = m.gap;
    if (m.gap < 0.0) {
      grow_box(field, wheel_dz, r);
      if (weight) weigh(field, wheel_dz, *weight, r);
    } else {
      if (++near_misses > kMaxNearMisses) break;
      r.x = g.x(m.ix);
      r.y = g.y(m.iy);
      r.z = field.rail_z(m.ix, m.iy);
      r.inclination = std::atan(field.rail_slope(m.ix, m.iy));
    }
    regions.push_back(r);
  }
  return regions;
}

}  // namespace treadmark::detection
