// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "treadmark/backends/analytic/defects/defect_shapes.hpp"
#include "treadmark/backends/displacement/offset_field.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/defects.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::analytic {

/// All offsets of the defects but milling, added up. base is asked where a flattened head needs it, and kept.
/// Errors: Error(configuration) of check_defects: it names the list and the number of the shape.
std::shared_ptr<const displacement::OffsetField> make_defect_field(const Defects& defects, Body body,
                                                                   double nominal_radius,
                                                                   std::shared_ptr<const Surface> base);

/// A base of any backend with all its defects: cut down to flattened heads, displaced by the other shapes, then milled.
/// Returns base itself without any. The result's backend() is the base's. Cuts are exact in every view; the walls at
/// the ends of a milling section or path belong to the surface. Errors: as above, and a milling path that is steeper
/// than 45 degrees between its stations.
std::shared_ptr<const Surface> add_defects(std::shared_ptr<const Surface> base, const Defects& defects, Body body,
                                           double nominal_radius);

/// The part of the surface that the defects change: u (x [m] or theta [rad], of flats across the seam beyond +-pi) and
/// y, infinite for shapes as wide as the profile; nothing without defects.
std::optional<Rectangle> defect_region(const Defects& defects, double nominal_radius);

/// Sum of shapes. Parameters are their amounts, shape_0, shape_1 ...: 1 more is that shape once more.
class DefectField final : public displacement::OffsetField, public std::enable_shared_from_this<DefectField> {
 public:
  explicit DefectField(std::vector<ShapePtr> shapes) : shapes_(std::move(shapes)) {}

  displacement::OffsetJet jet(double u, double y) const override;
  void evaluate(std::span<const double> u, std::span<const double> y, std::span<double> value, std::span<double> d_u,
                std::span<double> d_y) const override;
  displacement::OffsetRange range(const Rectangle& uy) const override;
  std::vector<ShapeParameter> parameters() const override;
  std::size_t parameter_count() const override { return shapes_.size(); }
  std::shared_ptr<const displacement::OffsetField> changed(std::size_t parameter, double amount) const override;
  double by(std::size_t parameter, double u, double y) const override { return shapes_[parameter]->jet(u, y).value; }
  std::size_t memory_bytes() const override;

 private:
  std::vector<ShapePtr> shapes_;
};

}  // namespace treadmark::analytic
