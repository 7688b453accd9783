// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <array>
#include <cmath>

#include "treadmark/backends/analytic/defect_shapes.hpp"
#include "treadmark/backends/analytic/head_plane.hpp"

namespace treadmark::analytic {

namespace {

/// max(0, plane - z of the base). First derivatives are exact on both sides of the edge, second ones are differences of
/// the base's slopes.
class FlattenedHeadShape final : public OffsetShape {
 public:
  FlattenedHeadShape(const FlattenedHead& head, std::shared_ptr<const Surface> base)
      : base_(std::move(base)), plane_(head, *base_) {}

  displacement::OffsetJet jet(double u, double y) const override {
    if (!inside(u)) return {};
    constexpr double kStep = 1e-5;  // [m] slopes good to 1e-12 leave second derivatives good to 1e-7/m
    const std::array<Vec2, 5> points{Vec2(u, y), Vec2(u + kStep, y), Vec2(u - kStep, y), Vec2(u, y + kStep),
                                     Vec2(u, y - kStep)};
    std::array<double, 5> z{}, z_x{}, z_y{};
    base_->heights_at(Pose{}, points, {z, z_x, z_y});
    const Jet level = plane_.level(u);
    const double cut = level.h + y * plane_.tan_roll - z[0];
    if (!(cut > 0.0)) return {};
    const auto half_difference = [](const std::array<double, 5>& d, std::size_t i) {
      const double value = (d[i] - d[i + 1]) / (2.0 * kStep);
      return std::isnan(value) ? 0.0 : value;
    };
    return {cut,
            level.dh - z_x[0],
            plane_.tan_roll - z_y[0],
            level.ddh - half_difference(z_x, 1),
            -0.5 * (half_difference(z_x, 3) + half_difference(z_y, 1)),
            -half_difference(z_y, 3)};
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
        if (!(cut > 0.0)) continue;
        value[which[k]] += cut;
        if (!d_u.empty()) d_u[which[k]] += level.dh - z_x[k];
        if (!d_y.empty()) d_y[which[k]] += plane_.tan_roll - z_y[k];
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
    const double high = plane_.touching + plane_.depth + std::max(a, b) - z.z_min;
    if (!(high > 0.0)) return {};
    // slopes between the points of a fine grid may be a little steeper than on them
    constexpr double kBetween = 1.1, kLeast = 0.01;
    const double steepest_ramp = 1.5 * plane_.depth / plane_.ramp;
    return {0.0, high, steepest_ramp + kBetween * plane_.steepest_x + kLeast, kBetween * plane_.steepest_y + kLeast};
  }

  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  bool inside(double x) const { return x > plane_.x_start && x < plane_.x_end; }

  std::shared_ptr<const Surface> base_;
  HeadPlane plane_;
};

}  // namespace

ShapePtr make_flattened_head_shape(const FlattenedHead& head, std::shared_ptr<const Surface> base) {
  return std::make_unique<FlattenedHeadShape>(head, std::move(base));
}

}  // namespace treadmark::analytic
