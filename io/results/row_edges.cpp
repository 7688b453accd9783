// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

std::vector<Vec2> row_edges(const PatchFields& fields, double reference_s) {
  const Grid2& grid = fields.grid;
  const double first = grid.y0 - 0.5 * grid.dy;
  std::vector<Vec2> edges;
  if (fields.row_angle.empty()) {
    for (int iy = 0; iy <= grid.ny; ++iy) edges.emplace_back(first + iy * grid.dy, 0.0);
    return edges;
  }
  edges.emplace_back(0.0, 0.0);
  for (const double angle : fields.row_angle)
    edges.push_back(edges.back() + grid.dy * Vec2(std::cos(angle), std::sin(angle)));
  // The reference lies between two edges.
  const double place = std::clamp((reference_s - first) / grid.dy, 0.0, static_cast<double>(grid.ny));
  const auto below = std::min(static_cast<std::size_t>(place), edges.size() - 2);
  const Vec2 reference = edges[below] + (place - static_cast<double>(below)) * (edges[below + 1] - edges[below]);
  for (Vec2& edge : edges) edge += Vec2(reference_s, 0.0) - reference;
  return edges;
}

}  // namespace treadmark::io
