// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/defects/flat_depth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/backends/analytic/fast_trig.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::analytic {
namespace {

double chord_radius_of(const WheelFlat& f, double R) { return std::sqrt((R - 0.5 * f.length) * (R + 0.5 * f.length)); }

double rounding_of(const WheelFlat& f, double R) {
  if (f.edge_radius <= 0.0) return 0.0;
  const double slope = 0.5 * f.length / chord_radius_of(f, R);
  return 0.5 * slope * slope / (1.0 / f.edge_radius - 1.0 / R);
}

}  // namespace

double half_angle_of(const WheelFlat& f, double R) {
  if (f.shape != WheelFlat::Shape::fresh) return 0.5 * f.length / R;
  return f.edge_radius > 0.0 ? std::acos(chord_radius_of(f, R) / (R + rounding_of(f, R)))
                             : std::asin(std::min(1.0, 0.5 * f.length / R));
}

FlatDepth::FlatDepth(const std::vector<WheelFlat>& flats, double R) {
  check_defects({.flats = flats}, Body::wheel, R);
  for (const WheelFlat& given : flats) {
    const bool fresh = given.shape == WheelFlat::Shape::fresh;
    Flat f{};
    f.shape = given.shape;
    f.center = wrap_angle(given.theta_center);
    f.sin_center = std::sin(f.center);
    f.cos_center = std::cos(f.center);
    f.radius = R;
    f.chord_radius = chord_radius_of(given, R);
    f.rounding = fresh ? rounding_of(given, R) : 0.0;
    f.half_angle = half_angle_of(given, R);
    f.cos_half_angle = std::cos(f.half_angle);
    f.depth = fresh ? 0.25 * given.length * given.length / (R + f.chord_radius) : given.depth;
    f.wave_number = kPi / f.half_angle;
    f.y_center = given.y_center;
    f.half_width = 0.5 * given.width;
    f.y_wave_number = given.width > 0.0 ? 2.0 * kPi / given.width : 0.0;
    const double steepest = fresh ? f.chord_radius * std::sin(f.half_angle) / (f.cos_half_angle * f.cos_half_angle)
                                  : 0.5 * f.depth * f.wave_number;
    max_depth_ += f.depth;
    f.steepest = steepest;
    max_d_theta_ += steepest;
    max_d_y_ += 0.5 * f.depth * f.y_wave_number;
    flats_.push_back(f);
  }
}

void FlatDepth::Flat::along(double phi, double& d, double& d1, double& d2) const {
  if (shape == WheelFlat::Shape::fresh) {
    // R - rho/cos(phi), written as depth - rho (1/cos(phi) - 1) so that nothing cancels
    double half, c_half;
    fast_sin_cos(0.5 * phi, half, c_half);
    const double c = 1.0 - 2.0 * half * half, s = 2.0 * half * c_half;
    d = depth - chord_radius * 2.0 * half * half / c;
    d1 = -chord_radius * s / (c * c);
    d2 = -chord_radius * (1.0 + s * s) / (c * c * c);
    if (rounding > 0.0 && d < rounding) {
      const double over = std::max(0.0, d + rounding), share = 0.5 * over / rounding;
      d2 = 0.5 * d1 * d1 / rounding + share * d2;
      d1 *= share;
      d = 0.5 * share * over;
    }
    d = std::max(0.0, d);
  } else {
    double s, c;
    fast_sin_cos(wave_number * phi, s, c);
    d = 0.5 * depth * (1.0 + c);
    d1 = -0.5 * depth * wave_number * s;
    d2 = -0.5 * depth * wave_number * wave_number * c;
  }
}

void FlatDepth::Flat::across(double y, double& w, double& w1, double& w2) const {
  w = 1.0;
  w1 = w2 = 0.0;
  if (half_width == 0.0) return;
  const double e = y - y_center;
  if (std::fabs(e) >= half_width) {
    w = 0.0;
    return;
  }
  double s, c;
  fast_sin_cos(y_wave_number * e, s, c);
  w = 0.5 * (1.0 + c);
  w1 = -0.5 * y_wave_number * s;
  w2 = -0.5 * y_wave_number * y_wave_number * c;
}

double FlatDepth::depth(double x, double y, double z, double r, double& d_theta, double& d_y) const {
  double sum = 0.0;
  d_theta = d_y = 0.0;
  for (const Flat& f : flats_) {
    const double ahead = z * f.cos_center + x * f.sin_center;  // r cos(phi)
    if (f.half_angle < kPi && ahead < r * f.cos_half_angle) continue;
    if (f.half_width > 0.0 && std::fabs(y - f.y_center) >= f.half_width) continue;
    const double phi = std::atan2(x * f.cos_center - z * f.sin_center, ahead);
    if (std::fabs(phi) >= f.half_angle) continue;
    double d, d1, d2, w, w1, w2;
    f.along(phi, d, d1, d2);
    f.across(y, w, w1, w2);
    sum += d * w;
    d_theta += d1 * w;
    d_y += d * w1;
  }
  return sum;
}

