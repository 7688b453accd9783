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

namespace {

/// A product that is asked for once costs less than its coefficients: of these sizes there are few.
int size_for_once(int n) {
  constexpr int kSmallest = 8, kLargest = 128;
  if (n == 1) return n;
  if (n > kLargest) return roomy_columns(n);
  int size = kSmallest;
  while (size < n) size = size % 3 == 0 ? size / 3 * 4 : size / 2 * 3;  // 8, 12, 16, 24, ...
  return size;
}

}  // namespace

void half_space_displacement(NormalOperatorCache& operators, const ContactProblem& problem, const ElementBox& box,
                             std::span<const double> pressure, std::span<double> displacement) {
  const Grid2& grid = problem.grid;
  // Beyond the box, possibly beyond the grid, there are no pressures; the size is one that transforms like.
  const int nx = size_for_once(box.nx()), ny = size_for_once(box.ny());
  AlignedVector<double> field(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
  const auto local = [&](int ix, int iy) {
    return static_cast<std::size_t>(ix - box.x0) + static_cast<std::size_t>(nx) * static_cast<std::size_t>(iy - box.y0);
  };
  for (int iy = box.y0; iy < box.y1; ++iy)
    for (int ix = box.x0; ix < box.x1; ++ix) field[local(ix, iy)] = pressure[grid.index(ix, iy)];
  operators.get(nx, ny, box.y0, problem).displacement(field, field);
  for (int iy = box.y0; iy < box.y1; ++iy)
    for (int ix = box.x0; ix < box.x1; ++ix) displacement[grid.index(ix, iy)] = field[local(ix, iy)];
}

}  // namespace treadmark::kalker
