// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/influence_table.hpp"

#include <algorithm>

namespace treadmark::kalker {

InfluenceTable::InfluenceTable(Component component, double dx, double dy, double poisson)
    : component_(component), dx_(dx), dy_(dy), poisson_(poisson), odd_(component == Component::xy) {}

void InfluenceTable::grow(int nx, int ny) {
  const int new_nx = std::max(nx, nx_), new_ny = std::max(ny, ny_);
  if (new_nx == nx_ && new_ny == ny_) return;
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(new_nx) * static_cast<std::size_t>(new_ny));
  for (int iy = 0; iy < new_ny; ++iy)
    for (int ix = 0; ix < new_nx; ++ix)
      values.push_back(ix < nx_ && iy < ny_ ? (*this)(ix, iy)
                                            : influence(component_, ix * dx_, iy * dy_, dx_, dy_, poisson_));
  values_ = std::move(values);
  nx_ = new_nx;
  ny_ = new_ny;
}

}  // namespace treadmark::kalker
