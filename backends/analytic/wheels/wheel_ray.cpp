// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/wheels/wheel_ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::analytic {

ChordSlopes::ChordSlopes(const GraphCurve& curve) {
  constexpr int kCells = 256;
  y_min_ = curve.y_min();
  const double width = (curve.y_max() - y_min_) / kCells;
  per_length_ = 1.0 / width;
  std::vector<CurveRange> cells;
  for (int i = 0; i < kCells; ++i) cells.push_back(curve.range(y_min_ + i * width, y_min_ + (i + 1) * width));
  right_.assign(kCells, -kInfinity);
  left_.assign(kCells, kInfinity);
  right_least_ = left_;
  left_most_ = right_;
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  for (int i = 0; i < kCells; ++i) {
    const CurveRange& a = cells[at(i)];
    for (int j = i; j < kCells; ++j) {
      const CurveRange& b = cells[at(j)];
      double most = 0.0, least = 0.0;  // chord slopes between a point of cell i and one of cell j
      if (j <= i + 1) {
        most = std::max(a.dh_max, b.dh_max);
        least = std::min(a.dh_min, b.dh_min);
      } else {
        const double near = (j - i - 1) * width, far = (j - i + 1) * width;
        const double rise = b.h_max - a.h_min, fall = b.h_min - a.h_max;
        most = rise / (rise > 0.0 ? near : far);
        least = fall / (fall < 0.0 ? near : far);
      }
      right_[at(i)] = std::max(right_[at(i)], most);
      left_[at(j)] = std::min(left_[at(j)], least);
      right_least_[at(i)] = std::min(right_least_[at(i)], least);
      left_most_[at(j)] = std::max(left_most_[at(j)], most);
    }
  }
}

std::size_t ChordSlopes::cell(double y) const {
  const double i = (y - y_min_) * per_length_;
  return to_whole<std::size_t>(i, 0.0, static_cast<double>(right_.size()) - 1.0);
}

WheelBody::WheelBody(GraphCurve profile, double radius, const std::vector<WheelFlat>& wheel_flats)
    : curve(std::move(profile)), nominal_radius(radius), chords(curve), hull(curve) {
  if (!(radius > 0.0) || !std::isfinite(radius))
    throw Error(ErrorKind::configuration, "a wheel needs a positive nominal radius");
  flats = FlatDepth(wheel_flats, radius);
  const CurveRange range = curve.range(curve.y_min(), curve.y_max());
  if (!(radius + range.h_min - flats.max_depth() > 0.0))
    throw Error(ErrorKind::configuration, "the wheel's profile or a flat reaches down to the axle");
  r_max = (radius + range.h_max) * (1.0 + 1e-12);
  r_min = (radius + range.h_min - flats.max_depth()) * (1.0 - 1e-12);
  for (int i = 0; i < curve.piece_count(); ++i) pieces.push_back(curve.lanes(i));
  narrow_flats = flats.lanes();
  all_narrow = flats.empty() || !narrow_flats.empty();
}

WheelRay::WheelRay(const WheelBody& body, const Vec3& direction)
    : body_(body), n_(direction), a_(direction.x() * direction.x() + direction.z() * direction.z()) {}

/// The part of the line that can hold hits: outwards of the point nearest to the axle, within the greatest radius,
/// over the profile.
bool WheelRay::clip() {
  if (a_ < 1e-18) return false;
  closest_ = -(o_.x() * n_.x() + o_.z() * n_.z()) / a_;
  spin_ = o_.z() * n_.x() - o_.x() * n_.z();
  const double inside = body_.r_max * body_.r_max - spin_ * spin_ / a_;
  if (!(inside > 0.0)) return false;
  t_low_ = closest_;
  t_high_ = closest_ + std::sqrt(inside / a_);
  const double y_min = body_.curve.y_min(), y_max = body_.curve.y_max();
  if (std::fabs(n_.y()) * (t_high_ - t_low_) < 1e-15) {
    const double y = o_.y() + t_high_ * n_.y();
    return y >= y_min && y <= y_max;
  }
  const double t1 = (y_min - o_.y()) / n_.y(), t2 = (y_max - o_.y()) / n_.y();
  t_low_ = std::max(t_low_, std::min(t1, t2));
  t_high_ = std::min(t_high_, std::max(t1, t2));
  return t_high_ >= t_low_;
}

double WheelRay::radial_slope(double t) const {
  const double x = o_.x() + t * n_.x(), z = o_.z() + t * n_.z();
  return (x * n_.x() + z * n_.z()) / std::sqrt(x * x + z * z);
}

