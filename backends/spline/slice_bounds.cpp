// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/slice_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::spline {
namespace {

constexpr double kLeastAcross = 1e-9;  // part of the across axis along a rail

Interval coordinate(const Vec3& axis, const Vec3& origin, const Interval& u, const SliceHulls::Box& box) {
  return axis.x() * u + axis.y() * box.y + axis.z() * box.w + -axis.dot(origin);
}

// asin(a / r) for all a and r of the intervals, up to a quarter turn where a > r.
Interval lean(const Interval& a, const Interval& r) {
  const auto angle = [](double numerator, double denominator) {
    return std::asin(std::clamp(numerator / denominator, -1.0, 1.0));
  };
  return {angle(a.low, a.low < 0.0 ? r.low : r.high), angle(a.high, a.high > 0.0 ? r.low : r.high)};
}

}  // namespace

bool RailWindow::exists() const { return std::abs(window_.across_axis.x()) > kLeastAcross; }

Interval RailWindow::u(const SliceHulls::Box& box) const {
  const Vec3& a = window_.across_axis;
  return (1.0 / a.x()) * (window_.across + a.dot(window_.origin) + -a.y() * box.y + -a.z() * box.w);
}

Interval RailWindow::heights(const SliceHulls::Box& box) const {
  const Interval range = u(box);
  if (!coordinate(window_.along_axis, window_.origin, range, box).overlaps(window_.along)) return Interval::none();
  return coordinate(window_.normal, window_.origin, range, box);
}

Interval WheelWindow::u(const SliceHulls::Box& box) const {
  const Interval leaning = lean(bounds().of(box.y, box.w).a, box.w);
  const double sense = view_.e.x() * view_.f.z() - view_.e.z() * view_.f.x() > 0.0 ? 1.0 : -1.0;
  constexpr double kRounding = 1e-12;
  const Interval u = sense * leaning + view_.angle(0.0, 1.0);
  return {u.low - kRounding, u.high + kRounding};
}

Interval WheelWindow::heights(const SliceHulls::Box& box) const { return bounds().of(box.y, box.w).n; }

}  // namespace treadmark::spline
