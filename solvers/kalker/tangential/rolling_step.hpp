// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/tangential/compliance.hpp"

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

}  // namespace treadmark::kalker
