// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/interpenetration.hpp"

namespace treadmark::kalker {

Interpenetration::Interpenetration(const Grid2& grid, std::span<const double> gap, double approach)
    : grid_(grid), gap_(gap), approach_(approach), deepest_column_(static_cast<std::size_t>(grid.ny), 0) {
  for (int iy = 0; iy < grid.ny; ++iy) {
    int& deepest = deepest_column_[static_cast<std::size_t>(iy)];
    for (int ix = 0; ix < grid.nx; ++ix) {
      if (distance(ix, iy) < distance(deepest, iy)) deepest = ix;
      if (distance(ix, iy) < 0.0) box_.include(ix, iy);
    }
    if (least_distance(iy) < least_distance(deepest_row_)) deepest_row_ = iy;
  }
}

}  // namespace treadmark::kalker
