// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/contact/hertz_ellipse.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/elliptic_integrals.hpp"
#include "treadmark/core/roots.hpp"

namespace treadmark {
namespace {

/// Axis ratio g for a ratio of curvatures, both in (0, 1]; the first falls with the second.
double axis_ratio(double curvature_ratio) {
  return bisect(0.0, 1.0, [&](double g) { return hertz_curvature_ratio(g) < curvature_ratio; }).middle();
}

/// What does not depend on the load: axis ratio, its integrals, mean radius.
struct EllipseShape {
  double g, rho;
  EllipseIntegrals integrals;
  EllipseShape(double a, double b)
      : g(axis_ratio(std::min(a, b) / std::max(a, b))), rho(2.0 / (a + b)), integrals(ellipse_integrals(g)) {}
};

/// c: sqrt(ab)
HertzEllipse ellipse_of(const EllipseShape& shape, double c, bool first_is_small, double force, double approach) {
  const double small = c * std::sqrt(shape.g), large = c / std::sqrt(shape.g);
  return {first_is_small ? small : large, first_is_small ? large : small, force, approach};
}

}  // namespace

EllipseIntegrals ellipse_integrals(double g) {
  const double k_squared = (1.0 - g) * (1.0 + g);
  const double k = std::sqrt(k_squared);
  const double first = comp_ellint_1(k), second = comp_ellint_2(k);
  // The quotient loses its digits for nearly circular contacts; series of the integral of cos^2/sqrt(1 - k^2 sin^2).
  const double combined = k_squared < 1e-4 ? kPi / 4.0 * (1.0 + k_squared / 8.0 + 3.0 * k_squared * k_squared / 64.0)
                                           : (second - g * g * first) / k_squared;
  return {first, second, combined};
}

double hertz_curvature_ratio(double g) {
  const auto [first, second, combined] = ellipse_integrals(g);
  return (second - combined) / combined;
}

double HertzEllipse::largest_pressure() const { return 1.5 * force / (kPi * semi_axis_x * semi_axis_y); }

HertzEllipse hertz_by_force(double curvature_x, double curvature_y, double force, double modulus) {
  const EllipseShape s(curvature_x, curvature_y);
  const auto [first, second, combined] = s.integrals;
  const double c = std::cbrt(3.0 * force * s.rho * second / (4.0 * kPi * modulus * std::sqrt(s.g)));
  return ellipse_of(s, c, curvature_x >= curvature_y, force, 2.0 * c * c * s.g * first / (s.rho * second));
}

HertzEllipse hertz_by_approach(double curvature_x, double curvature_y, double approach, double modulus) {
  const EllipseShape s(curvature_x, curvature_y);
  const auto [first, second, combined] = s.integrals;
  const double c = std::sqrt(approach * s.rho * second / (2.0 * first * s.g));
  return ellipse_of(s, c, curvature_x >= curvature_y,
                    4.0 * kPi * c * c * c * modulus * std::sqrt(s.g) / (3.0 * s.rho * second), approach);
}

}  // namespace treadmark
