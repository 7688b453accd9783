// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/kalker/halfspace/bilinear_elements.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"
#include "treadmark/solvers/kalker/halfspace/gauss_legendre.hpp"

namespace treadmark::kalker {

BilinearElements::BilinearElements(double dx, double dy, double poisson, double difference)
    : dx_(dx), dy_(dy), poisson_(poisson), difference_(significant_difference(difference)) {
  check_element_size(dx, dy);
}

InfluenceBlock BilinearElements::at(double X, double Y) const {
  const double unit = std::sqrt(dx_ * dy_), dx = dx_ / unit, dy = dy_ / unit, x = std::abs(X) / unit,
               y = std::abs(Y) / unit;
  PointSolutionIntegrals integral;
  for (const LinearSide& side_x : {LinearSide{x - dx, dx, 0.0, 1.0}, LinearSide{x, dx, 1.0, 0.0}})
    for (const LinearSide& side_y : {LinearSide{y - dy, dy, 0.0, 1.0}, LinearSide{y, dy, 1.0, 0.0}})
      integral += integrate_cell(side_x, side_y);
  // Exactly, not to rounding: what is odd vanishes on the axes.
  if (X == 0.0) integral.x = integral.xy = 0.0;
  if (Y == 0.0) integral.y = integral.xy = 0.0;

  const double factor = unit * std::numbers::inv_pi;
  InfluenceBlock block;
  block.nn = factor * (1.0 - poisson_) * integral.r;
  block.xx = block.nn + factor * poisson_ * integral.xx;
  block.yy = block.nn + factor * poisson_ * (integral.r - integral.xx);
  block.xy = block.yx = factor * poisson_ * integral.xy;
  block.nx = factor * difference_ * integral.x;
  block.ny = factor * difference_ * integral.y;
  block.xn = -block.nx;
  block.yn = -block.ny;
  return mirrored(block, X < 0.0, Y < 0.0);
}

namespace {

/// Weights of 1, x, y, xy in a traction.
using Weights = std::array<double, 4>;

/// ln(a + r) with r^2 = a^2 + b^2, b != 0, times factor; for negative a without cancellation.
double logarithm(double factor, double a, double b, double r) {
  if (factor == 0.0) return 0.0;
  return factor * (a >= 0.0 ? std::log(a + r) : 2.0 * std::log(std::abs(b)) - std::log(r - a));
}

/// Primitives (mixed derivative by x and y = integrand) at one corner of the traction times each term.
PointSolutionIntegrals primitives(double x, double y, const Weights& w) {
  const double r = std::hypot(x, y);
  if (r == 0.0) return {};
  const double x_log = logarithm(x, y, x, r), y_log = logarithm(y, x, y, r);  // x ln(y + r), y ln(x + r)
  const double log_r = std::log(r);
  const double x_angle = x == 0.0 ? 0.0 : x * std::atan(y / x), y_angle = y == 0.0 ? 0.0 : y * std::atan(x / y);
  const double xxy = (y * y_log - x * r) / 2.0, xyy = (x * x_log - y * r) / 2.0, xy = r * r * log_r / 2.0;
  const double angles = (x * x_angle - y * y_angle) / 2.0;
  return {
      .r = w[0] * (x_log + y_log) + w[1] * (x * x_log + y * r) / 2.0 + w[2] * (y * y_log + x * r) / 2.0 +
           w[3] * r * r * r / 3.0,
      .xx = w[0] * y_log + w[1] * y * r + w[2] * xxy + w[3] * r * (2.0 * y * y - x * x) / 3.0,
      .xy = -w[0] * r + w[1] * xxy + w[2] * xyy + w[3] * (x * x * x_log + y * y * y_log - x * y * r) / 3.0,
      .x = w[0] * (y * log_r + x_angle) + w[1] * (angles + x * y / 2.0) + w[2] * xy +
           w[3] * (x * x * x * log_r - y * y * y_angle + x * y * y) / 3.0,
      .y = w[0] * (x * log_r + y_angle) + w[1] * xy + w[2] * (x * y / 2.0 - angles) +
           w[3] * (y * y * y * log_r - x * x * x_angle + y * x * x) / 3.0,
  };
}

PointSolutionIntegrals in_closed_form(const LinearSide& x, const LinearSide& y) {
  const double slope_x = (x.at_end - x.at_begin) / x.length, slope_y = (y.at_end - y.at_begin) / y.length;
  const double at_x = x.at_begin - slope_x * x.begin, at_y = y.at_begin - slope_y * y.begin;
  const Weights plus{at_x * at_y, slope_x * at_y, at_x * slope_y, slope_x * slope_y};
  const Weights minus{-plus[0], -plus[1], -plus[2], -plus[3]};
  PointSolutionIntegrals sum = primitives(x.end(), y.end(), plus);
  sum += primitives(x.begin, y.end(), minus);
  sum += primitives(x.end(), y.begin, minus);
  sum += primitives(x.begin, y.begin, plus);
  return sum;
}

/// Enough Gauss nodes for rounding accuracy: the error falls as the size of the Bernstein ellipse that reaches the
/// origin.
GaussRule rule_for(double length, double distance) {
  constexpr double kDigits = 36.0;  // natural logarithm of the accuracy
  const double ellipse = std::asinh(2.0 * distance / length);
  return gauss_legendre(std::clamp(to_whole<int>(std::ceil(0.5 * kDigits / ellipse)), 2, kMostGaussNodes));
}

PointSolutionIntegrals by_quadrature(const LinearSide& x, const LinearSide& y, double distance) {
  const GaussRule rule_x = rule_for(x.length, distance), rule_y = rule_for(y.length, distance);
  PointSolutionIntegrals sum;
  for (std::size_t ix = 0; ix < rule_x.nodes.size(); ++ix) {
    const double share_x = 0.5 + 0.5 * rule_x.nodes[ix], px = x.begin + share_x * x.length;
    const double weight_x = 0.25 * rule_x.weights[ix] * x.length * y.length * std::lerp(x.at_begin, x.at_end, share_x);
    for (std::size_t iy = 0; iy < rule_y.nodes.size(); ++iy) {
      const double share_y = 0.5 + 0.5 * rule_y.nodes[iy], py = y.begin + share_y * y.length;
      const double inverse = 1.0 / std::sqrt(px * px + py * py);
      const double weight = inverse * weight_x * rule_y.weights[iy] * std::lerp(y.at_begin, y.at_end, share_y);
      const double cosine = px * inverse, sine = py * inverse;
      sum += {.r = weight,
              .xx = weight * cosine * cosine,
              .xy = weight * cosine * sine,
              .x = weight * cosine,
              .y = weight * sine};
    }
  }
  return sum;
}

double distance_to(const LinearSide& side) { return std::max({side.begin, -side.end(), 0.0}); }

std::array<LinearSide, 2> halves(const LinearSide& side) {
  const double half = 0.5 * side.length, at_middle = 0.5 * (side.at_begin + side.at_end);
  return {{{side.begin, half, side.at_begin, at_middle}, {side.begin + half, half, at_middle, side.at_end}}};
}

}  // namespace

PointSolutionIntegrals integrate_cell(const LinearSide& x, const LinearSide& y) {
  const double distance = std::hypot(distance_to(x), distance_to(y));
  if (distance >= std::max(x.length, y.length)) return by_quadrature(x, y, distance);
  // Differences of primitives cancel for points that are far away compared to the shorter side.
  const bool split_x = x.length > 2.0 * y.length, split_y = y.length > 2.0 * x.length;
  if (!split_x && !split_y) return in_closed_form(x, y);
  PointSolutionIntegrals sum;
  for (const LinearSide& half : halves(split_x ? x : y))
    sum += split_x ? integrate_cell(half, y) : integrate_cell(x, half);
  return sum;
}

}  // namespace treadmark::kalker
