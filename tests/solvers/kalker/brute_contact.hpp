// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <Eigen/Dense>

#include <vector>

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"

namespace treadmark::kalker::testing {

/// Where influence coefficients come from.
enum class Coefficients {
  closed_form,  ///< those of the solvers
  quadrature,   ///< the point solutions of Boussinesq and Cerruti, integrated numerically; nothing of the solvers
};

/// Tractions of a small contact [Pa] by an element.
struct BruteSolution {
  Eigen::VectorXd pressure, traction_x, traction_y;
  bool found = false;  ///< false: the rounds of dissimilar bodies, or sweeps, did not come to rest
};

/// The contact of a problem by dense matrices and nothing clever: pressures by trying which elements touch, tractions
/// by going from element to element, both in turns where the bodies are dissimilar. For constant elements of elastic
/// half-spaces under Coulomb friction at a given approach, of at most some hundred elements; shift, steady rolling
/// along x and the first step of rolling.
BruteSolution solve_by_force(const ContactProblem& problem, double approach, Coefficients coefficients);

}  // namespace treadmark::kalker::testing