DepthJet FlatDepth::jet(double theta, double y) const {
  DepthJet sum;
  for (const Flat& f : flats_) {
    const double phi = wrap_angle(theta - f.center);
    if (std::fabs(phi) >= f.half_angle) continue;
    double d, d1, d2, w, w1, w2;
    f.along(phi, d, d1, d2);
    f.across(y, w, w1, w2);
    sum.d += d * w;
    sum.d_theta += d1 * w;
    sum.d_y += d * w1;
    sum.d_theta_theta += d2 * w;
    sum.d_theta_y += d1 * w1;
    sum.d_y_y += d * w2;
  }
  return sum;
}

std::vector<FlatLanes> FlatDepth::lanes() const {
  std::vector<FlatLanes> all;
  for (const Flat& f : flats_) {
    if (f.half_angle > kWidestFlatLane || f.rounding > 0.0) return {};
    all.push_back({f.shape == WheelFlat::Shape::fresh, f.sin_center, f.cos_center, f.cos_half_angle, f.depth,
                   f.chord_radius, f.wave_number, f.y_center, f.half_width, f.y_wave_number});
  }
  return all;
}

bool FlatDepth::touches(double theta, double half_range) const {
  for (const Flat& f : flats_)
    if (std::fabs(wrap_angle(theta - f.center)) <= f.half_angle + half_range) return true;
  return false;
}

FunctionRange FlatDepth::Flat::along_range(double near, double far) const {
  // both shapes are even and fall from the middle to their ends; the derivative of a chord grows outwards
  if (near >= half_angle) return {};
  const bool ends = far >= half_angle;
  far = std::min(far, half_angle);
  double low, high, d1, d2, outermost;
  along(near, high, d1, d2);
  along(far, low, outermost, d2);
  if (ends) low = 0.0;
  if (shape == WheelFlat::Shape::fresh) return {low, high, rounding > 0.0 ? steepest : std::fabs(outermost)};
  return {low, high, steepest * cosine_range(wave_number * near, wave_number * far).max_d};
}

FlatDepth::Range FlatDepth::range(double theta, double half_range, double y_min, double y_max) const {
  Range sum;
  for (const Flat& f : flats_) {
    // distances from the middle that occur, on the circle
    const double middle = std::fabs(wrap_angle(theta - f.center));
    double near = std::max(0.0, middle - half_range), far = middle + half_range;
    if (far > kPi) {
      near = std::max(0.0, std::min(near, 2.0 * kPi - far));
      far = kPi;
    }
    const FunctionRange a = f.along_range(near, far), b = CosineBump{f.y_center, f.half_width}.range(y_min, y_max);
    sum.low += a.low * b.low;
    sum.high += a.high * b.high;
    sum.max_d_theta += a.max_d * b.high;
    sum.max_d_y += a.high * b.max_d;
  }
  return sum;
}

void FlatDepth::depths(double theta, double half_range, double y_min, double y_max, double& low, double& high) const {
  low = high = 0.0;
  const auto distances = [](double middle, double half, double& near, double& far) {
    near = std::max(0.0, std::fabs(middle) - half);
    far = std::fabs(middle) + half;
  };
  for (const Flat& f : flats_) {
    double turn = theta - f.center, near, far;
    if (turn > kPi) turn -= 2.0 * kPi;
    if (turn < -kPi) turn += 2.0 * kPi;
    distances(turn, half_range, near, far);
    if (far > kPi) {
      near = std::max(0.0, std::min(near, 2.0 * kPi - far));
      far = kPi;
    }
    if (near >= f.half_angle) continue;
    double e_near, e_far;
    distances(0.5 * (y_min + y_max) - f.y_center, 0.5 * (y_max - y_min), e_near, e_far);
    if (f.half_width > 0.0 && e_near >= f.half_width) continue;
    // both factors fall from the middle outwards
    double d, d1, d2, w, w1, w2;
    f.along(near, d, d1, d2);
    f.across(f.y_center + e_near, w, w1, w2);
    high += d * w;
    if (far >= f.half_angle || (f.half_width > 0.0 && e_far >= f.half_width)) continue;
    f.along(far, d, d1, d2);
    f.across(f.y_center + e_far, w, w1, w2);
    low += d * w;
  }
  constexpr double kRounding = 1e-15;  // [m]
  low = std::max(0.0, low - kRounding);
  high += high > 0.0 ? kRounding : 0.0;
}

}  // namespace treadmark::analytic
