// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/kalker/tangential/rigid_slip.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "treadmark/core/error.hpp"

namespace treadmark::kalker {

Field2 rigid_slip(const Patch& patch, const RollingStep& step, const Creepage& creepage, double spin_offset_factor) {
  const std::size_t n = patch.cell.size();
  Field2 w(2 * n);
  const double offset_x = spin_offset_factor * step.shift_x, offset_y = spin_offset_factor * step.shift_y;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = patch.grid.x(patch.column[i]) - creepage.spin_x + offset_x;
    const double y = patch.grid.y(patch.row[i]) - creepage.spin_y + offset_y;
    w[i] = step.distance * (creepage.xi - creepage.phi * y);
    w[n + i] = step.distance * (creepage.eta + creepage.phi * x);
  }
  return w;
}

Field2 KnownSlip::rigid(const Creepage& creepage) const {
  Field2 w = rigid_slip(*patch, step, creepage, spin_offset_factor);
  for (std::size_t i = 0; i < share.size(); ++i) {
    w[i] *= share[i];
    w[share.size() + i] *= share[i];
  }
  return w;
}

Field2 KnownSlip::at(const Creepage& creepage) const {
  Field2 w = rigid(creepage);
  for (std::size_t k = 0; k < other.size(); ++k) w[k] += other[k];
  return w;
}

Field2 KnownSlip::per_unit(int component) const {
  Creepage unit;
  (component == 0 ? unit.xi : unit.eta) = 1.0;
  return rigid(unit);
}

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
