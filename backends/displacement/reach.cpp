// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/reach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "treadmark/backends/displacement/natural_point.hpp"

namespace treadmark::displacement {

Interval operator*(const Interval& a, const Interval& b) {
  const double p[4] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  return {*std::min_element(p, p + 4), *std::max_element(p, p + 4)};
}

Rectangle enlarged(const Rectangle& r, double by) { return {r.x_min - by, r.x_max + by, r.y_min - by, r.y_max + by}; }

double greatest(const OffsetRange& range) { return std::max(std::fabs(range.low), std::fabs(range.high)); }

Rectangle View::natural_box(const Rectangle& r, const Interval& t) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kRounding = 1e-14;
  Vec3 corner[8];
  Vec3 middle = Vec3::Zero();
  Rectangle box{kInfinity, -kInfinity, kInfinity, -kInfinity};
  for (int k = 0; k < 8; ++k) {
    corner[k] = X_SP.apply({k & 1 ? r.x_max : r.x_min, k & 2 ? r.y_max : r.y_min, k & 4 ? t.high : t.low});
    middle += 0.125 * corner[k];
    box.y_min = std::min(box.y_min, corner[k].y() - kRounding);
    box.y_max = std::max(box.y_max, corner[k].y() + kRounding);
  }
  if (body == Body::rail) {
    for (const Vec3& c : corner) {
      box.x_min = std::min(box.x_min, c.x() - kRounding);
      box.x_max = std::max(box.x_max, c.x() + kRounding);
    }
    return box;
  }
  // Angles about the axle against the middle of the box; a convex box ahead of the axle spans those of its corners.
  const double theta = std::atan2(middle.x(), middle.z());
  const double sin = std::sin(theta), cos = std::cos(theta);
  for (const Vec3& c : corner) {
    const double ahead = c.x() * sin + c.z() * cos, beside = c.x() * cos - c.z() * sin;
    if (!(ahead > 1e-3 * std::fabs(beside))) return {-std::numbers::pi, std::numbers::pi, box.y_min, box.y_max};
    const double angle = theta + std::atan2(beside, ahead);
    box.x_min = std::min(box.x_min, angle - kRounding);
    box.x_max = std::max(box.x_max, angle + kRounding);
  }
  return box;
}

OffsetRange View::offsets(const Rectangle& uy) const {
  OffsetRange r = field.range(uy);
  if (r.zero()) return r;
  const double u = 0.5 * (uy.x_min + uy.x_max), y = 0.5 * (uy.y_min + uy.y_max);
  const double change = r.max_d_u * 0.5 * (uy.x_max - uy.x_min) + r.max_d_y * 0.5 * (uy.y_max - uy.y_min);
  if (!(change < r.high - r.low)) return r;
  const double middle = field.jet(u, y).value, slack = 1e-15 + 1e-12 * std::fabs(middle);
  r.low = std::max(r.low, middle - change - slack);
  r.high = std::min(r.high, middle + change + slack);
  return r;
}

View::Directions View::directions(const Rectangle& uy) const {
  const Mat3& R = X_SP.rotation;
  Directions d;
  if (body == Body::rail) {
    for (int k = 0; k < 3; ++k) d.e[k] = {R(2, k), R(2, k)};
    return d;
  }
  // A component is a cosine with its own phase: bounded by the ends and, if it lies between them, the crest.
  for (int k = 0; k < 3; ++k) {
    const double a = R(0, k), b = R(2, k), amplitude = std::hypot(a, b), phase = std::atan2(a, b);
    const double first = amplitude * std::cos(uy.x_min - phase), last = amplitude * std::cos(uy.x_max - phase);
    constexpr double kPi = std::numbers::pi, kRounding = 1e-15;
    const auto passes = [&](double angle) {
      return std::floor((uy.x_max - angle) / (2.0 * kPi)) >= std::ceil((uy.x_min - angle) / (2.0 * kPi));
    };
    d.e[k].low = (passes(phase + kPi) ? -amplitude : std::min(first, last)) - kRounding;
    d.e[k].high = (passes(phase) ? amplitude : std::max(first, last)) + kRounding;
  }
  return d;
}

Rectangle View::moved_back(const Rectangle& r, const OffsetRange& range, const Directions& d) {
  const Interval offset{range.low, range.high};
  const Interval x = offset * d.e[0], y = offset * d.e[1];
  return {r.x_min - x.high, r.x_max - x.low, r.y_min - y.high, r.y_max - y.low};
}

Interval View::along_normal(const OffsetRange& range, const Directions& d) {
  return Interval{range.low, range.high} * d.e[2];
}

double View::tilt_along(const Rectangle& uy, const Vec3& q_S) const {
  const double turn = body == Body::wheel ? uy.x_max - uy.x_min : 0.0;
  return std::fabs(X_SP.rotation.col(2).dot(NaturalPoint(body, q_S).along)) + turn;
}

double View::rate(const OffsetRange& offsets, const Rectangle& uy, const Vec3& q_S) const {
  const double along = tilt_along(uy, q_S) * NaturalPoint(body, q_S).du_along;
  const double turning = body == Body::wheel ? greatest(offsets) * along : 0.0;
  return offsets.max_d_u * along + offsets.max_d_y * std::fabs(X_SP.rotation(1, 2)) + turning;
}

}  // namespace treadmark::displacement
