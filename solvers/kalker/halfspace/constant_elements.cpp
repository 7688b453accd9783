// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"

#include <cmath>
#include <numbers>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/halfspace/influence.hpp"

namespace treadmark::kalker {

namespace {

/// A rectangle seen from the origin.
struct Rectangle {
  double X, Y, dx, dy;
  double x1() const { return X - 0.5 * dx; }
  double x2() const { return X + 0.5 * dx; }
  double y1() const { return Y - 0.5 * dy; }
  double y2() const { return Y + 0.5 * dy; }
};

/// ln(r2 / r1) of the ends of the horizontal edge at y, times factor; zero where a factor of zero meets a corner at the
/// origin.
double edge_logarithm(const Rectangle& a, double y, double factor) {
  const double x1 = a.x1(), r1_squared = x1 * x1 + y * y;
  if (factor == 0.0 || r1_squared == 0.0) return 0.0;
  return factor * 0.5 * std::log1p(2.0 * a.X * a.dx / r1_squared);
}

/// Double difference of y ln r over the corners, for X, Y >= 0.
double logarithms(const Rectangle& a) {
  if (a.Y <= a.dy) return edge_logarithm(a, a.y2(), a.y2()) - edge_logarithm(a, a.y1(), a.y1());
  // Far away both edges give nearly the same: mean and difference, the latter from the ratio of products of opposite
  // corners.
  const double x1 = a.x1(), x2 = a.x2(), y1 = a.y1(), y2 = a.y2();
  const double difference =
      0.5 * std::log1p(-4.0 * a.X * a.Y * a.dx * a.dy / ((x1 * x1 + y2 * y2) * (x2 * x2 + y1 * y1)));
  return a.Y * difference + 0.5 * (edge_logarithm(a, y1, a.dy) + edge_logarithm(a, y2, a.dy));
}

/// Angle that the vertical edge at x subtends at the origin, with the sign of x.
double edge_angle(const Rectangle& a, double x) { return std::atan2(x * a.dy, x * x + a.y1() * a.y2()); }

/// Double difference of x atan(y/x) over the corners, for X, Y >= 0.
double angles(const Rectangle& a) {
  const double x1 = a.x1(), x2 = a.x2(), y1 = a.y1(), y2 = a.y2();
  const double angle_1 = edge_angle(a, x1), angle_2 = edge_angle(a, x2);
  if (x1 < 0.0) {
    // Angles of opposite signs: their sum as the argument of a product.
    const double edges = y1 * y2;
    const double sum =
        std::atan2(2.0 * a.dy * a.X * (x1 * x2 + edges), (x1 * x1 + edges) * (x2 * x2 + edges) - x1 * x2 * a.dy * a.dy);
    return a.X * (angle_2 - angle_1) + 0.5 * a.dx * sum;
  }
  if (a.X <= a.dx) return x2 * angle_2 - x1 * angle_1;
  // Nearly equal angles: their difference as the argument of the ratio of products of opposite corners.
  const double area = a.dx * a.dy, opposite = (x1 * x1 + y2 * y2) * (x2 * x2 + y1 * y1);
  const double difference = std::atan2(-area * (x1 * x2 - y1 * y2), opposite - area * (x1 * y1 + x2 * y2));
  return a.X * difference + 0.5 * a.dx * (angle_1 + angle_2);
}

}  // namespace

double coupling_integral(double X, double Y, double dx, double dy) {
  // In units of the rectangle, so that fourth powers neither overflow nor vanish.
  const double unit = std::sqrt(dx * dy);
  const Rectangle scaled{std::abs(X) / unit, std::abs(Y) / unit, dx / unit, dy / unit};
  return std::copysign(unit * (logarithms(scaled) + angles(scaled)), X);
}

double significant_difference(double difference) {
  constexpr double kSmallest = 1e-6;
  return std::abs(difference) < kSmallest ? 0.0 : difference;
}

void check_element_size(double dx, double dy) {
  if (!(dx > 0.0 && dy > 0.0 && std::isfinite(dx) && std::isfinite(dy)))
    throw Error(ErrorKind::configuration,
                "elements must have positive sizes, not " + std::to_string(dx) + " m x " + std::to_string(dy) + " m");
}

ConstantElements::ConstantElements(double dx, double dy, double poisson, double difference)
    : dx_(dx), dy_(dy), poisson_(poisson), difference_(significant_difference(difference)) {
  check_element_size(dx, dy);
}

InfluenceBlock ConstantElements::at(double X, double Y) const {
  const UncoupledCoefficients c = influence(X, Y, dx_, dy_, poisson_);
  InfluenceBlock block{.xx = c.xx, .xy = c.xy, .yx = c.xy, .yy = c.yy, .nn = c.nn};
  if (difference_ == 0.0) return block;
  block.nx = difference_ * std::numbers::inv_pi * coupling_integral(X, Y, dx_, dy_);
  block.ny = difference_ * std::numbers::inv_pi * coupling_integral(Y, X, dy_, dx_);
  block.xn = -block.nx;
  block.yn = -block.ny;
  return block;
}

}  // namespace treadmark::kalker
