// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/rigid_slip.hpp"

namespace treadmark::kalker {

Field2 rigid_slip(const Patch& patch, const Creepage& creepage, double spin_offset_factor) {
  const std::size_t n = patch.cell.size();
  Field2 w(2 * n);
  const double direction = patch.transport == Transport::backward ? -1.0 : 1.0;
  const bool rolling = patch.transport != Transport::none;
  const double step = rolling ? patch.grid.dx : 1.0;
  const double offset = rolling ? direction * spin_offset_factor * patch.grid.dx : 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = patch.grid.x(patch.column[i]) - creepage.spin_x + offset;
    const double y = patch.grid.y(patch.row[i]) - creepage.spin_y;
    w[i] = step * (creepage.xi - creepage.phi * y);
    w[n + i] = step * (creepage.eta + creepage.phi * x);
  }
  return w;
}

}  // namespace treadmark::kalker
