// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/analytic/defects/defects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "treadmark/backends/analytic/chain.hpp"
#include "treadmark/backends/analytic/defects/cut_surface.hpp"
#include "treadmark/backends/analytic/defects/defect_flattened_head.hpp"
#include "treadmark/backends/displacement/displaced_surface.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::analytic {

namespace {

void require_base(const std::shared_ptr<const Surface>& base) {
  if (base == nullptr) throw Error(ErrorKind::configuration, "defects need a surface that they belong to");
}

ArcChain section_chain(const MillingPath& m) {
  ArcChain chain{m.start_y, m.start_z, m.start_angle, {}};
  for (const auto& s : m.section) chain.segments.push_back({s.length, s.curvature});
  return chain;
}

Cutter milling_cutter(const MillingPath& m, std::size_t number) {
  std::vector<double> x;
  CutterPath::Values values;
  for (const auto& s : m.stations) {
    x.push_back(s.x);
    values[CutterPath::kY].push_back(s.y);
    values[CutterPath::kZ].push_back(s.z);
    values[CutterPath::kRoll].push_back(s.roll);
  }
  return {CutterPath::natural_spline(std::move(x), values), graph_of(section_chain(m)),
          "rail.milling_paths[" + std::to_string(number) + ']'};
}

/// The plane of a flattened head as a straight cutter that sinks into the rail and rises again.
Cutter head_cutter(const FlattenedHead& head, const Surface& base, std::size_t number) {
  constexpr double kWidth = 1.0;  // [m] more than any rail
  const HeadPlane plane(head, base);
  std::vector<double> x{head.x_start, head.x_start + head.ramp};
  if (head.x_end - head.ramp > x.back()) x.push_back(head.x_end - head.ramp);
  x.push_back(head.x_end);
  CutterPath::Values values, slopes;
  for (auto& one : values) one.assign(x.size(), 0.0);
  slopes = values;
  for (std::size_t i = 0; i < x.size(); ++i)
    values[CutterPath::kZ][i] = plane.touching + (i == 0 || i + 1 == x.size() ? 0.0 : head.depth);
  std::fill(values[CutterPath::kRoll].begin(), values[CutterPath::kRoll].end(), head.roll);
  return {CutterPath::hermite(std::move(x), values, slopes), graph_of({-0.5 * kWidth, 0.0, 0.0, {{kWidth, 0.0}}}),
          "rail.flattened_heads[" + std::to_string(number) + ']'};
}

void include(std::optional<Rectangle>& all, const Rectangle& one) { all = all ? enclosing(*all, one) : one; }

}  // namespace

std::shared_ptr<const displacement::OffsetField> make_defect_field(const Defects& defects, Body body,
                                                                   double nominal_radius,
                                                                   std::shared_ptr<const Surface> base) {
  check_defects(defects, body, nominal_radius);
  Shapes shapes = make_shapes(defects, nominal_radius);
  if (!defects.flattened_heads.empty()) require_base(base);
  for (const auto& h : defects.flattened_heads) shapes.push_back(make_flattened_head_shape(h, *base, base));
  return std::make_shared<DefectField>(std::move(shapes));
}

std::shared_ptr<const Surface> add_defects(std::shared_ptr<const Surface> base, const Defects& defects, Body body,
                                           double nominal_radius) {
  check_defects(defects, body, nominal_radius);
  if (defects.empty()) return base;
  require_base(base);
  std::shared_ptr<const Surface> surface = base;
  std::vector<Cutter> cutters;
  const std::string name(base->backend());
  for (std::size_t i = 0; i < defects.flattened_heads.size(); ++i)
    if (defects.flattened_heads[i].edge_radius == 0.0)
      cutters.push_back(head_cutter(defects.flattened_heads[i], *base, i));
  if (!cutters.empty()) surface = std::make_shared<CutSurface>(surface, std::move(cutters));
  for (const FlattenedHead& head : defects.flattened_heads) {
    if (head.edge_radius == 0.0) continue;
    Shapes one;
    one.push_back(make_flattened_head_shape(head, *base, surface));
    surface = displacement::make_displaced_surface(surface, std::make_shared<DefectField>(std::move(one)), body, name);
  }
  Shapes shapes = make_shapes(defects, nominal_radius);
  if (!shapes.empty())
    surface =
        displacement::make_displaced_surface(surface, std::make_shared<DefectField>(std::move(shapes)), body, name);
  cutters.clear();
  for (std::size_t i = 0; i < defects.milling_paths.size(); ++i)
    cutters.push_back(milling_cutter(defects.milling_paths[i], i));
  if (!cutters.empty()) surface = std::make_shared<CutSurface>(surface, std::move(cutters));
  return surface;
}

