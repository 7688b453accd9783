// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"

namespace treadmark::app {

/// Basic contact cases that follow each other in time.
class BasicSequence {
 public:
  /// Errors: Error for input that makes no sense. Non-convergence is a status.
  io::CaseResult solve(const io::BasicCase& input);

 private:
  kalker::ContactSolver solver_;
};

}  // namespace treadmark::app
