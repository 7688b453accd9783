// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/force_balance.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::wheelrail {
namespace {
double two_thirds(double x) { return std::cbrt(x) * std::cbrt(x); }
}  // namespace

ForceBalance::ForceBalance(double target, double tolerance, double stiffness)
    : target_(target), tolerance_(tolerance), stiffness_(stiffness), phi_target_(two_thirds(target)) {
  slope_ = two_thirds(stiffness_);
}

double ForceBalance::first(double z_touch) {
  // From the unloaded side: approximate pressures may fall with depth where parts of the contact go out, and then the first balance counts.
  constexpr double kShare = 0.5;
  z_touch_ = z_touch;
  next_ = z_touch + kShare * phi_target_ / slope_;
  return next_;
}

double ForceBalance::phi(double force, double least_gap) const {
  return force > 0.0 ? two_thirds(force) : -two_thirds(stiffness_) * std::max(0.0, least_gap);
}

void ForceBalance::restart() {
  has_last_ = false;
  z_low_ = -std::numeric_limits<double>::infinity();
  z_high_ = std::numeric_limits<double>::infinity();
}

ForceBalance::State ForceBalance::add(double z, double force, double least_gap) {
  if (std::abs(force - target_) <= tolerance_ * target_) {
    next_ = z;
    z_last_ = z, phi_last_ = phi(force, least_gap), has_last_ = true;
    return State::found;
  }
  const double value = phi(force, least_gap);
  (value < phi_target_ ? z_low_ : z_high_) = z;

  constexpr double kLeastStep = 1e-13;  // closer than this positions cannot be told apart in the surfaces [m]
  if (has_last_ && std::abs(z - z_last_) > kLeastStep && value != phi_last_) {
    const double secant = (value - phi_last_) / (z - z_last_);
    if (secant > 0.0) slope_ = std::clamp(secant, 0.2 * slope_, 5.0 * slope_);
  } else if (!has_last_ && force > 0.0 && z > z_touch_) {
    slope_ = std::clamp(value / (z - z_touch_), 0.05 * slope_, 20.0 * slope_);
  }
  z_last_ = z, phi_last_ = value, has_last_ = true;

  next_ = z + (phi_target_ - value) / slope_;
  if (std::isfinite(z_low_) && std::isfinite(z_high_)) {
    if (z_high_ - z_low_ < kLeastStep) return State::no_balance;
    if (!(next_ > z_low_ && next_ < z_high_)) next_ = 0.5 * (z_low_ + z_high_);
  }
  return State::search;
}

}  // namespace treadmark::wheelrail
