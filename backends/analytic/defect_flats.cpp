// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/defect_shapes.hpp"
#include "treadmark/backends/analytic/flat_depth.hpp"

namespace treadmark::analytic {

namespace {

class FlatsShape final : public OffsetShape {
 public:
  FlatsShape(const std::vector<WheelFlat>& flats, double nominal_radius) : depth_(flats, nominal_radius) {}

  displacement::OffsetJet jet(double theta, double y) const override {
    const DepthJet d = depth_.jet(theta, y);
    return {-d.d, -d.d_theta, -d.d_y, -d.d_theta_theta, -d.d_theta_y, -d.d_y_y};
  }

  void add(std::span<const double> theta, std::span<const double> y, std::span<double> value, std::span<double> d_u,
           std::span<double> d_y) const override {
    for (std::size_t i = 0; i < theta.size(); ++i) {
      const DepthJet d = depth_.jet(theta[i], y[i]);
      value[i] -= d.d;
      if (!d_u.empty()) d_u[i] -= d.d_theta;
      if (!d_y.empty()) d_y[i] -= d.d_y;
    }
  }

  displacement::OffsetRange range(const Rectangle& r) const override {
    const FlatDepth::Range d = depth_.range(0.5 * (r.x_min + r.x_max), 0.5 * (r.x_max - r.x_min), r.y_min, r.y_max);
    return {-d.high, -d.low, d.max_d_theta, d.max_d_y};
  }

  std::size_t memory_bytes() const override { return sizeof(*this) + depth_.memory_bytes(); }

 private:
  FlatDepth depth_;
};

}  // namespace

ShapePtr make_flats_shape(const std::vector<WheelFlat>& flats, double nominal_radius) {
  return std::make_unique<FlatsShape>(flats, nominal_radius);
}

}  // namespace treadmark::analytic
