// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/friction_state.hpp"

#include <cmath>

#include "treadmark/solvers/kalker/halfspace/element_blocks.hpp"

namespace treadmark::kalker {

double rms(std::span<const double> values) {
  const double sum = sum_of_blocks(values.size(), [&](std::size_t begin, std::size_t end) {
    double part = 0.0;
    for (std::size_t i = begin; i < end; ++i) part += values[i] * values[i];
    return part;
  });
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

void limit_to_bound(std::span<double> traction, std::span<const double> bound) {
  const std::size_t n = bound.size();
  for_blocks(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double square = traction[i] * traction[i] + traction[n + i] * traction[n + i];
      if (square <= bound[i] * bound[i] && !std::isinf(square)) continue;
      const double size = std::hypot(traction[i], traction[n + i]);
      if (size <= bound[i]) continue;
      const double factor = bound[i] / size;
      traction[i] *= factor;
      traction[n + i] *= factor;
    }
  });
}

void FrictionState::update(const FrictionProblem& problem) {
  const std::size_t n = problem.bound.size();
  slip.resize(2 * n);
  direction.resize(2 * n);
  slipping.resize(n);
  excess.resize(n);
  problem.matrix->slip(traction, slip);
  const double r = 1.0 / problem.matrix->diagonal();
  const double sum = sum_of_blocks(n, [&](std::size_t begin, std::size_t end) {
    double part = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      double& sx = slip[i];
      double& sy = slip[n + i];
      sx += problem.rigid_slip[i];
      sy += problem.rigid_slip[n + i];
      const double zx = traction[i] - r * sx, zy = traction[n + i] - r * sy;
      const double square = zx * zx + zy * zy, bound = problem.bound[i];
      const double size = std::isinf(square) ? std::hypot(zx, zy) : std::sqrt(square);
      slipping[i] = size > bound;
      if (slipping[i]) {
        direction[i] = zx / size;
        direction[n + i] = zy / size;
        excess[i] = size - bound;
        const double rx = traction[i] - bound * direction[i], ry = traction[n + i] - bound * direction[n + i];
        part += rx * rx + ry * ry;
      } else {
        direction[i] = direction[n + i] = excess[i] = 0.0;
        part += (r * sx) * (r * sx) + (r * sy) * (r * sy);
      }
    }
    return part;
  });
  violation = n == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(2 * n));
}

}  // namespace treadmark::kalker
