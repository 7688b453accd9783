// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/wheels/wheel_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::analytic {

WheelBounds::WheelBounds(const WheelBody& body, const Pose& X_SP, const Rectangle& r)
    : body_(body),
      X_(X_SP),
      x_(0.5 * (r.x_min + r.x_max)),
      y_(0.5 * (r.y_min + r.y_max)),
      half_x_(0.5 * (r.x_max - r.x_min)),
      half_y_(0.5 * (r.y_max - r.y_min)),
      tolerance_(1e-7 + 0.01 * (half_x_ + half_y_)) {}

WheelBounds::Box WheelBounds::box(double a, double b) const {
  const Vec3 p = X_.apply({x_, y_, 0.5 * (a + b)});
  const double half[3] = {half_x_, half_y_, 0.5 * (b - a)};
  double y_half = 0.0, r_half = 0.0;
  for (int k = 0; k < 3; ++k) {
    y_half += std::fabs(X_.rotation(1, k)) * half[k];
    r_half += std::hypot(X_.rotation(0, k), X_.rotation(2, k)) * half[k];
  }
  const double y_min = body_.curve.y_min(), y_max = body_.curve.y_max();
  Box result;
  result.outside = p.y() + y_half < y_min || p.y() - y_half > y_max;
  result.within = p.y() - y_half >= y_min && p.y() + y_half <= y_max;
  if (result.outside) return result;

  const CurveRange c = body_.curve.range(p.y() - y_half, p.y() + y_half);
  const double r = std::hypot(p.x(), p.z());
  double depth_min = 0.0, depth_max = 0.0;
  const double turned = 2.0 * r_half / std::max(r, 1e-12);  // bound of the angle, where r_half < r/2
  const bool near_axle = r_half >= 0.5 * r;
  if (!body_.flats.empty() && (near_axle || body_.flats.touches(std::atan2(p.x(), p.z()), turned))) {
    depth_max = body_.flats.max_depth();
    if (!near_axle) {
      double d_theta = 0.0, d_y = 0.0;
      const double d = body_.flats.depth(p.x(), p.y(), p.z(), r, d_theta, d_y);
      const double change = body_.flats.max_d_theta() * turned + body_.flats.max_d_y() * y_half;
      depth_min = std::max(depth_min, d - change);
      depth_max = std::min(depth_max, d + change);
    }
  }
  // Radius and profile apart.
  constexpr double kRounding = 1e-13;
  const double R = body_.nominal_radius;
  result.f_min = r - r_half - R - c.h_max + depth_min - kRounding;
  result.f_max = r + r_half - R - c.h_min + depth_max + kRounding;
  if (near_axle || p.y() < y_min || p.y() > y_max || !std::isfinite(c.dh_min) || !std::isfinite(c.dh_max))
    return result;

  // Both together, which keeps a plane that follows a steep profile tight. The radial direction turns by at most
  // the chord of r_half/r, a factor below 1.05 longer than that ratio.
  const double swing = 1.05 * r_half / r;
  double change = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double e_x = X_.rotation(0, k), e_y = X_.rotation(1, k), e_z = X_.rotation(2, k);
    const double radial = (p.x() * e_x + p.z() * e_z) / r, loose = swing * std::hypot(e_x, e_z);
    const double one = radial - c.dh_min * e_y, two = radial - c.dh_max * e_y;
    change += (std::max(std::fabs(one), std::fabs(two)) + loose) * half[k];
  }
  constexpr double kSteps = 2e-7;  // [m] published profiles are joined with tiny steps
  double slope = 0.0;
  const double f = r - R - body_.curve.height_and_slope(p.y(), body_.curve.find(p.y(), 0), slope);
  result.f_min = std::max(result.f_min, f - change + depth_min - kSteps);
  result.f_max = std::min(result.f_max, f + change + depth_max + kSteps);
  return result;
}

bool WheelBounds::find_top(double a, double b, double& top) const {
  if (!box(a, b).may_hit()) return false;
  const double m = 0.5 * (a + b);
  if (b - a < tolerance_ || !(m > a && m < b)) {
    top = b;
    return true;
  }
  return find_top(m, b, top) || find_top(a, m, top);
}

bool WheelBounds::find_bottom(double a, double b, double& bottom) const {
  if (!box(a, b).may_hit()) return false;
  const double m = 0.5 * (a + b);
  if (b - a < tolerance_ || !(m > a && m < b)) {
    bottom = a;
    return true;
  }
  return find_bottom(a, m, bottom) || find_bottom(m, b, bottom);
}

HeightBounds WheelBounds::heights() const {
  const HeightBounds none{0.0, 0.0, true};
  const Vec3 n = X_.rotation.col(2);
  const double a = n.x() * n.x() + n.z() * n.z();
  if (a < 1e-18) return none;

  // Heights start where the lines are nearest to the axle and end within the greatest radius.
  const auto nearest = [&](const Vec3& p) { return -(p.x() * n.x() + p.z() * n.z()) / a; };
  const double middle = nearest(X_.apply({x_, y_, 0.0}));
  const double spread =
      std::fabs(nearest(X_.rotation.col(0))) * half_x_ + std::fabs(nearest(X_.rotation.col(1))) * half_y_;
  const double low = middle - spread, high = middle + spread + body_.r_max / std::sqrt(a);
  HeightBounds result;
  if (!find_top(low, high, result.z_max)) return none;

  // Where the whole rectangle is inside the wheel and every line came from outside over the profile, all hits are
  // above.
  const bool along_y = std::fabs(n.y()) * (high - low) < 1e-12;
  const auto inside = [&](double t) {
    if (box(t, t).f_max >= 0.0) return false;
    return along_y || box(t, result.z_max).within;
  };
  constexpr int kMostSteps = 200;  // doublings and halvings of a number
  double above = result.z_max, step = tolerance_, t = above - step;
  for (int left = kMostSteps; t > low && !inside(t); --left) {
    above = t;
    step *= 2.0;
    t = left > 1 ? t - step : low;
  }
  if (t > low) {
    for (int left = kMostSteps; left > 0 && above - t > tolerance_; --left) {
      const double m = 0.5 * (above + t);
      (inside(m) ? t : above) = m;
    }
    result.z_min = t;
  } else if (!find_bottom(low, result.z_max, result.z_min)) {
    result.z_min = low;
  }
  return result;
}

}  // namespace treadmark::analytic
