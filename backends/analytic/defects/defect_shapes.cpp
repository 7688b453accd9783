// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/analytic/defects/defect_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/backends/analytic/defects/flat_depth.hpp"
#include "treadmark/core/constants.hpp"

namespace treadmark::analytic {

namespace {

class FlatsShape final : public OffsetShape {
 public:
  FlatsShape(const std::vector<WheelFlat>& flats, double nominal_radius)
      : depth_(flats, nominal_radius), support_(support_of(flats.front(), nominal_radius)) {
    for (const WheelFlat& f : flats) support_ = enclosing(support_, support_of(f, nominal_radius));
  }

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

  Rectangle support() const override { return support_; }
  std::size_t memory_bytes() const override { return sizeof(*this) + depth_.memory_bytes(); }

 private:
  static Rectangle support_of(const WheelFlat& f, double nominal_radius) {
    const double half = half_angle_of(f, nominal_radius);
    const double center = wrap_angle(f.theta_center);
    return faded_support(center - half, center + half, f.y_center, f.width);
  }

  FlatDepth depth_;
  Rectangle support_;
};

ShapePtr dip(double length, double width, double depth, double x, double y) {
  const CosineBump along{x, 0.5 * length}, across{y, 0.5 * width};
  return product_shape(depth, along, across, {along.begin(), along.end(), across.begin(), across.end()});
}

/// What cuts a surface does not displace it.
void add_shapes(const std::vector<FlattenedHead>&, double, Shapes&) {}
void add_shapes(const std::vector<MillingPath>&, double, Shapes&) {}

void add_shapes(const std::vector<WheelFlat>& flats, double nominal_radius, Shapes& shapes) {
  if (!flats.empty()) shapes.push_back(std::make_unique<FlatsShape>(flats, nominal_radius));
}

void add_shapes(const std::vector<Polygonization>& polygonizations, double, Shapes& shapes) {
  for (const Polygonization& p : polygonizations) {
    // whole orders: the sum has the period of theta by itself
    WaveSum waves;
    for (const auto& h : p.harmonics) waves.waves.push_back({static_cast<double>(h.order), h.amplitude, h.phase});
    shapes.push_back(product_shape(1.0, std::move(waves), lateral_fading(p.y_center, p.width),
                                   faded_support(-kEverywhere, kEverywhere, p.y_center, p.width)));
  }
}

void add_shapes(const std::vector<Squat>& squats, double, Shapes& shapes) {
  for (const Squat& s : squats) {
    shapes.push_back(dip(s.length, s.width, s.depth, s.x_center, s.y_center));
    if (s.second_depth > 0.0)
      shapes.push_back(dip(s.second_length > 0.0 ? s.second_length : s.length,
                           s.second_width > 0.0 ? s.second_width : s.width, s.second_depth,
                           s.x_center - s.second_distance, s.y_center + s.second_y_offset));
  }
}

void add_shapes(const std::vector<Corrugation>& corrugations, double, Shapes& shapes) {
  for (const Corrugation& c : corrugations) {
    WaveSum waves{c.x_start, {}};
    for (const auto& w : c.waves) waves.waves.push_back({2.0 * kPi / w.wavelength, w.amplitude, w.phase});
    const CosineWindow window{c.x_start, c.x_end, c.ramp};
    shapes.push_back(product_shape(1.0, FunctionProduct<WaveSum, CosineWindow>{std::move(waves), window},
                                   lateral_fading(c.y_center, c.width),
                                   faded_support(c.x_start, c.x_end, c.y_center, c.width)));
  }
}

void add_shapes(const std::vector<GaugeCornerCollapse>& collapses, double, Shapes& shapes) {
  for (const GaugeCornerCollapse& g : collapses) {
    const CosineBump along{g.x_center, 0.5 * g.length};
    const CosineStep across{g.y_start, g.gauge_side * g.width};
    shapes.push_back(product_shape(g.depth, along, across,
                                   {along.begin(), along.end(), g.gauge_side < 0 ? -kEverywhere : g.y_start,
                                    g.gauge_side < 0 ? g.y_start : kEverywhere}));
  }
}

/// A floor between edges; scale: offset of the floor, length_scale: of u to a length.
template <class Pit>
ShapePtr pit(const Pit& s, double scale, double u_center, double length_scale) {
  const double half = 0.5 * s.length / length_scale;
  const CosineWindow along{u_center - half, u_center + half, s.edge / length_scale};
  const CosineWindow across{s.y_center - 0.5 * s.width, s.y_center + 0.5 * s.width, s.edge};
  return product_shape(scale, along, across, {along.start, along.end, across.start, across.end});
}

void add_shapes(const std::vector<Spall>& spalls, double, Shapes& shapes) {
  for (const Spall& s : spalls) shapes.push_back(pit(s, s.depth, s.x_center, 1.0));
}

void add_shapes(const std::vector<WheelSpall>& spalls, double nominal_radius, Shapes& shapes) {
  for (const WheelSpall& s : spalls) {
    const double center = wrap_angle(s.theta_center);
    shapes.push_back(std::make_unique<WoundShape>(center, pit(s, -s.depth, center, nominal_radius)));
  }
}

}  // namespace

Shapes make_shapes(const Defects& defects, double nominal_radius) {
  Shapes shapes;
  Defects::each(defects, [&](const char*, Body, const auto& list) { add_shapes(list, nominal_radius, shapes); });
  return shapes;
}

}  // namespace treadmark::analytic
