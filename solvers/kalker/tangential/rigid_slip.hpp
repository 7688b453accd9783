// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/tangential/compliance.hpp"
#include "treadmark/solvers/kalker/tangential/patch.hpp"

namespace treadmark::kalker {

/// The step from the previous instant to this one.
struct RollingStep {
  Transport transport = Transport::none;  ///< steady rolling: the previous instant looks like this one
  bool rolling = false;                   ///< the contact moves over the material
  double distance = 1.0;                  ///< dq [m]; shift: 1, for creepages are lengths then
  double time = 1.0;                      ///< [s]; shift: 1
  double shift_x = 0.0, shift_y = 0.0;    ///< where the material came from, seen from where it is [m]
};

/// Errors: Error(configuration) for steady rolling in other directions than 0 and pi, and a velocity or step that is
/// not positive.
RollingStep rolling_step(const ContactProblem& problem);

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
