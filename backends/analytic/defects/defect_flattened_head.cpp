// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/analytic/defects/defect_flattened_head.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "treadmark/backends/analytic/defects/defect_shapes.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::analytic {

namespace {

/// max(0, plane - z of the base), a parabola in their difference at round edges. First derivatives are exact on both
/// sides of the edge, second ones are differences of the base's slopes.
class FlattenedHeadShape final : public OffsetShape {
 public:
  FlattenedHeadShape(const FlattenedHead& head, const Surface& sound, std::shared_ptr<const Surface> base)
      : base_(std::move(base)), plane_(head, sound) {}

  displacement::OffsetJet jet(double u, double y) const override {
    if (!inside(u)) return {};
    constexpr double kStep = 1e-5;  // [m] slopes good to 1e-12 leave second derivatives good to 1e-7/m
    const std::array<Vec2, 5> points{Vec2(u, y), Vec2(u + kStep, y), Vec2(u - kStep, y), Vec2(u, y + kStep),
                                     Vec2(u, y - kStep)};
    std::array<double, 5> z{}, z_x{}, z_y{};
    base_->heights_at(Pose{}, points, {z, z_x, z_y});
    const Jet level = plane_.level(u);
    const double cut = level.h + y * plane_.tan_roll - z[0];
    const Jet w = plane_.rounding(level);
    if (!(cut > -w.h)) return {};
    const auto half_difference = [](const std::array<double, 5>& d, std::size_t i) {
      const double value = (d[i] - d[i + 1]) / (2.0 * kStep);
      return std::isnan(value) ? 0.0 : value;
    };
    const displacement::OffsetJet d{cut,
                                    level.dh - z_x[0],
                                    plane_.tan_roll - z_y[0],
                                    level.ddh - half_difference(z_x, 1),
                                    -0.5 * (half_difference(z_x, 3) + half_difference(z_y, 1)),
                                    -half_difference(z_y, 3)};
    return cut < w.h ? rounded(d, w) : d;
  }

  void add(std::span<const double> u, std::span<const double> y, std::span<double> value, std::span<double> d_u,
           std::span<double> d_y) const override {
    constexpr std::size_t kBatch = 128;
    std::array<Vec2, kBatch> points;
    std::array<std::size_t, kBatch> which{};
    std::array<double, kBatch> z{}, z_x{}, z_y{};
    std::size_t n = 0;
    const auto flush = [&] {
      base_->heights_at(Pose{}, {points.data(), n}, {{z.data(), n}, {z_x.data(), n}, {z_y.data(), n}});
      for (std::size_t k = 0; k < n; ++k) {
        const Jet level = plane_.level(points[k].x());
        const double cut = level.h + points[k].y() * plane_.tan_roll - z[k];
        const Jet w = plane_.rounding(level);
        if (!(cut > -w.h)) continue;
        displacement::OffsetJet d{cut, level.dh - z_x[k], plane_.tan_roll - z_y[k]};
        if (cut < w.h) d = rounded(d, w);
        value[which[k]] += d.value;
        if (!d_u.empty()) d_u[which[k]] += d.d_u;
        if (!d_y.empty()) d_y[which[k]] += d.d_y;
      }
      n = 0;
    };
    for (std::size_t i = 0; i < u.size(); ++i) {
      if (!inside(u[i])) continue;
      points[n] = {u[i], y[i]};
      which[n++] = i;
      if (n == kBatch) flush();
    }
    if (n > 0) flush();
  }

  displacement::OffsetRange range(const Rectangle& r) const override {
    const Rectangle in{std::max(r.x_min, plane_.x_start), std::min(r.x_max, plane_.x_end), r.y_min, r.y_max};
    if (!(in.x_min < in.x_max)) return {};
    const HeightBounds z = base_->height_bounds(Pose{}, in);
    if (z.empty) return {};
    const double a = in.y_min * plane_.tan_roll, b = in.y_max * plane_.tan_roll;
    const double widest = plane_.edge * plane_.depth, high = plane_.touching + plane_.depth + std::max(a, b) - z.z_min;
    if (!(high > -widest)) return {};
    // slopes between the points of a fine grid may be a little steeper than on them
    constexpr double kBetween = 1.1, kLeast = 0.01;
    const double steepest_ramp = 1.5 * plane_.depth / plane_.ramp;
    return {0.0, std::max(0.0, high) + 0.25 * widest,
            (1.0 + 0.25 * plane_.edge) * steepest_ramp + kBetween * plane_.steepest_x + kLeast,
            kBetween * plane_.steepest_y + kLeast};
  }

  Rectangle support() const override { return {plane_.x_start, plane_.x_end, -kEverywhere, kEverywhere}; }
  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  /// (d + w)^2 / (4 w) for |d| < w.
  static displacement::OffsetJet rounded(const displacement::OffsetJet& d, const Jet& w) {
    const double share = 0.5 * (d.value + w.h) / w.h, by_w = share * (1.0 - share), t = d.value / w.h, dd = 0.5 / w.h,
                 dw = -t * dd, ww = t * t * dd;
    return {w.h * share * share,
            share * d.d_u + by_w * w.dh,
            share * d.d_y,
            dd * d.d_u * d.d_u + 2.0 * dw * d.d_u * w.dh + ww * w.dh * w.dh + share * d.d_uu + by_w * w.ddh,
            (dd * d.d_u + dw * w.dh) * d.d_y + share * d.d_uy,
            dd * d.d_y * d.d_y + share * d.d_yy};
  }
  bool inside(double x) const { return x > plane_.x_start && x < plane_.x_end; }

