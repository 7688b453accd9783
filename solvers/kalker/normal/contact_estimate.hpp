// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::kalker {

/// A guess from which the normal solution starts when no earlier solution is at hand.
struct ContactEstimate {
  double least_gap = 0.0;  ///< min h [m]
  double threshold = 0.0;  ///< elements with h - least_gap below it are thought to be in contact [m]
  double approach = 0.0;   ///< [m]; 0 = unknown
};

/// Approach and contact area from the prescribed force or approach and the interpenetration volume below a plane; exact
/// for spheres. There must be contact: a positive force, or an approach above the least gap.
ContactEstimate estimate_contact(const ContactProblem& problem, std::span<const double> gap,
                                 const CombinedMaterial& material);

}  // namespace treadmark::kalker
