// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/graph_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/constants.hpp"

namespace treadmark {
namespace {

struct GraphSearch {
  bool wheel;
  const SteepestGraph& g;
  const Pose& X_SP;

  /// A ball of this radius about a point of S holds nothing of the surface.
  double clearance(const Vec3& p) const {
    constexpr double kArc = kPi / 3.0;  // over its chord, of chords that are no longer than the radius
    const Rectangle& d = g.domain;
    const double y = std::clamp(p.y(), d.y_min, d.y_max), aside = std::fabs(p.y() - y);
    const double r = std::hypot(p.x(), p.z()), h = wheel ? r : p.z();
    if (wheel && r < g.low) return std::max(g.low - r, aside);
    const double u = wheel ? std::atan2(p.x(), p.z()) : std::clamp(p.x(), d.x_min, d.x_max);
    const double far = std::fabs(g.value(u, y) - h) / std::hypot(1.0, wheel ? kArc * g.slope : g.slope);
    return std::max(
        {wheel ? std::min(far, g.low) : far, g.low - h, h - g.high, aside, wheel ? 0.0 : std::fabs(p.x() - u)});
  }

  /// The end of the heights over a rectangle: sign 1: not below the greatest, -1: not above the least; NaN: none.
  double end(const Rectangle& r, double sign) const {
    constexpr double kNear = 1.1, kRounding = 1e-9;  // [m]
    const double length = r.x_max - r.x_min, width = r.y_max - r.y_min, radius = 0.5 * std::hypot(length, width);
    const double x = 0.5 * (r.x_min + r.x_max), y = 0.5 * (r.y_min + r.y_max);
    const Rectangle& d = g.domain;
    const Vec3 least(wheel ? -g.high : d.x_min, d.y_min, wheel ? -g.high : g.low);
    const Vec3 most(wheel ? g.high : d.x_max, d.y_max, g.high);
    // where the rectangle, moved along its normal, meets a box that holds the surface: t = sign z falls
    const Vec3 middle = X_SP.apply({x, y, 0.0}), along = sign * X_SP.rotation.col(2);
    double from = kInfinity, to = -kInfinity;
    for (int k = 0; k < 3; ++k) {
      const double across = std::fabs(X_SP.rotation(k, 0)) * length + std::fabs(X_SP.rotation(k, 1)) * width;
      const double half = 0.5 * across + kRounding;
      const double first = least[k] - half - middle[k], last = most[k] + half - middle[k];
      if (along[k] == 0.0 && (first > 0.0 || last < 0.0)) return kNaN;
      if (along[k] == 0.0) continue;
      from = std::min(from, std::max(first / along[k], last / along[k]));
      to = std::max(to, std::min(first / along[k], last / along[k]));
    }
    if (!std::isfinite(from - to)) return sign * kInfinity;
    for (double t = from; t >= to;) {
      const double free = clearance(X_SP.apply({x, y, sign * t}));
      if (!(free > kNear * radius + kRounding)) return sign * t;
      t -= std::sqrt((free - radius) * (free + radius));
    }
    return kNaN;
  }
};

}  // namespace

HeightBounds height_bounds(Facing facing, const SteepestGraph& graph, const Pose& X_SP, const Rectangle& rectangle_P) {
  const GraphSearch search{facing == Facing::down, graph, X_SP};
  const double high = search.end(rectangle_P, 1.0), low = search.end(rectangle_P, -1.0);
  return std::isnan(high) || std::isnan(low) ? HeightBounds{0.0, 0.0, true} : HeightBounds{low, high, false};
}

}  // namespace treadmark
