// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"

namespace treadmark::app {

/// Basic contact cases that follow each other in time.
class BasicSequence {
 public:
  /// Errors: Error for input that makes no sense. Non-convergence is a status.
  io::CaseResult solve(const io::BasicCase& input);
  /// Forgets the cases so far.
  void reset() { solver_.reset(); }

 private:
  kalker::ContactSolver solver_;
  kalker::ContactSolver coarse_solver_;  ///< to estimate what refining would change
};

/// The Hertzian ellipse of a case; none where its geometry is not Hertzian. Errors: Error(configuration).
std::optional<kalker::HertzShape> hertz_shape(const io::BasicCase& input);

/// Undeformed distance [m] of a formula at the element centres of a grid.
/// Errors: Error(configuration) if the number of coefficients does not fit the formula or the grid.
std::vector<double> gap_of_formula(const io::GapInput& input, const Grid2& grid);

/// Takes elements out of the gap (NaN) where the planform forbids contact; divides it into coupled sub-patches.
void restrict_contact(const io::PlanformInput& input, const Grid2& grid, std::vector<double>& gap,
                      kalker::SubPatches& sub_patches);

}  // namespace treadmark::app
