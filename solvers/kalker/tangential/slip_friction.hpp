// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/model/contact/friction.hpp"
#include "treadmark/solvers/kalker/tangential/patch.hpp"

namespace treadmark::kalker {

/// The law of each element: one for all, or one for each row of the grid.
struct FrictionOfPatch {
  const FrictionLaw* all = nullptr;
  std::span<const FrictionLaw> rows;

  const FrictionLaw& at(const Patch& patch, std::size_t i) const {
    return rows.empty() ? *all : rows[static_cast<std::size_t>(patch.row[i])];
  }
  /// Nowhere dependent on slip.
  bool constant() const;
};
FrictionOfPatch friction_of(const ContactProblem& problem);

/// Coefficient of friction of every element from the slip speeds [m/s], with memory: on its way through the contact a
/// particle starts with static friction, and forgets it over the memory distance that it slides, at least at the memory
/// velocity (Vollebregt 2014). time_step: of the step from the previous instant [s]. before: coefficients of the
/// material a step ago; none: steady rolling, the element ahead has them. temperature: of body 1's surface [deg C], for
/// laws that depend on it.
std::vector<double> friction_of_slip(const Patch& patch, const FrictionOfPatch& laws,
                                     std::span<const double> slip_speed, double time_step,
                                     std::span<const double> before = {}, std::span<const double> temperature = {});

}  // namespace treadmark::kalker