/// g(t) = r - r(theta, y) along the line, its slope, and the gradient of F.
double WheelRay::gap(double t, double& slope, WheelHit& at) {
  at.t = t;
  at.x = o_.x() + t * n_.x();
  at.y = o_.y() + t * n_.y();
  at.z = o_.z() + t * n_.z();
  at.r = std::sqrt(at.x * at.x + at.z * at.z);
  piece_ = body_.curve.find(at.y, piece_);
  double dh = 0.0;
  double g = at.r - body_.nominal_radius - body_.curve.height_and_slope(at.y, piece_, dh);
  at.f_theta = 0.0;
  at.f_y = -dh;
  slope = (at.x * n_.x() + at.z * n_.z()) / at.r;
  if (!body_.flats.empty()) {
    double d_theta = 0.0, d_y = 0.0;
    at.depth = body_.flats.depth(at.x, at.y, at.z, at.r, d_theta, d_y);
    g += at.depth;
    at.f_theta = d_theta;
    at.f_y += d_y;
    slope += d_theta * spin_ / (at.r * at.r);
  }
  if (n_.y() != 0.0) slope += at.f_y * n_.y();
  return g;
}

bool WheelRay::newton(double guess, WheelHit& hit, bool exact) {
  constexpr int kSteps = 8;
  constexpr double kSteep = 50.0;
  double t = guess;
  for (int i = 0; i < kSteps; ++i) {
    double slope = 0.0;
    const double g = gap(t, slope, hit);
    const double step = g / slope;
    if (!(std::fabs(step) < body_.nominal_radius) || !(std::fabs(slope) < kSteep)) return false;
    t -= step;
    // The next step would be the square of this one times d2g/dt2 over twice the slope: below rounding for curvatures
    // up to 100/m, where a steep profile has (1 + f_y^2)^1.5 of it in its second derivative.
    if (std::fabs(step) > kNear * std::min(1.0, std::fabs(slope)) / (1.0 + hit.f_y * hit.f_y)) continue;
    constexpr double kExact = 1e-11;  // [m] moves slopes by less than 1e-9
    if (exact && std::fabs(step) > kExact) gap(t, slope, hit);
    hit.t = t;
    return slope > 0.0 && t >= t_low_ && t <= t_high_;
  }
  return false;
}

/// From the hit outwards r rises at least with its slope here, because r(t) is convex; the profile rises at most with
/// its steepest chord; inside a flat the depth shrinks at most with its Lipschitz constants. If the first beats the
/// others, the line never meets the wheel again.
bool WheelRay::is_outermost(const WheelBody& body, const Vec3& n, double spin, const WheelHit& hit) {
  double margin = (hit.x * n.x() + hit.z * n.z()) / hit.r;
  const double n_y = n.y();
  if (n_y > 0.0) margin -= body.chords.greatest_right(hit.y) * n_y;
  if (n_y < 0.0) margin -= body.chords.least_left(hit.y) * n_y;
  if (hit.depth > 0.0)
    margin -= body.flats.max_d_theta() * std::fabs(spin) / (hit.r * hit.r) + body.flats.max_d_y() * std::fabs(n_y);
  constexpr double kBeside = 1e-6;  // the point may lie kNear beside the hit
  return margin > kBeside;
}

/// The same inwards, down to the least radius of the wheel: the gap only rises on the way to the hit, so it has no
/// other root.
bool WheelRay::rises_to(const WheelHit& hit) const {
  const double r = body_.r_min, ahead_2 = a_ * r * r - spin_ * spin_;  // (x n_x + z n_z)^2 at that radius
  if (!(ahead_2 > 0.0)) return false;
  const double n_y = n_.y();
  double margin = std::sqrt(ahead_2) / r;
  if (n_y > 0.0) margin -= body_.chords.greatest_left(hit.y) * n_y;
  if (n_y < 0.0) margin -= body_.chords.least_right(hit.y) * n_y;
  if (!body_.flats.empty())
    margin -= body_.flats.max_d_theta() * std::fabs(spin_) / (r * r) + body_.flats.max_d_y() * std::fabs(n_y);
  constexpr double kBeside = 1e-6;
  return margin > kBeside;
}

