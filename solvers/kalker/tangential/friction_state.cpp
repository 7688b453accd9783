// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/friction_state.hpp"

#include <cmath>

namespace treadmark::kalker {

double rms(std::span<const double> values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

void limit_to_bound(std::span<double> traction, std::span<const double> bound) {
  const std::size_t n = bound.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double size = std::hypot(traction[i], traction[n + i]);
    if (size <= bound[i]) continue;
    const double factor = bound[i] / size;
    traction[i] *= factor;
    traction[n + i] *= factor;
  }
}

void FrictionState::update(const FrictionProblem& problem) {
  const std::size_t n = problem.bound.size();
  slip.resize(2 * n);
  residual.resize(2 * n);
  direction.resize(2 * n);
  slipping.resize(n);
  excess.resize(n);
  problem.matrix->slip(traction, slip);
  const double r = 1.0 / problem.matrix->diagonal();
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    double& sx = slip[i];
    double& sy = slip[n + i];
    sx += problem.rigid_slip[i];
    sy += problem.rigid_slip[n + i];
    const double zx = traction[i] - r * sx, zy = traction[n + i] - r * sy;
    const double size = std::sqrt(zx * zx + zy * zy), bound = problem.bound[i];
    slipping[i] = size > bound;
    if (slipping[i]) {
      direction[i] = zx / size;
      direction[n + i] = zy / size;
      excess[i] = size - bound;
      residual[i] = traction[i] - bound * direction[i];
      residual[n + i] = traction[n + i] - bound * direction[n + i];
    } else {
      direction[i] = direction[n + i] = excess[i] = 0.0;
      residual[i] = r * sx;
      residual[n + i] = r * sy;
    }
    sum += residual[i] * residual[i] + residual[n + i] * residual[n + i];
  }
  violation = n == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(2 * n));
}

}  // namespace treadmark::kalker
