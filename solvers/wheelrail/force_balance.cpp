// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/force_balance.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::wheelrail {
namespace {

double two_thirds(double x) { return std::copysign(std::cbrt(x * x), x); }

}  // namespace

ForceBalance::ForceBalance(Target target, double tolerance, double stiffness)
    : target_(target), tolerance_(tolerance), stiffness_(stiffness), slope_(two_thirds(stiffness)) {}

double ForceBalance::first(double z_touch) {
  z_touch_ = z_touch;
  next_ = z_touch + std::max(0.0, two_thirds(target_.at(z_touch))) / slope_;
  return next_;
}

double ForceBalance::residual(double z, double force, double least_gap) const {
  const double phi = force > 0.0 ? two_thirds(force) : -two_thirds(stiffness_) * std::max(0.0, least_gap);
  return phi - two_thirds(target_.at(z));
}

void ForceBalance::restart() {
  has_last_ = false;
  bracket_ = {};
}

ForceBalance::State ForceBalance::add(double z, double force, double least_gap) {
  const double value = residual(z, force, least_gap);
  if (std::abs(force - target_.at(z)) <= tolerance_ * std::abs(target_.at(z))) {
    next_ = z;
    z_last_ = z, last_ = value, has_last_ = true;
    return State::found;
  }
  bracket_.add(z, value, force);

  constexpr double kLeastStep = 1e-13;  // closer than this positions cannot be told apart in the surfaces [m]
  if (has_last_ && std::abs(z - z_last_) > kLeastStep && value != last_) {
    const double secant = (value - last_) / (z - z_last_);
    if (secant > 0.0) slope_ = std::clamp(secant, 0.2 * slope_, 5.0 * slope_);
  } else if (!has_last_ && force > 0.0 && z > z_touch_) {
    slope_ = std::clamp(two_thirds(force) / (z - z_touch_), 0.05 * slope_, 20.0 * slope_);
  }
  z_last_ = z, last_ = value, has_last_ = true;

  next_ = z - value / slope_;
  if (bracket_.closed()) {
    // No contact is so stiff that its force changes by a thousandth within a nanometre.
    constexpr double kJumpWidth = 1e-9, kJump = 1e-3;
    const double width = bracket_.width(), rise = bracket_.value_above() - bracket_.value_below();
    if (width < kLeastStep || (width < kJumpWidth && rise > kJump * std::abs(target_.at(z)))) return State::no_balance;
    next_ = bracket_.safeguarded(next_);
  }
  return State::search;
}

}  // namespace treadmark::wheelrail