/// Root in a bracket with a sign change: Newton, held inside by bisection.
double WheelRay::polish(Bracket a, Bracket b) {
  WheelHit at;
  double t = 0.5 * (a.t + b.t);
  for (int i = 0; i < 120; ++i) {
    double slope = 0.0;
    const double g = gap(t, slope, at);
    if (g == 0.0) return t;
    ((g > 0.0) == (b.g > 0.0) ? b : a) = {t, g};
    const double width = b.t - a.t;
    if (width < 1e-15) break;
    double next = t - g / slope;
    if (!(next > a.t && next < b.t)) next = 0.5 * (a.t + b.t);
    if (std::fabs(next - t) < 1e-16 && std::fabs(g) < 1e-13) return next;
    t = next;
  }
  return t;
}

/// Greatest root in [a, b] by bisection with bounds of the gap and of its slope over intervals.
double WheelRay::search(Bracket a, Bracket b, int depth) {
  const double y_a = o_.y() + a.t * n_.y(), y_b = o_.y() + b.t * n_.y();
  const CurveRange c = body_.curve.range(std::min(y_a, y_b), std::max(y_a, y_b));
  const double x_a = o_.x() + a.t * n_.x(), z_a = o_.z() + a.t * n_.z(), r_a = std::hypot(x_a, z_a);
  const double x_b = o_.x() + b.t * n_.x(), z_b = o_.z() + b.t * n_.z(), r_b = std::hypot(x_b, z_b);

  double depth_max = 0.0, depth_rate = 0.0;
  if (!body_.flats.empty()) {
    const double theta_a = std::atan2(x_a, z_a), turned = std::fabs(wrap_angle(std::atan2(x_b, z_b) - theta_a));
    if (body_.flats.touches(theta_a, turned)) {
      depth_max = body_.flats.max_depth();
      depth_rate = body_.flats.max_d_theta() * std::fabs(spin_) / std::max(r_a * r_a, 1e-12) +
                   body_.flats.max_d_y() * std::fabs(n_.y());
    }
  }
  constexpr double kRounding = 1e-14;
  if (r_a - body_.nominal_radius - c.h_max > kRounding) return kNaN;
  if (r_b - body_.nominal_radius - c.h_min + depth_max < -kRounding) return kNaN;

  double low = r_a > 1e-6 ? radial_slope(a.t) : 0.0, high = radial_slope(b.t);
  if (n_.y() != 0.0) {
    const double s1 = -c.dh_min * n_.y(), s2 = -c.dh_max * n_.y();
    low += std::min(s1, s2);
    high += std::max(s1, s2);
  }
  low -= depth_rate;
  high += depth_rate;
  const bool crosses = (a.g <= 0.0 && b.g >= 0.0) || (a.g >= 0.0 && b.g <= 0.0);
  if (low > 0.0 || high < 0.0) return crosses ? polish(a, b) : kNaN;
  const double width = b.t - a.t, steepest = std::max(std::fabs(low), std::fabs(high));
  if (!crosses && std::fabs(a.g) + std::fabs(b.g) > steepest * width) return kNaN;
  if (width < 1e-13 || depth > 60) return crosses ? b.t : kNaN;

  WheelHit at;
  double slope = 0.0;
  Bracket m{0.5 * (a.t + b.t), 0.0};
  m.g = gap(m.t, slope, at);
  const double upper = search(m, b, depth + 1);
  return std::isnan(upper) ? search(a, m, depth + 1) : upper;
}

bool WheelRay::cast(const Vec3& origin, double guess, WheelHit& hit, bool exact) {
  o_ = origin;
  if (!clip()) return false;
  if (!(guess >= t_low_ && guess <= t_high_)) guess = t_high_;
  if (newton(guess, hit, exact) && is_outermost(body_, n_, spin_, hit)) return true;
  double slope = 0.0;
  Bracket a{t_low_, 0.0}, b{t_high_, 0.0};
  a.g = gap(a.t, slope, hit);
  b.g = gap(b.t, slope, hit);
  const double t = search(a, b, 0);
  if (std::isnan(t)) return false;
  gap(t, slope, hit);
  return true;
}

void WheelRay::refine(WheelHit& hit) {
  double slope = 0.0;
  gap(hit.t, slope, hit);
}

bool WheelRay::hides_others(const WheelHit& hit) {
  constexpr double kApart = 1e-9;  // [m]
  if (!(hit.t - kApart > t_low_) || rises_to(hit)) return false;
  WheelHit at;
  double slope = 0.0;
  Bracket a{t_low_, 0.0}, b{hit.t - kApart, 0.0};
  a.g = gap(a.t, slope, at);
  b.g = gap(b.t, slope, at);
  return !std::isnan(search(a, b, 0));
}

}  // namespace treadmark::analytic
