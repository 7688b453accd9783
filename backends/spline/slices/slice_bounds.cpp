// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/slices/slice_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::spline {
namespace {

constexpr double kLeastAcross = 1e-9;  // part of the across axis along a rail

// asin(x) from below and above, |x| <= 1; cheap where x is small.
Interval arc_sine(double x) {
  const double size = std::abs(x), q = x * x;
  if (size > 0.3) {
    const double angle = std::asin(std::clamp(x, -1.0, 1.0));
    return {angle, angle};
  }
  const double series = x * (1.0 + q * (1.0 / 6.0 + q * (3.0 / 40.0 + q * (15.0 / 336.0))));
  const double rest = 0.04 * size * (q * q) * (q * q);  // the terms that follow, for |x| <= 0.3
  return x >= 0.0 ? Interval{series, series + rest} : Interval{series - rest, series};
}

}  // namespace

RailWindow::RailWindow(const PlaneWindow& window)
    : exists_(std::abs(window.across_axis.x()) > kLeastAcross), along_(window.along) {
  if (!exists_) return;
  // u from the across coordinate; with it the other two are functions of (y, w).
  const Vec3& a = window.across_axis;
  const Range across(window.across);
  const double inverse = 1.0 / a.x();
  u_ = {inverse * (across.middle + a.dot(window.origin)), std::abs(inverse) * across.half, -a.y() * inverse,
        -a.z() * inverse};
  const auto with_u = [&](const Vec3& axis) {
    return Linear{axis.x() * u_.at_zero - axis.dot(window.origin), std::abs(axis.x()) * u_.half,
                  axis.y() + axis.x() * u_.by_y, axis.z() + axis.x() * u_.by_w};
  };
  s_ = with_u(window.along_axis);
  n_ = with_u(window.normal);
}

WheelWindow::WheelWindow(const PlaneWindow& window) : along_(window.along) {
  const WheelView view(window.across_axis, window.along_axis, window.normal, window.origin);
  const Range across(window.across);
  const double inverse = 1.0 / view.across_e;
  a_ = {inverse * (across.middle + view.across_origin), inverse * across.half, -inverse * view.across_y, 0.0};
  const auto with_a = [&](double e, double f, double y, double origin) {
    return Linear{e * a_.at_zero - origin, std::abs(e) * a_.half, y + e * a_.by_y, f};
  };
  s_ = with_a(view.along_e, view.along_f, view.along_y, view.along_origin);
  n_ = with_a(view.normal_e, view.normal_f, view.normal_y, view.normal_origin);
  sense_ = view.e.x() * view.f.z() - view.e.z() * view.f.x() > 0.0 ? 1.0 : -1.0;
  u_middle_ = view.angle(0.0, 1.0);
}

Interval WheelWindow::u(const Range& y, const Range& r) const {
  constexpr double kRounding = 1e-12;
  const Interval a = a_of(y).interval();
  const double r_low = r.middle - r.half, r_high = r.middle + r.half;
  // asin(a / r) for all a and r of the ranges, up to a quarter turn where a > r
  const Interval lean{arc_sine(a.low / (a.low < 0.0 ? r_low : r_high)).low,
                      arc_sine(a.high / (a.high > 0.0 ? r_low : r_high)).high};
  const Interval u = sense_ * lean + u_middle_;
  return {u.low - kRounding, u.high + kRounding};
}

}  // namespace treadmark::spline
