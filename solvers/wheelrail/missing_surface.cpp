// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/missing_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace treadmark::wheelrail {
namespace {

/// Calls visit(index) for the up to eight neighbours of an element.
template <class Visit>
void neighbours(const Grid2& g, std::size_t i, Visit visit) {
  const int x = static_cast<int>(i % static_cast<std::size_t>(g.nx)),
            y = static_cast<int>(i / static_cast<std::size_t>(g.nx));
  for (int iy = std::max(0, y - 1); iy <= std::min(g.ny - 1, y + 1); ++iy)
    for (int ix = std::max(0, x - 1); ix <= std::min(g.nx - 1, x + 1); ++ix)
      if (ix != x || iy != y) visit(g.index(ix, iy));
}

bool on_border(const Grid2& g, std::size_t i) {
  const int x = static_cast<int>(i % static_cast<std::size_t>(g.nx)),
            y = static_cast<int>(i / static_cast<std::size_t>(g.nx));
  return x == 0 || y == 0 || x == g.nx - 1 || y == g.ny - 1;
}

}  // namespace

MissingSurface missing_beside_contact(const Grid2& grid, std::span<const double> distance,
                                      std::span<const double> pressure) {
  MissingSurface found;
  std::vector<bool> seen(grid.size(), false);
  std::vector<std::size_t> part;
  for (std::size_t start = 0; start < grid.size(); ++start) {
    if (seen[start] || !std::isnan(distance[start])) continue;
    part.assign(1, start);
    seen[start] = true;
    bool border = false;
    int beside = 0;
    for (std::size_t k = 0; k < part.size(); ++k) {
      border = border || on_border(grid, part[k]);
      bool touches = false;
      neighbours(grid, part[k], [&](std::size_t j) {
        touches = touches || pressure[j] > 0.0;
        if (seen[j] || !std::isnan(distance[j])) return;
        seen[j] = true;
        part.push_back(j);
      });
      beside += touches ? 1 : 0;
    }
    if (beside == 0) continue;
    if (border)
      found.edge += beside;
    else
      found.hole += static_cast<int>(part.size());
  }
  return found;
}

}  // namespace treadmark::wheelrail
