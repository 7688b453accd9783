// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/defect_field.hpp"

#include <algorithm>

namespace treadmark::analytic {

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

std::size_t DefectField::memory_bytes() const {
  std::size_t sum = sizeof(*this) + shapes_.capacity() * sizeof(ShapePtr);
  for (const ShapePtr& shape : shapes_) sum += shape->memory_bytes();
  return sum;
}

}  // namespace treadmark::analytic
