// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/rigid_slip.hpp"

namespace treadmark::kalker {

Field2 rigid_slip(const Patch& patch, const RollingStep& step, const Creepage& creepage, double spin_offset_factor) {
  const std::size_t n = patch.cell.size();
  Field2 w(2 * n);
  const double offset_x = spin_offset_factor * step.shift_x, offset_y = spin_offset_factor * step.shift_y;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = patch.grid.x(patch.column[i]) - creepage.spin_x + offset_x;
    const double y = patch.grid.y(patch.row[i]) - creepage.spin_y + offset_y;
    w[i] = step.distance * (creepage.xi - creepage.phi * y);
    w[n + i] = step.distance * (creepage.eta + creepage.phi * x);
  }
  return w;
}

Field2 KnownSlip::rigid(const Creepage& creepage) const {
  Field2 w = rigid_slip(*patch, step, creepage, spin_offset_factor);
  for (std::size_t i = 0; i < share.size(); ++i) {
    w[i] *= share[i];
    w[share.size() + i] *= share[i];
  }
  return w;
}

Field2 KnownSlip::at(const Creepage& creepage) const {
  Field2 w = rigid(creepage);
  for (std::size_t k = 0; k < other.size(); ++k) w[k] += other[k];
  return w;
}

Field2 KnownSlip::per_unit(int component) const {
  Creepage unit;
  (component == 0 ? unit.xi : unit.eta) = 1.0;
  return rigid(unit);
}

}  // namespace treadmark::kalker
