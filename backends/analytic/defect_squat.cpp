// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/defect_shapes.hpp"

namespace treadmark::analytic {

namespace {

ShapePtr dip(double length, double width, double depth, double x, double y) {
  const CosineBump along{x, 0.5 * length}, across{y, 0.5 * width};
  return product_shape(depth, along, across, {along.begin(), along.end(), across.begin(), across.end()});
}

}  // namespace

std::vector<ShapePtr> make_squat_shapes(const Squat& s) {
  std::vector<ShapePtr> dips;
  dips.push_back(dip(s.length, s.width, s.depth, s.x_center, s.y_center));
  if (s.second_depth > 0.0)
    dips.push_back(dip(s.second_length > 0.0 ? s.second_length : s.length,
                       s.second_width > 0.0 ? s.second_width : s.width, s.second_depth, s.x_center - s.second_distance,
                       s.y_center + s.second_y_offset));
  return dips;
}

}  // namespace treadmark::analytic
