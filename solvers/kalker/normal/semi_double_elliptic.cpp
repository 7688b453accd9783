// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/semi_double_elliptic.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "treadmark/core/error.hpp"

namespace treadmark::kalker {

HertzShape hertz_semi_double_elliptic(double a, double b_minus, double b_plus, const HertzLoad& load,
                                      const CombinedMaterial& material) {
  for (const double b : {b_minus, b_plus})
    if (!(b > 0.0) || !std::isfinite(b))
      throw Error(ErrorKind::configuration,
                  "semi-double-elliptic contact: a semi-axis along y is " + std::to_string(b) + " m", {},
                  "it must be positive and finite");
  HertzShape shape = hertz_from_semi_axes(a, 0.5 * (b_minus + b_plus), load, material);
  shape.semi_axis_y_minus = b_minus;
  shape.semi_axis_y_plus = b_plus;
  return shape;
}

bool is_semi_double_elliptic(const HertzShape& shape) {
  return shape.semi_axis_y_minus > 0.0 && shape.semi_axis_y_plus > 0.0;
}

double semi_double_elliptic_pressure(const HertzShape& shape, double x, double y) {
  const double from_joint = y - 0.5 * (shape.semi_axis_y_minus - shape.semi_axis_y_plus);
  const double s = x / shape.semi_axis_x;
  const double t = from_joint / (from_joint < 0.0 ? shape.semi_axis_y_minus : shape.semi_axis_y_plus);
  const double depth = 1.0 - s * s - t * t;
  if (!(depth > 0.0)) return 0.0;
  return 1.5 * shape.force / (std::numbers::pi * shape.semi_axis_x * shape.semi_axis_y) * std::sqrt(depth);
}

}  // namespace treadmark::kalker
