// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/displaced_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/constants.hpp"

namespace treadmark::displacement {

DisplacedLine::Sample DisplacedLine::at(double t) const {
  const Mat3& R = view_.X_SP.rotation;
  const NaturalPoint q(view_.body, view_.X_SP.apply({x_, y_, t}));
  const OffsetJet d = view_.field.jet(q.u(), q.y);
  const Vec3 e = R.transpose() * q.e;
  const Vec2 moved(x_ - d.value * e.x(), y_ - d.value * e.y());
  double h = kNaN, hx = kNaN, hy = kNaN;
  view_.base.heights_at(view_.X_SP, {&moved, 1}, {{&h, 1}, {&hx, 1}, {&hy, 1}});
  const Vec3 M(-hx, -hy, 1.0);
  const Vec3 g = R.transpose() * q.pull_back(R * M, d.value, d.d_u, d.d_y);
  return {t - d.value * e.z() - h, g.z(), -g.x() / g.z(), -g.y() / g.z(), M.norm()};
}

bool DisplacedLine::may_vanish(const Interval& t, double& aside) const {
  const Rectangle here{x_, x_, y_, y_};
  const Rectangle uy = view_.natural_box(here, t);
  const OffsetRange range = view_.offsets(uy);
  const View::Directions e = view_.directions(uy);
  const Rectangle moved = View::moved_back(here, range, e);
  aside = std::max(moved.x_max - moved.x_min, moved.y_max - moved.y_min);
  const HeightBounds h = view_.base.height_bounds(view_.X_SP, moved);
  if (h.empty) return false;
  const Interval shift = View::along_normal(range, e);
  constexpr double kRounding = 1e-12;
  return t.low - shift.high - h.z_max <= kRounding && t.high - shift.low - h.z_min >= -kRounding;
}

double DisplacedLine::search(double max_offset) const {
  const Rectangle here{x_, x_, y_, y_};
  const HeightBounds all = view_.base.height_bounds(view_.X_SP, enlarged(here, max_offset));
  if (all.empty) return kNaN;
  double low = all.z_min - max_offset, high = all.z_max + max_offset;
  if (view_.body == Body::wheel) {  // the half that faces +z begins where the line is nearest to the axle
    const Vec3 n = view_.X_SP.rotation.col(2), o = view_.X_SP.apply({x_, y_, 0.0});
    const double a = n.x() * n.x() + n.z() * n.z();
    if (a < 1e-18) return kNaN;
    low = std::max(low, -(o.x() * n.x() + o.z() * n.z()) / a);
  }
  if (!(low <= high)) return kNaN;
  Search search{std::max(kFinest, 1e-4 * (high - low)), 4000};
  return view_.body == Body::wheel ? search_interval(high, low, search) : search_interval(low, high, search);
}

double DisplacedLine::search_interval(double outer, double inner, Search& search) const {
  double aside = 0.0;
  if (--search.budget < 0 || !may_vanish({std::min(outer, inner), std::max(outer, inner)}, aside)) return kNaN;
  if (std::fabs(outer - inner) <= search.finest || aside <= 2.0 * kFinest) return polish(outer, inner);
  const double middle = 0.5 * (outer + inner);
  const double first = search_interval(outer, middle, search);
  return std::isnan(first) ? search_interval(middle, inner, search) : first;
}

/// A zero in a tiny interval: a change of sign, or what Newton finds from the middle. Jumps of h at folds are none.
double DisplacedLine::polish(double outer, double inner) const {
  constexpr int kBisections = 100, kSteps = 30;
  constexpr double kRounding = 2e-16;  // [m]
  const auto is_zero = [](const Sample& s) { return std::fabs(s.F) <= 1e-12 * s.steepness * s.steepness; };
  double a = outer, b = inner;
  Sample at_a = at(a);
  const Sample at_b = at(b);
  if (at_a.F == 0.0) return a;
  if (at_a.F * at_b.F <= 0.0) {
    // Newton's method, held in the bracket; halved every other time, so that a jump is found out too
    double m = 0.5 * (a + b);
    for (int k = 0; k < kBisections; ++k) {
      const Sample s = at(m);
      if (std::isnan(s.F)) break;
      if ((s.F > 0.0) == (at_a.F > 0.0)) {
        a = m;
        at_a = s;
      } else {
        b = m;
      }
      const double next = m - s.F / s.dF;
      const bool inside = next >= std::min(a, b) && next <= std::max(a, b);
      if (inside && std::fabs(next - m) <= kRounding && is_zero(s)) return next;
      m = inside && k % 2 == 0 ? next : 0.5 * (a + b);
    }
    const Sample s = at(b);
    return is_zero(s) ? b : kNaN;
  }
  const double width = std::fabs(outer - inner), middle = 0.5 * (outer + inner);
  for (const double start : {middle, outer, inner}) {
    double t = start;
    for (int k = 0; k < kSteps; ++k) {
      const Sample s = at(t);
      if (!(std::fabs(s.dF) > 1e-9) || std::isnan(s.F)) break;
      const double step = -s.F / s.dF;
      if (std::fabs(t + step - middle) > 2.0 * width) break;
      t += step;
      if (std::fabs(step) <= 1e-14 && is_zero(at(t))) return t;
    }
  }
  return kNaN;
}

}  // namespace treadmark::displacement
