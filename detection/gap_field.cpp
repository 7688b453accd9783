// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/detection/gap_field.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/detection/gap_source.hpp"

namespace treadmark::detection {

Grid2 part_of(const Grid2& g, const IndexBox& b) { return {g.x(b.ix), g.y(b.iy), g.dx, g.dy, b.nx, b.ny}; }

GapField::Tile::Tile(const IndexBox& points) : box(points), numbers_(new double[3 * points.size()]) {
  const std::size_t n = points.size();
  rail_z = {numbers_.get(), n}, gap = {numbers_.get() + n, n}, rail_slope = {numbers_.get() + 2 * n, n};
}

void GapField::Tile::close() {
  least = std::numeric_limits<double>::infinity();
  for (const double g : gap)
    if (g < least) least = g;
}

GapField::GapField(const Grid2& grid, int log_x, int log_y)
    : grid_(grid),
      log_x_(log_x),
      log_y_(log_y),
      tiles_x_(((grid.nx - 1) >> log_x) + 1),
      tiles_y_(((grid.ny - 1) >> log_y) + 1),
      tiles_(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_)) {}

IndexBox GapField::tile_box(int tx, int ty) const {
  const int ix = tx << log_x_, iy = ty << log_y_;
  return {ix, iy, std::min(1 << log_x_, grid_.nx - ix), std::min(1 << log_y_, grid_.ny - iy)};
}

GapField::Tile& GapField::add_tile(int tx, int ty) {
  return *(tiles_[tile_index(tx, ty)] = std::unique_ptr<Tile>(new Tile(tile_box(tx, ty))));
}

GapField gap_field(const BodyPair& bodies, const Grid2& grid_T) {
  GapField field(grid_T);
  GapSource source(bodies, grid_T, std::nullopt);
  source.fill(field.add_tile(0, 0));
  return field;
}

}  // namespace treadmark::detection