std::optional<Rectangle> defect_region(const Defects& d, double nominal_radius) {
  std::optional<Rectangle> all;
  for (const ShapePtr& shape : make_shapes(d, nominal_radius)) {
    Rectangle support = shape->support();
    if (std::isinf(support.x_min)) support.x_min = -kPi, support.x_max = kPi;  // all round a wheel
    include(all, support);
  }
  for (const auto& h : d.flattened_heads) include(all, {h.x_start, h.x_end, -kEverywhere, kEverywhere});
  for (std::size_t i = 0; i < d.milling_paths.size(); ++i) {
    const Cutter cutter = milling_cutter(d.milling_paths[i], i);
    include(all, {cutter.x_min(), cutter.x_max(), cutter.y_min(), cutter.y_max()});
  }
  return all;
}

using displacement::OffsetJet;
using displacement::OffsetRange;

OffsetJet DefectField::jet(double u, double y) const {
  OffsetJet sum;
  for (const ShapePtr& shape : shapes_) {
    const OffsetJet one = shape->jet(u, y);
    sum.value += one.value;
    sum.d_u += one.d_u;
    sum.d_y += one.d_y;
    sum.d_uu += one.d_uu;
    sum.d_uy += one.d_uy;
    sum.d_yy += one.d_yy;
  }
  return sum;
}

void DefectField::evaluate(std::span<const double> u, std::span<const double> y, std::span<double> value,
                           std::span<double> d_u, std::span<double> d_y) const {
  for (const auto array : {value, d_u, d_y}) std::fill(array.begin(), array.end(), 0.0);
  for (const ShapePtr& shape : shapes_) shape->add(u, y, value, d_u, d_y);
}

OffsetRange DefectField::range(const Rectangle& uy) const {
  OffsetRange sum;
  for (const ShapePtr& shape : shapes_) {
    const OffsetRange one = shape->range(uy);
    sum.low += one.low;
    sum.high += one.high;
    sum.max_d_u += one.max_d_u;
    sum.max_d_y += one.max_d_y;
  }
  return sum;
}

namespace {

/// One shape of a field.
class OneShape final : public displacement::OffsetField {
 public:
  OneShape(std::shared_ptr<const DefectField> whole, const OffsetShape& shape)
      : whole_(std::move(whole)), shape_(shape) {}

  OffsetJet jet(double u, double y) const override { return shape_.jet(u, y); }
  void evaluate(std::span<const double> u, std::span<const double> y, std::span<double> value, std::span<double> d_u,
                std::span<double> d_y) const override {
    for (const auto array : {value, d_u, d_y}) std::fill(array.begin(), array.end(), 0.0);
    shape_.add(u, y, value, d_u, d_y);
  }
  OffsetRange range(const Rectangle& uy) const override { return shape_.range(uy); }
  bool constant_along() const override { return whole_->constant_along(); }
  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  std::shared_ptr<const DefectField> whole_;  ///< which holds the shape
  const OffsetShape& shape_;
};

}  // namespace

std::vector<ShapeParameter> DefectField::parameters() const {
  constexpr double kStep = 1e-4;  // of depths of some tenths of a millimetre
  std::vector<ShapeParameter> out;
  for (std::size_t k = 0; k < shapes_.size(); ++k) out.push_back({"shape_" + std::to_string(k), "1", kStep});
  return out;
}

std::shared_ptr<const displacement::OffsetField> DefectField::changed(std::size_t parameter, double amount) const {
  const std::shared_ptr<const DefectField> whole = shared_from_this();
  return displacement::with_more(whole, std::make_shared<OneShape>(whole, *shapes_[parameter]), amount);
}

std::size_t DefectField::memory_bytes() const {
  std::size_t sum = sizeof(*this) + shapes_.capacity() * sizeof(ShapePtr);
  for (const ShapePtr& shape : shapes_) sum += shape->memory_bytes();
  return sum;
}

}  // namespace treadmark::analytic
