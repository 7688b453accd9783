// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/kalker/normal/interpenetration.hpp"

#include <cstddef>
#include <cstdlib>

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

bool sum_half_space_displacement(NormalOperatorCache& operators, const ContactProblem& problem, const ElementBox& box,
                                 std::span<const double> pressure, std::span<const std::size_t> elements,
                                 std::span<double> displacement) {
  constexpr std::size_t kMost = 4'000'000;  // pairs of elements
  const Grid2& grid = problem.grid;
  if (elements.size() * box.size() > kMost) return false;
  const auto width = static_cast<std::size_t>(grid.nx);
  ElementBox around = box;
  for (const std::size_t i : elements) around.include(static_cast<int>(i % width), static_cast<int>(i / width));
  const InfluenceTable* table = operators.half_spaces(around.nx(), around.ny());
  if (table == nullptr) return false;

  // Coefficients of a row at offsets from 1 - nx to nx - 1, so that each sum runs through them and the pressures side
  // by side.
  const int reach = around.nx(), length = 2 * reach - 1;
  std::vector<double> rows(static_cast<std::size_t>(length) * static_cast<std::size_t>(around.ny()));
  for (int diy = 0; diy < around.ny(); ++diy)
    for (int dix = 1 - reach; dix < reach; ++dix)
      rows[static_cast<std::size_t>(diy * length + dix + reach - 1)] = (*table)(dix, diy);
  struct Loaded {
    int iy, begin, end;
  };
  std::vector<Loaded> loaded;
  for (int iy = box.y0; iy < box.y1; ++iy) {
    Loaded row{iy, box.x0, box.x1};
    while (row.begin < row.end && !(pressure[grid.index(row.begin, iy)] > 0.0)) ++row.begin;
    while (row.begin < row.end && !(pressure[grid.index(row.end - 1, iy)] > 0.0)) --row.end;
    if (row.begin < row.end) loaded.push_back(row);
  }
  const double shear_modulus = combine(problem.material).shear_modulus;
  for (const std::size_t i : elements) {
    const int ix = static_cast<int>(i % width), iy = static_cast<int>(i / width);
    double sum[4] = {};
    for (const Loaded& row : loaded) {
      const double* p = pressure.data() + grid.index(row.begin, row.iy);
      const std::ptrdiff_t apart = std::abs(iy - row.iy);
      const double* c = rows.data() + apart * length + (row.begin - ix + reach - 1);
      const int count = row.end - row.begin;
      int k = 0;
      for (; k + 4 <= count; k += 4)
        for (int lane = 0; lane < 4; ++lane) sum[lane] += p[k + lane] * c[k + lane];
      for (; k < count; ++k) sum[0] += p[k] * c[k];
    }
    displacement[i] = ((sum[0] + sum[1]) + (sum[2] + sum[3])) / shear_modulus;
  }
  return true;
}

}  // namespace treadmark::kalker
