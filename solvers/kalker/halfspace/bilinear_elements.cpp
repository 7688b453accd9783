// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/bilinear_elements.hpp"

#include <cmath>
#include <numbers>

#include "treadmark/solvers/kalker/halfspace/bilinear_cell.hpp"
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"

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

}  // namespace treadmark::kalker
