// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/force_balance.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"

namespace treadmark::wheelrail {
namespace {

constexpr double kLeastStep = 1e-13;  ///< closer than this positions cannot be told apart in the surfaces [m]

double two_thirds(double x) { return std::copysign(std::cbrt(x * x), x); }

}  // namespace

double ForceBalance::Target::met(double begins, double stiffness) const {
  const double most = at(begins);
  if (!(most > 0.0)) return spring > 0.0 ? begins + most / spring : begins;
  const double alone = two_thirds(most) / two_thirds(stiffness);
  if (!(spring > 0.0)) return begins + alone;
  // Contact and spring add up to what grows faster and faster: Newton's steps come down to its root from beyond.
  double depth = std::min(alone, most / spring);
  for (;;) {
    const double mean = stiffness * std::sqrt(depth) + spring, slope = mean + 0.5 * stiffness * std::sqrt(depth);
    const double less = depth - (mean * depth - most) / slope;
    if (!(less < depth)) return begins + depth;
    depth = less;
  }
}

ForceBalance::ForceBalance(Target target, double tolerance, double stiffness, double end_slope)
    : target_(target),
      tolerance_(tolerance),
      stiffness_(stiffness),
      end_slope_(end_slope),
      reference_(two_thirds(target.level)),
      slope_(two_thirds(stiffness)) {
  if (!(stiffness > 0.0))
    throw Error(ErrorKind::numerical, "a balance of forces begins with a contact of no stiffness");
}

double ForceBalance::first(double z_touch) {
  next_ = met_ = target_.met(z_touch, stiffness_);
  reference_ = two_thirds(wanted());
  before_ = {{z_touch, phi(0.0, 0.0) - reference_}};
  from_touching_ = true;
  return next_;
}

double ForceBalance::phi(double force, double least_gap) const {
  return force > 0.0 ? two_thirds(force) : -two_thirds(stiffness_) * std::max(0.0, least_gap);
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
  const double phi_here = phi(force, least_gap);
  const Point here{z, phi_here - reference_};
  slope_ = slope_at(here);
  const bool on_spring = target_.spring > 0.0;
  met_ = on_spring ? target_.met(z - phi_here / slope_, std::pow(slope_, 1.5)) : z - here.residual / slope_;
  // Of a little change the accuracy of forces is too large a part.
  constexpr double kClear = 30.0;
  const bool two_contacts = before_.size() > (from_touching_ ? 1u : 0u);
  if (two_contacts && std::abs(here.residual - before_.back().residual) > kClear * tolerance_ * two_thirds(wanted()))
    measured_slope_ = slope_;
  if (before_.size() == 2) {
    before_.erase(before_.begin());
    from_touching_ = false;
  }
  before_.push_back(here);
  // Where the spring bears nothing, nothing need touch: a contact may lie between the elements there.
  const bool unloaded = on_spring && !(force > 0.0) && target_.at(z) <= target_.spring * kLeastStep;
  if (unloaded || std::abs(force - wanted()) <= tolerance_ * std::abs(wanted())) {
    next_ = on_spring && !unloaded ? met_ : z;
    return State::found;
  }

  bracket_.add(z, phi_here - two_thirds(target_.at(z)), force);
  next_ = met_;
  if (bracket_.closed()) {
    // No contact is so stiff that its force changes by a thousandth within a nanometre. Stiff springs hold heights that
    // close to each other from the beginning, under small loads, too: of the depth it is then a ten-thousandth.
    constexpr double kJumpWidth = 1e-9, kJump = 1e-3, kOfDepth = 1e-4;
    const double width = bracket_.width(), rise = bracket_.value_above() - bracket_.value_below();
    const double narrow = on_spring ? std::min(kJumpWidth, kOfDepth * two_thirds(wanted() / stiffness_)) : kJumpWidth;
    if (width < kLeastStep || (width < narrow && rise > kJump * std::abs(wanted()))) return State::no_balance;
    next_ = bracket_.safeguarded(next_);
  }
  return State::search;
}

double ForceBalance::end_slope(double depth) const {
  const double mean = two_thirds(target_.at(next_)) / depth;
  return measured_slope_ > 0.0 && mean > 0.0 ? measured_slope_ / mean : end_slope_;
}

}  // namespace treadmark::wheelrail
