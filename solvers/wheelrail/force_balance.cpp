// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/force_balance.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::wheelrail {
namespace {

constexpr double kLeastStep = 1e-13;  ///< closer than this positions cannot be told apart in the surfaces [m]

double two_thirds(double x) { return std::copysign(std::cbrt(x * x), x); }

}  // namespace

ForceBalance::ForceBalance(Target target, double tolerance, double stiffness, double end_slope)
    : target_(target),
      tolerance_(tolerance),
      stiffness_(stiffness),
      end_slope_(end_slope),
      slope_(two_thirds(stiffness)) {}

double ForceBalance::first(double z_touch) {
  before_ = {{z_touch, residual(z_touch, 0.0, 0.0)}};
  from_touching_ = true;
  next_ = z_touch + std::max(0.0, two_thirds(target_.at(z_touch))) / slope_;
  return next_;
}

double ForceBalance::residual(double z, double force, double least_gap) const {
  const double phi = force > 0.0 ? two_thirds(force) : -two_thirds(stiffness_) * std::max(0.0, least_gap);
  return phi - two_thirds(target_.at(z));
}

void ForceBalance::restart() {
  before_.clear();
  from_touching_ = false;
  bracket_ = {};
}

double ForceBalance::slope_at(const Point& p) const {
  if (before_.empty()) return slope_;
  const Point &last = before_.back(), &first = before_.front();
  if (std::abs(p.z - last.z) <= kLeastStep) return slope_;
  const double secant = (p.residual - last.residual) / (p.z - last.z);
  if (!(secant > 0.0)) return slope_;
  if (before_.size() == 1) {
    constexpr double kNear = 0.02, kMost = 1.5;
    const bool near = std::abs(p.residual) <= kNear * std::abs(last.residual);
    if (from_touching_ && near && end_slope_ > 0.0) return std::clamp(end_slope_, 1.0 / kMost, kMost) * secant;
    return std::clamp(secant, 0.05 * slope_, 20.0 * slope_);
  }
  // At its end a parabola is steeper or flatter than its last secant. Much of that is no parabola.
  constexpr double kSmooth = 0.3;
  double bend = 0.0;
  if (std::abs(last.z - first.z) > kLeastStep && std::abs(p.z - first.z) > kLeastStep)
    bend = (secant - (last.residual - first.residual) / (last.z - first.z)) / (p.z - first.z) * (p.z - last.z);
  const double slope = std::abs(bend) <= kSmooth * secant ? secant + bend : secant;
  return std::clamp(slope, 0.2 * slope_, 5.0 * slope_);
}

ForceBalance::State ForceBalance::add(double z, double force, double least_gap) {
  const Point here{z, residual(z, force, least_gap)};
  const bool found = std::abs(force - target_.at(z)) <= tolerance_ * std::abs(target_.at(z));
  slope_ = slope_at(here);
  // Of a little change the accuracy of forces is too large a part.
  constexpr double kClear = 30.0;
  const bool two_contacts = before_.size() > (from_touching_ ? 1u : 0u);
  if (two_contacts &&
      std::abs(here.residual - before_.back().residual) > kClear * tolerance_ * two_thirds(target_.at(z)))
    measured_slope_ = slope_;
  if (before_.size() == 2) {
    before_.erase(before_.begin());
    from_touching_ = false;
  }
  before_.push_back(here);
  next_ = z;
  if (found) return State::found;

  bracket_.add(z, here.residual, force);
  next_ = z - here.residual / slope_;
  if (bracket_.closed()) {
    // No contact is so stiff that its force changes by a thousandth within a nanometre.
    constexpr double kJumpWidth = 1e-9, kJump = 1e-3;
    const double width = bracket_.width(), rise = bracket_.value_above() - bracket_.value_below();
    if (width < kLeastStep || (width < kJumpWidth && rise > kJump * std::abs(target_.at(z)))) return State::no_balance;
    next_ = bracket_.safeguarded(next_);
  }
  return State::search;
}

double ForceBalance::end_slope(double depth) const {
  const double mean = two_thirds(target_.at(next_)) / depth;
  return measured_slope_ > 0.0 && mean > 0.0 ? measured_slope_ / mean : end_slope_;
}

}  // namespace treadmark::wheelrail
