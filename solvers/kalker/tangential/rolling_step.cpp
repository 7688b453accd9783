// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/rolling_step.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "treadmark/core/error.hpp"

namespace treadmark::kalker {

namespace {

constexpr double kAngleTolerance = 1e-6;  ///< of the rolling direction [rad]

[[noreturn]] void refuse(const std::string& message, const std::string& advice) {
  throw Error(ErrorKind::configuration, message, {}, advice);
}

}  // namespace

RollingStep rolling_step(const ContactProblem& problem) {
  RollingStep step;
  if (problem.regime == Regime::shift || problem.regime == Regime::frictionless) return step;
  const Rolling& rolling = problem.rolling;
  if (!(rolling.velocity > 0.0))
    refuse("the rolling velocity must be positive", "give its magnitude; the direction is chi");
  step.rolling = true;
  const double chi = std::remainder(rolling.chi, 2.0 * std::numbers::pi);
  const bool forward = std::abs(chi) < kAngleTolerance,
             backward = std::abs(std::abs(chi) - std::numbers::pi) < kAngleTolerance;
  if (problem.regime == Regime::steady) {
    if (!forward && !backward)
      refuse("steady rolling in direction " + std::to_string(rolling.chi) + " rad is not supported",
             "turn the contact frame so that chi is 0 or pi, or roll there in transient steps");
    step.transport = forward ? Transport::forward : Transport::backward;
    step.distance = problem.grid.dx;
  } else {
    if (!(rolling.step > 0.0))
      refuse("the rolling step must be positive in transient rolling", "give dq, best as large as dx");
    step.distance = rolling.step;
  }
  step.time = step.distance / rolling.velocity;
  step.shift_x = step.distance * (forward ? 1.0 : backward ? -1.0 : std::cos(chi));
  step.shift_y = forward || backward ? 0.0 : step.distance * std::sin(chi);
  return step;
}

}  // namespace treadmark::kalker
