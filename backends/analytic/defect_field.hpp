// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/analytic/defect_shapes.hpp"
#include "treadmark/backends/displacement/offset_field.hpp"

namespace treadmark::analytic {

/// Sum of shapes.
class DefectField final : public displacement::OffsetField {
 public:
  explicit DefectField(std::vector<ShapePtr> shapes) : shapes_(std::move(shapes)) {}

  displacement::OffsetJet jet(double u, double y) const override;
  void evaluate(std::span<const double> u, std::span<const double> y, std::span<double> value, std::span<double> d_u,
                std::span<double> d_y) const override;
  displacement::OffsetRange range(const Rectangle& uy) const override;
  std::size_t memory_bytes() const override;

 private:
  std::vector<ShapePtr> shapes_;
};

}  // namespace treadmark::analytic
