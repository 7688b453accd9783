// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/analytic/defects/cutter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

namespace {

/// Slopes at the points of the natural cubic spline: the tridiagonal system of continuous second derivatives.
std::vector<double> natural_slopes(const std::vector<double>& x, const std::vector<double>& v) {
  const std::size_t n = x.size();
  std::vector<double> diagonal(n), upper(n), right(n);
  const auto chord = [&](std::size_t i) { return (v[i + 1] - v[i]) / (x[i + 1] - x[i]); };
  diagonal[0] = 2.0;
  upper[0] = 1.0;
  right[0] = 3.0 * chord(0);
  for (std::size_t i = 1; i < n; ++i) {
    double lower = 1.0, middle = 2.0, value = 3.0 * chord(i - 1);
    if (i + 1 < n) {
      const double before = 1.0 / (x[i] - x[i - 1]), after = 1.0 / (x[i + 1] - x[i]);
      lower = before;
      middle = 2.0 * (before + after);
      upper[i] = after;
      value = 3.0 * (chord(i - 1) * before + chord(i) * after);
    }
    const double factor = lower / diagonal[i - 1];
    diagonal[i] = middle - factor * upper[i - 1];
    right[i] = value - factor * right[i - 1];
  }
  std::vector<double> slopes(n);
  for (std::size_t i = n; i-- > 0;) slopes[i] = (right[i] - (i + 1 < n ? upper[i] * slopes[i + 1] : 0.0)) / diagonal[i];
  return slopes;
}

}  // namespace

CutterPath CutterPath::natural_spline(std::vector<double> x, const Values& values) {
  Values slopes;
  for (std::size_t k = 0; k < values.size(); ++k) slopes[k] = natural_slopes(x, values[k]);
  return hermite(std::move(x), values, slopes);
}

CutterPath CutterPath::hermite(std::vector<double> x, const Values& values, const Values& slopes) {
  CutterPath path;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double d = x[i + 1] - x[i];
    Piece piece;
    for (std::size_t k = 0; k < piece.size(); ++k) {
      const double v = values[k][i], m = slopes[k][i], chord = (values[k][i + 1] - v) / d, n = slopes[k][i + 1];
      piece[k] = {v, m, (3.0 * chord - 2.0 * m - n) / d, (m + n - 2.0 * chord) / (d * d)};
    }
    path.pieces_.push_back(piece);
  }
  path.x_ = std::move(x);
  return path;
}

CutterPath::Range CutterPath::range(Coordinate which, double a, double b) const {
  a = std::clamp(a, x_min(), x_max());
  b = std::clamp(b, x_min(), x_max());
  Range all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 0.0};
  for (std::size_t i = find(a, 0); i < pieces_.size() && x_[i] <= b; ++i) {
    const double from = std::max(a, x_[i]), to = std::min(b, x_[i + 1]);
    const auto include = [&](double x) {
      const Jet p = at(which, x, i);
      all.low = std::min(all.low, p.h);
      all.high = std::max(all.high, p.h);
      all.steepest = std::max(all.steepest, std::fabs(p.dh));
    };
    include(from);
    include(to);
    // extremes inside: of the value where the slope is 0, of the slope where it turns
    const Cubic& p = pieces_[i][which];
    const auto inside = [&](double t) {
      if (x_[i] + t > from && x_[i] + t < to) include(x_[i] + t);
    };
    if (p[3] != 0.0) inside(-p[2] / (3.0 * p[3]));
    const double root = p[2] * p[2] - 3.0 * p[3] * p[1];
    if (root < 0.0) continue;
    const double q = -(p[2] + std::copysign(std::sqrt(root), p[2]));  // 3 p3 t^2 + 2 p2 t + p1 = 0
    if (p[3] != 0.0) inside(q / (3.0 * p[3]));
    if (q != 0.0) inside(p[1] / q);
  }
  return all;
}

}  // namespace treadmark::analytic
