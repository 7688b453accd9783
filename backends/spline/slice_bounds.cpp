// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/slice_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/backends/spline/wheel_view.hpp"

namespace treadmark::spline {
namespace {

constexpr double kLeastAcross = 1e-9;  // part of the across axis along a rail

Interval part_of(const Vec3& direction, const Interval& u, const SliceHulls::Box& box, double origin) {
  return direction.x() * u + direction.y() * box.y + direction.z() * box.w + -origin;
}

// asin(a / r) for all a and r of the intervals, widened to a quarter turn where a > r.
Interval lean(const Interval& a, const Interval& r) {
  const auto angle = [](double numerator, double denominator) { return std::asin(std::clamp(numerator / denominator, -1.0, 1.0)); };
  return {angle(a.low, a.low < 0.0 ? r.low : r.high), angle(a.high, a.high > 0.0 ? r.low : r.high)};
}

}  // namespace

Interval slice_height_bounds(const RailGeometry&, const SliceHulls& hulls, const Pose& X_SP, bool along_y,
                             const Interval& across, const Interval& along) {
  const Vec3 a = X_SP.rotation.col(along_y ? 0 : 1), s = X_SP.rotation.col(along_y ? 1 : 0), n = X_SP.rotation.col(2);
  if (std::abs(a.x()) < kLeastAcross) return Interval::none();
  const double a0 = a.dot(X_SP.origin), s0 = s.dot(X_SP.origin), n0 = n.dot(X_SP.origin);
  // u solved from the across coordinate.
  const auto u_over = [&](const SliceHulls::Box& box) {
    return (1.0 / a.x()) * (across + a0 + -a.y() * box.y + -a.z() * box.w);
  };
  const Interval all_u = u_over(hulls.all());
  Interval heights = Interval::none();
  hulls.visit([&](const Interval& u) { return u.overlaps(all_u); },
              [&](const SliceHulls::Box& box, bool fine) {
                const Interval u = u_over(box);
                if (!part_of(s, u, box, s0).overlaps(along)) return false;
                if (fine) heights.include(part_of(n, u, box, n0));
                return true;
              });
  return heights;
}

Interval slice_height_bounds(const WheelGeometry&, const SliceHulls& hulls, const Pose& X_SP, bool along_y,
                             const Interval& across, const Interval& along) {
  const WheelView view(X_SP.rotation.col(along_y ? 0 : 1), X_SP.rotation.col(along_y ? 1 : 0), X_SP.rotation.col(2), X_SP.origin);
  const WheelBoxBounds bounds{view, across, along};
  // Angles the rectangle can see: theta of f, plus or minus the lean towards e.
  const Interval leaning = lean(bounds.of(hulls.all().y, hulls.all().w).a, hulls.all().w);
  const double sense = view.e.x() * view.f.z() - view.e.z() * view.f.x() > 0.0 ? 1.0 : -1.0;
  const Interval seen = sense * leaning + view.angle(0.0, 1.0);
  const auto sees = [&seen](const Interval& u) {
    for (int turn = -2; turn <= 2; ++turn)
      if ((u + turn * 2.0 * std::numbers::pi).overlaps(seen)) return true;
    return false;
  };
  Interval heights = Interval::none();
  hulls.visit(sees, [&](const SliceHulls::Box& box, bool fine) {
    const auto part = bounds.of(box.y, box.w);
    if (part.n.empty()) return false;
    if (fine) heights.include(part.n);
    return true;
  });
  return heights;
}

}  // namespace treadmark::spline
