// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/solvers/kalker/tangential/patch.hpp"
#include "treadmark/solvers/kalker/tangential/rolling_step.hpp"

namespace treadmark::kalker {

/// Slip distance per step of rigid bodies [m] in every element of a patch. The spin acts about its centre, seen from
/// where material is during the step on average (spin_offset_factor).
Field2 rigid_slip(const Patch& patch, const RollingStep& step, const Creepage& creepage, double spin_offset_factor);

/// Slip distance per step that tractions of this instant have nothing to do with, as a function of creepage.
struct KnownSlip {
  const Patch* patch = nullptr;
  RollingStep step;
  double spin_offset_factor = 0.0;
  std::vector<double> share;  ///< of the step during which an element's material has been in contact; empty: 1
  Field2 other;  ///< independent of creepage [m]: previous displacements, pressures of dissimilar bodies, given slip;
                 ///< empty: 0

  Field2 at(const Creepage& creepage) const;
  /// The part that is proportional to creepage.
  Field2 rigid(const Creepage& creepage) const;
  /// Change per unit of xi (component 0) or eta (1).
  Field2 per_unit(int component) const;
};

}  // namespace treadmark::kalker
