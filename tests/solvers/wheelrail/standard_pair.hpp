// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::wheelrail {

inline constexpr double kStandardRadius = 0.46;  ///< [m]

/// S1002 on 60E1.
inline Geometry standard_geometry() {
  return {analytic::make_standard_surface({"60E1"}, Body::rail, 0.0),
          analytic::make_standard_surface({"S1002"}, Body::wheel, kStandardRadius), true, true};
}

/// A right wheel a little aside and yawed, 60 kN, coarse elements.
inline Problem standard_problem() {
  Problem p;
  p.track.cant = 1.0 / 40.0;
  p.state.position = {0.0, 1.5e-3, 0.0, 2e-4, 3e-3, 0.0};
  p.state.velocity = {10.0, 0.02, 0.0, 1e-3, 2e-3, -10.0 / kStandardRadius * 0.9995};
  p.vertical_force = 6e4;
  p.discretisation.dx = p.discretisation.ds = 0.8e-3;
  return p;
}

/// Steady rolling on the very elements of a patch.
inline kalker::ContactSolution steady_on_the_same_elements(const Problem& p, const PatchSolution& patch) {
  kalker::ContactProblem c;
  c.grid = patch.grid;
  c.gap = patch.distance;
  c.material = p.material;
  c.friction = p.friction;
  c.force_prescribed = false;
  c.approach = patch.approach;
  c.regime = kalker::Regime::steady;
  c.creepage = {patch.kinematics.xi, patch.kinematics.eta, patch.kinematics.phi, patch.reference_C.x(),
                patch.reference_C.y()};
  c.rolling = {patch.kinematics.chi, patch.kinematics.velocity, patch.grid.dx};
  c.settings = p.solver;
  return kalker::ContactSolver().solve(c);
}

}  // namespace treadmark::wheelrail
