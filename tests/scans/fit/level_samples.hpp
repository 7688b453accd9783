// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cmath>

#include "treadmark/scans/fit/spline_field.hpp"
#include "treadmark/tests/scans/cleaning/band_samples.hpp"

namespace treadmark::scans::tests {

/// The uniform B-spline of a degree over [0, degree + 1] (Cox and de Boor 1972).
inline double b_spline(int degree, double x) {
  if (degree == 0) return x >= 0.0 && x < 1.0 ? 1.0 : 0.0;
  return (x * b_spline(degree - 1, x) + (degree + 1.0 - x) * b_spline(degree - 1, x - 1.0)) / degree;
}

/// Function f of a level: the i-th begins three intervals before interval i; round a closed band it comes again and
/// again.
inline double function_value(const SplineLevel& level, std::size_t f, double a, double s) {
  const double x = a / level.knot_a - static_cast<double>(f / level.functions_s()) + 3.0,
               y = s / level.knot_s - static_cast<double>(f % level.functions_s()) + 3.0;
  double along = b_spline(3, x);
  if (level.closed)
    for (const double turn : {-2.0, -1.0, 1.0, 2.0})
      along += b_spline(3, x + turn * static_cast<double>(level.intervals_a));
  return along * b_spline(3, y);
}

inline SplineLevel level_of(double length, double width, std::size_t along, std::size_t across, bool closed) {
  SplineLevel out;
  out.intervals_a = along;
  out.intervals_s = across;
  out.closed = closed;
  out.knot_a = length / static_cast<double>(along);
  out.knot_s = width / static_cast<double>(across);
  out.active.assign(out.size(), 1);
  out.coefficient.assign(out.size(), 0.0f);
  return out;
}

/// Coefficients from a function's values in the middle of each basis function: smooths it by a sixth of the second
/// derivative times the square of the knots' distance.
template <class Function>
void sample_into(SplineLevel& level, const Function& f) {
  for (std::size_t i = 0; i < level.functions_a(); ++i)
    for (std::size_t k = 0; k < level.functions_s(); ++k)
      level.coefficient[i * level.functions_s() + k] = static_cast<float>(
          f(level.knot_a * (static_cast<double>(i) - 1.0), level.knot_s * (static_cast<double>(k) - 1.0)));
}

}  // namespace treadmark::scans::tests
