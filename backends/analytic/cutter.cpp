// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/cutter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "treadmark/core/error.hpp"

namespace treadmark::analytic {

Cutter::Cutter(CutterPath path, GraphCurve section, const std::string& name)
    : path_(std::move(path)),
      section_(std::move(section)),
      chords_(section_.chords()),
      x_min_(path_.x_min()),
      x_max_(path_.x_max()),
      s_min_(section_.y_min()),
      s_max_(section_.y_max()),
      roll_(path_.range(CutterPath::kRoll, x_min_, x_max_)) {
  constexpr double kSteepestInclination = 80.0 / 180.0 * std::numbers::pi;
  constexpr double kSteepestPath = 1.0;
  const CurveRange h = section_.range(s_min_, s_max_);
  steepest_ = std::max(std::fabs(h.dh_min), std::fabs(h.dh_max));
  if (std::atan(h.dh_max) + roll_.high > kSteepestInclination ||
      std::atan(h.dh_min) + roll_.low < -kSteepestInclination)
    throw Error(ErrorKind::configuration, name + ": the rolled section is too steep between two stations", {},
                "keep its inclination within +-80 degrees");
  const CutterPath::Range y = path_.range(CutterPath::kY, x_min_, x_max_),
                          z = path_.range(CutterPath::kZ, x_min_, x_max_);
  path_slope_ = std::hypot(y.steepest, z.steepest);
  const double reach =
      std::hypot(std::max(std::fabs(s_min_), std::fabs(s_max_)), std::max(std::fabs(h.h_min), std::fabs(h.h_max)));
  if (path_slope_ + roll_.steepest * reach > kSteepestPath)
    throw Error(ErrorKind::configuration, name + ": the path is steeper than 45 degrees between its stations", {},
                "move the stations apart or add some");
  reach_ = reach;
  z_max_ = z.high + reach;
  y_min_ = y.low - reach;
  y_max_ = y.high + reach;
}

/// The path at x, unless the hint is there already.
void Cutter::move_to(double x, Hint& hint) const {
  x = std::clamp(x, x_min_, x_max_);
  if (x == hint.x) return;
  hint.x = x;
  hint.path = path_.find(x, hint.path);
  hint.y = path_.at(CutterPath::kY, x, hint.path);
  hint.z = path_.at(CutterPath::kZ, x, hint.path);
  const double roll = hint.roll.h;
  hint.roll = path_.at(CutterPath::kRoll, x, hint.path);
  if (hint.roll.h == roll) return;
  hint.cos = std::cos(hint.roll.h);
  hint.sin = std::sin(hint.roll.h);
}

Cutter::Place Cutter::place(const Vec3& p, Hint& hint) const {
  move_to(p.x(), hint);
  const Jet &y = hint.y, &z = hint.z, &roll = hint.roll;
  Place at;
  at.cos = hint.cos;
  at.sin = hint.sin;
  const double e_y = p.y() - y.h, e_z = p.z() - z.h;
  at.s = at.cos * e_y + at.sin * e_z;
  at.q = at.cos * e_z - at.sin * e_y;
  at.s_x = roll.dh * at.q - at.cos * y.dh - at.sin * z.dh;
  at.q_x = -roll.dh * at.s + at.sin * y.dh - at.cos * z.dh;
  const double s = std::clamp(at.s, s_min_, s_max_);
  hint.section = section_.find(s, hint.section);
  at.h = section_.height_and_slope(s, hint.section, at.dh);
  if (s != at.s) at.dh = 0.0;
  return at;
}

double Cutter::value(Bound bound, const Place& at, double x) const {
  switch (bound) {
    case kSection:
      return at.gap();
    case kStart:
      return at.s - s_min_;
    case kEnd:
      return s_max_ - at.s;
    case kFirst:
      return x - x_min_;
    case kLast:
      return x_max_ - x;
  }
  return 0.0;
}

Vec3 Cutter::gradient(Bound bound, const Place& at) const {
  const Vec3 s(at.s_x, at.cos, at.sin), q(at.q_x, -at.sin, at.cos);
  switch (bound) {
    case kSection:
      return at.dh * s - q;
    case kStart:
      return s;
    case kEnd:
      return -s;
    case kFirst:
      return Vec3::UnitX();
    case kLast:
      return -Vec3::UnitX();
  }
  return Vec3::Zero();
}

Mat3 Cutter::hessian(Bound bound, const Vec3& p, Hint& hint) const {
  if (bound == kFirst || bound == kLast) return Mat3::Zero();
  const Place at = place(p, hint);
  const Jet &y = hint.y, &z = hint.z, &roll = hint.roll;
  Mat3 s_xx = Mat3::Zero(), q_xx = Mat3::Zero();
  s_xx(0, 0) = roll.ddh * at.q + roll.dh * (at.q_x + at.sin * y.dh - at.cos * z.dh) - at.cos * y.ddh - at.sin * z.ddh;
  q_xx(0, 0) = -roll.ddh * at.s - roll.dh * (at.s_x - at.cos * y.dh - at.sin * z.dh) + at.sin * y.ddh - at.cos * z.ddh;
  s_xx(0, 1) = s_xx(1, 0) = -at.sin * roll.dh;
  s_xx(0, 2) = s_xx(2, 0) = at.cos * roll.dh;
  q_xx(0, 1) = q_xx(1, 0) = -at.cos * roll.dh;
  q_xx(0, 2) = q_xx(2, 0) = -at.sin * roll.dh;
  if (bound == kStart) return s_xx;
  if (bound == kEnd) return -s_xx;
  const Vec3 s = gradient(kStart, at);
  const double ddh = section_.jet(std::clamp(at.s, s_min_, s_max_), hint.section).ddh;
  return ddh * s * s.transpose() + at.dh * s_xx - q_xx;
}

}  // namespace treadmark::analytic
