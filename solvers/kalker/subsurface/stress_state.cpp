// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/subsurface/stress_state.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace treadmark::kalker {

void set_invariants(SubsurfacePoint& point) {
  const Mat3& stress = point.stress;
  point.hydrostatic = stress.trace() / 3.0;
  const Mat3 deviator = stress - point.hydrostatic * Mat3::Identity();
  point.von_mises = std::sqrt(1.5 * deviator.squaredNorm());
  // Of the deviator, so that a large pressure does not take digits from the differences.
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(deviator, Eigen::EigenvaluesOnly);
  const Vec3 ascending = solver.eigenvalues();
  point.tresca = ascending[2] - ascending[0];
  point.principal = ascending.reverse().array() + point.hydrostatic;
}

}  // namespace treadmark::kalker
