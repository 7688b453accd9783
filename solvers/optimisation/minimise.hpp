// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "treadmark/core/report.hpp"

namespace treadmark::optimisation {

/// What is known at a point.
struct PointValues {
  double objective = 0.0;
  std::vector<double> gradient;     ///< of the objective
  std::vector<double> constraints;  ///< should not be above 0
  std::vector<double> jacobian;     ///< of the constraints, row by row
};

/// Which algorithm of NLopt.
enum class Method {
  slsqp,  ///< sequential quadratic programming (Kraft 1988)
  mma,    ///< method of moving asymptotes (Svanberg 2002)
};

/// A function of some variables that is to become least. Variables, objective and constraints should be of the order
/// of 1.
struct Minimisation {
  std::vector<double> start, lower, upper;  ///< of one size > 0; bounds may be infinite
  std::size_t constraints = 0;              ///< how many
  /// Called for one point after the other, the same ones in every run. Nothing: there are no numbers at this point, and
  /// the search turns back. What it throws ends the search and is thrown on.
  std::function<std::optional<PointValues>(const std::vector<double>& point)> at;
  Method method = Method::slsqp;
  /// Ends the search: change of the objective as a share of it, or of every variable, from one step to the next.
  double tolerance = 1e-4;
};

/// How it ended and at which point. Status: ok, a minimum as far as the tolerance; not_converged, no better point is
/// found along the gradients, or none that has numbers; failed, the constraints contradict each other or the numbers
/// make no sense. Of ok, too, callers see whether the point keeps the constraints.
struct Minimum {
  Report report;
  std::vector<double> point;
};

/// Errors: those of at().
Minimum minimise(const Minimisation& problem);

}  // namespace treadmark::optimisation