  std::shared_ptr<const Surface> base_;
  HeadPlane plane_;
};

}  // namespace

ShapePtr make_flattened_head_shape(const FlattenedHead& head, const Surface& sound,
                                   std::shared_ptr<const Surface> base) {
  return std::make_unique<FlattenedHeadShape>(head, sound, std::move(base));
}

namespace {

constexpr double kWidest = 0.25;  ///< [m] for bases without lateral ends
constexpr int kAlong = 33, kAcross = 2001;

/// Grid over a stretch of a base; no width where the base has none.
Grid2 stretch_grid(const Surface& base, const FlattenedHead& head) {
  const Box3 box = base.bounds();
  const double y = std::max(box.min.y(), -kWidest), width = std::min(box.max.y(), kWidest) - y;
  return {head.x_start, y, (head.x_end - head.x_start) / (kAlong - 1), width / (kAcross - 1), kAlong, kAcross};
}

/// Least z - y tan(roll) of a base over a stretch: the least of a fine grid, then of ever finer grids about it.
double least_height(const Surface& base, const FlattenedHead& head, double tan_roll) {
  constexpr int kFiner = 9, kRounds = 6;
  Grid2 g = stretch_grid(base, head);
  if (!(g.dy > 0.0)) return std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> z(g.size());
    base.heights({Pose{}, g}, {z, {}, {}});
    double x_least = g.x0, y_least = g.y0;
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) {
        const double h = z[g.index(ix, iy)] - g.y(iy) * tan_roll;
        if (!(h < least)) continue;
        least = h;
        x_least = g.x(ix);
        y_least = g.y(iy);
      }
    if (std::isinf(least)) return least;
    if (x_least == g.x0 && y_least == g.y0) break;
    const double x = std::max(head.x_start, x_least - g.dx), x_end = std::min(head.x_end, x_least + g.dx);
    g = {x, y_least - g.dy, (x_end - x) / (kFiner - 1), g.dy / (4 * kFiner), kFiner, 8 * kFiner + 1};
  }
  return least;
}

/// Half the width of edges that are nowhere sharper than a radius, in depth, over the depth of the plane. They are
/// sharpest at their outer ends. On a round crown the squared slope against the plane is proportional to the depth
/// below the crown, so to the depth of the plane on the ramps, and greater at the outer ends by this share.
double edge_share(const Surface& base, const FlattenedHead& head, double touching, double tan_roll) {
  Grid2 g = stretch_grid(base, head);
  g.x0 = 0.5 * (head.x_start + head.x_end), g.nx = 1;
  std::vector<double> z(g.size()), z_x(g.size()), z_y(g.size());
  base.heights({Pose{}, g}, {z, z_x, z_y});
  const auto cut = [&](std::size_t i) { return touching + head.depth + g.y(static_cast<int>(i)) * tan_roll - z[i]; };
  double widest = 0.0;
  for (std::size_t i = 1; i < z.size(); ++i) {
    const double before = cut(i - 1), here = cut(i), share = before / (before - here);
    if ((before > 0.0) == (here > 0.0) || std::isnan(share)) continue;
    const double rail = std::lerp(z_y[i - 1], z_y[i], share), slope = tan_roll - rail, square = 1.0 + rail * rail;
    const double sharper = square * std::sqrt(square) / head.edge_radius - (z_y[i] - z_y[i - 1]) / g.dy;
    if (!(sharper > 0.0))
      throw Error(ErrorKind::configuration, "the rail itself is sharper than the edges of a flattened head", {},
                  "take a smaller edge_radius_mm");
    widest = std::max(widest, 0.5 * slope * slope / sharper);
  }
  if (widest > 0.5 * head.depth)
    throw Error(ErrorKind::configuration, "the round edges of a flattened head meet in its middle", {},
                "take a smaller edge_radius_mm");
  return widest / (head.depth - widest);
}

}  // namespace

HeadPlane::HeadPlane(const FlattenedHead& head, const Surface& base)
    : tan_roll(std::tan(head.roll)),
      touching(least_height(base, head, tan_roll)),
      x_start(head.x_start),
      x_end(head.x_end),
      ramp(head.ramp),
      depth(head.depth) {
  if (std::isinf(touching))
    throw Error(ErrorKind::configuration, "a flattened head lies where the rail has no surface");
  if (head.edge_radius > 0.0) edge = edge_share(base, head, touching, tan_roll);
  const Grid2 g = stretch_grid(base, head);
  std::vector<double> z(g.size()), z_x(g.size()), z_y(g.size());
  base.heights({Pose{}, g}, {z, z_x, z_y});
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const std::size_t i = g.index(ix, iy);
      if (!(z[i] - g.y(iy) * tan_roll < touching + (1.0 + edge) * depth)) continue;
      steepest_x = std::max(steepest_x, std::fabs(z_x[i]));
      steepest_y = std::max(steepest_y, std::fabs(z_y[i] - tan_roll));
    }
}

Jet HeadPlane::level(double x) const {
  const bool first = x < 0.5 * (x_start + x_end);
  const double t = (first ? x - x_start : x_end - x) / ramp, sign = first ? 1.0 : -1.0;
  if (t >= 1.0) return {touching + depth, 0.0, 0.0};
  return {touching + depth * t * t * (3.0 - 2.0 * t), sign * depth * 6.0 * t * (1.0 - t) / ramp,
          depth * 6.0 * (1.0 - 2.0 * t) / (ramp * ramp)};
}

}  // namespace treadmark::analytic
