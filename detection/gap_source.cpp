// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/gap_source.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::detection {
namespace {

constexpr int kRowsPerLean = 8;

Rectangle spanned(const Grid2& g, const IndexBox& b) {
  return {g.x(b.ix), g.x(b.ix + b.nx - 1), g.y(b.iy), g.y(b.iy + b.ny - 1)};
}

IndexBox united(const IndexBox& a, const IndexBox& b) {
  const int ix = std::min(a.ix, b.ix), iy = std::min(a.iy, b.iy);
  return {ix, iy, std::max(a.ix + a.nx, b.ix + b.nx) - ix, std::max(a.iy + a.ny, b.iy + b.ny) - iy};
}

}  // namespace

/// A rectangle of whole tiles.
struct GapSource::Patch {
  IndexBox box;
  std::vector<GapField::Tile*> tiles;
};

GapSource::GapSource(const BodyPair& bodies, const Grid2& grid_T, const std::optional<WheelFacets>& facets)
    : bodies_(bodies), X_RT_(bodies.X_TR.inverse()), X_WT_(bodies.X_TW.inverse()), grid_(grid_T) {
  if (facets) facets_.emplace(*bodies.wheel, bodies.X_TW, *facets);
  const Grid2& g = grid_T;
  const int n = (g.ny - 1) / kRowsPerLean + 1;
  lean_.resize(static_cast<std::size_t>(n));
  bodies.rail->heights({X_RT_, {g.x(g.nx / 2), g.y(0) + 0.5 * kRowsPerLean * g.dy, 1.0, kRowsPerLean * g.dy, 1, n}},
                       {{}, {}, lean_});
}

GapBounds GapSource::bounds(const IndexBox& box) const { return bounds(box, 1, 1).front(); }

std::vector<GapBounds> GapSource::bounds(const IndexBox& first, int nx, int ny) const {
  const Rectangle r = spanned(grid_, first), wheel_r = facets_ ? facets_->reach(r) : r;
  const double step_x = first.nx * grid_.dx, step_y = first.ny * grid_.dy;
  const std::size_t n = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny);
  std::vector<HeightBounds> rail(n), wheel(n);
  if (n == 1) {
    rail[0] = bodies_.rail->height_bounds(X_RT_, r);
    wheel[0] = rail[0].empty ? rail[0] : bodies_.wheel->height_bounds(X_WT_, wheel_r);
  } else {
    bodies_.rail->height_bounds(X_RT_, {r, step_x, step_y, nx, ny}, rail);
    bodies_.wheel->height_bounds(X_WT_, {wheel_r, step_x, step_y, nx, ny}, wheel);
  }
  std::vector<GapBounds> gaps(n);
  for (std::size_t i = 0; i < n; ++i)
    if (!rail[i].empty && !wheel[i].empty)
      gaps[i] = {rail[i].z_min - wheel[i].z_max, rail[i].z_max - wheel[i].z_min, false, rail[i], wheel[i]};
  return gaps;
}

// In a frame P rolled by d a vertical line meets rail and wheel at points whose heights along P's normal differ by gap
// cos(d). The rail's point lies not before the outermost surface that P sees there, the wheel's not beyond: bounds of
// what P sees, over all places in P that these points may have, bound the gap.
double GapSource::least_close(const IndexBox& box, const GapBounds& bounds) const {
  const double slope = lean_[static_cast<std::size_t>((box.iy + box.ny / 2) / kRowsPerLean)];
  constexpr double kLevel = 0.02, kSteep = 3.0;
  if (!(std::abs(slope) > kLevel && std::abs(slope) < kSteep)) return bounds.low;
  const Rectangle rail_r = spanned(grid_, box), wheel_r = facets_ ? facets_->reach(rail_r) : rail_r;
  const double roll = std::atan(slope), sine = std::sin(roll), cosine = std::cos(roll);
  const double y_middle = 0.5 * (rail_r.y_min + rail_r.y_max), z_middle = 0.5 * (bounds.rail.z_min + bounds.rail.z_max);
  const Pose X_TP{{0.0, y_middle, z_middle}, rotation_x(roll)};
  const auto seen = [&](const Rectangle& r, const HeightBounds& z) {
    const double a = (z.z_min - z_middle) * sine, b = (z.z_max - z_middle) * sine;
    return Rectangle{r.x_min, r.x_max, (r.y_min - y_middle) * cosine + std::min(a, b),
                     (r.y_max - y_middle) * cosine + std::max(a, b)};
  };
  const HeightBounds n_rail = bodies_.rail->height_bounds(X_RT_ * X_TP, seen(rail_r, bounds.rail));
  const HeightBounds n_wheel = bodies_.wheel->height_bounds(X_WT_ * X_TP, seen(wheel_r, bounds.wheel));
  if (n_rail.empty || n_wheel.empty) return bounds.low;
  return std::max(bounds.low, (n_rail.z_min - n_wheel.z_max) / cosine);
}

void GapSource::fill(std::span<GapField::Tile* const> tiles) {
  // Columns of tiles first, then columns of the same length side by side.
  std::vector<Patch> columns, patches;
  std::vector<GapField::Tile*> sorted(tiles.begin(), tiles.end());
  ranges::sort(sorted, [](const auto* a, const auto* b) {
    return a->box.ix != b->box.ix ? a->box.ix < b->box.ix : a->box.iy < b->box.iy;
  });
  for (GapField::Tile* tile : sorted) {
    if (!columns.empty()) {
      Patch& last = columns.back();
      if (last.box.ix == tile->box.ix && last.box.iy + last.box.ny == tile->box.iy) {
        last.box = united(last.box, tile->box);
        last.tiles.push_back(tile);
        continue;
      }
    }
    columns.push_back({tile->box, {tile}});
  }
  constexpr std::size_t kLargest = 4096;  // points; enough work for one task
  for (Patch& column : columns) {
    const auto fits = [&](const Patch& p) {
      return p.box.iy == column.box.iy && p.box.ny == column.box.ny && p.box.ix + p.box.nx == column.box.ix &&
             p.box.size() + column.box.size() <= kLargest;
    };
    const auto beside = std::find_if(patches.rbegin(), patches.rend(), fits);
    if (beside == patches.rend()) {
      patches.push_back(std::move(column));
      continue;
    }
    beside->box = united(beside->box, column.box);
    beside->tiles.insert(beside->tiles.end(), column.tiles.begin(), column.tiles.end());
  }
  // The facets of a wheel are made as they are needed, by one thread.
  if (facets_ || patches.size() < 2)
    for (const Patch& p : patches) fill_patch(p);
  else
    parallel_for(patches.size(), [&](std::size_t i) { fill_patch(patches[i]); });
}

void GapSource::fill_patch(const Patch& patch) {
  const IndexBox& box = patch.box;
  const Grid2 part = part_of(grid_, box);
  const std::size_t n = box.size();
  const bool alone = patch.tiles.size() == 1;
  const std::unique_ptr<double[]> scratch(new double[alone ? 0 : 3 * n]);
  const auto array = [&](std::size_t i, std::span<double> of_tile) {
    return alone ? of_tile : std::span(scratch.get() + i * n, n);
  };
  GapField::Tile& first = *patch.tiles.front();
  const std::span<double> wheel_z = array(0, first.gap), rail_z = array(1, first.rail_z),
                          slope = array(2, first.rail_slope);
  bodies_.rail->heights({X_RT_, part}, {rail_z, {}, facets_ ? std::span<double>() : slope});
  if (facets_) {
    std::vector<double> of_section(static_cast<std::size_t>(part.ny));
    bodies_.rail->heights({X_RT_, {0.0, part.y0, 1.0, part.dy, 1, part.ny}}, {{}, {}, of_section});
    for (std::size_t i = 0; i < n; ++i) slope[i] = of_section[i / static_cast<std::size_t>(part.nx)];
    facets_->heights(part, wheel_z);
  } else {
    bodies_.wheel->heights({X_WT_, part}, {wheel_z, {}, {}});
  }

  if (alone) {
    for (std::size_t i = 0; i < n; ++i) first.gap[i] = first.rail_z[i] - first.gap[i];
    first.close();
    return;
  }
  for (GapField::Tile* tile : patch.tiles) {
    for (int iy = 0; iy < tile->box.ny; ++iy) {
      const std::size_t to = static_cast<std::size_t>(iy) * static_cast<std::size_t>(tile->box.nx);
      const std::size_t from = static_cast<std::size_t>(tile->box.iy - box.iy + iy) * static_cast<std::size_t>(box.nx) +
                               static_cast<std::size_t>(tile->box.ix - box.ix);
      for (std::size_t i = 0; i < static_cast<std::size_t>(tile->box.nx); ++i) {
        tile->rail_z[to + i] = rail_z[from + i];
        tile->rail_slope[to + i] = slope[from + i];
        tile->gap[to + i] = rail_z[from + i] - wheel_z[from + i];
      }
    }
    tile->close();
  }
}

}  // namespace treadmark::detection
