// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/kalker/halfspace/influence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "treadmark/solvers/kalker/halfspace/element_blocks.hpp"

namespace treadmark::kalker {

namespace {

/// y * ln((x2 + r2) / (x1 + r1)) for x2 > x1, x2 > -x1: the difference of two nearby logarithms without cancellation.
double log_ratio_term(double y, double x1, double x2) {
  if (y == 0.0) return 0.0;
  const double r1 = std::hypot(x1, y), r2 = std::hypot(x2, y);
  const double r_difference = (x2 - x1) * (x2 + x1) / (r1 + r2);
  const double denominator = x1 >= 0.0 ? x1 + r1 : y * y / (r1 - x1);
  return y * std::log1p(((x2 - x1) + r_difference) / denominator);
}

/// Double difference of y ln(x + r) over the corners of the rectangle.
double log_integral(double x1, double x2, double y1, double y2) {
  return log_ratio_term(y2, x1, x2) - log_ratio_term(y1, x1, x2);
}

/// Double difference of r over the corners, free of cancellation.
double distance_integral(double X, double Y, double dx, double dy) {
  const double x1 = X - 0.5 * dx, x2 = X + 0.5 * dx, y1 = Y - 0.5 * dy, y2 = Y + 0.5 * dy;
  const double r11 = std::hypot(x1, y1), r12 = std::hypot(x1, y2), r21 = std::hypot(x2, y1), r22 = std::hypot(x2, y2);
  return -4.0 * X * Y * dx * dy * (1.0 / (r12 + r22) + 1.0 / (r11 + r21)) / ((r22 + r21) * (r12 + r11));
}

}  // namespace

UncoupledCoefficients influence(double X, double Y, double dx, double dy, double poisson) {
  const double x1 = std::abs(X) - 0.5 * dx, x2 = std::abs(X) + 0.5 * dx, y1 = std::abs(Y) - 0.5 * dy,
               y2 = std::abs(Y) + 0.5 * dy;
  const double across = log_integral(x1, x2, y1, y2);  // of y ln(x + r)
  const double along = log_integral(y1, y2, x1, x2);   // of x ln(y + r)
  return {.nn = (1.0 - poisson) * std::numbers::inv_pi * (across + along),
          .xx = std::numbers::inv_pi * (across + (1.0 - poisson) * along),
          .yy = std::numbers::inv_pi * (along + (1.0 - poisson) * across),
          .xy = -poisson * std::numbers::inv_pi * distance_integral(X, Y, dx, dy)};
}

double influence(Component component, double X, double Y, double dx, double dy, double poisson) {
  if (component == Component::xy) return -poisson * std::numbers::inv_pi * distance_integral(X, Y, dx, dy);
  const UncoupledCoefficients all = influence(X, Y, dx, dy, poisson);
  return component == Component::nn ? all.nn : component == Component::xx ? all.xx : all.yy;
}

InfluenceTable::InfluenceTable(Component component, double dx, double dy, double poisson)
    : component_(component), dx_(dx), dy_(dy), poisson_(poisson), odd_(component == Component::xy) {}

namespace {

/// Values of a table that grows from old_nx x old_ny: those it has, or fresh ones.
template <class Value, class Known, class Fresh>
void grow_table(std::vector<Value>& values, int& nx, int& ny, int wanted_nx, int wanted_ny, const Known& known,
                const Fresh& fresh) {
  const int new_nx = std::max(wanted_nx, nx), new_ny = std::max(wanted_ny, ny);
  if (new_nx == nx && new_ny == ny) return;
  std::vector<Value> grown;
  const auto width = static_cast<std::size_t>(new_nx);
  fill_by_blocks(grown, width * static_cast<std::size_t>(new_ny), [&](std::size_t i) {
    const int ix = static_cast<int>(i % width), iy = static_cast<int>(i / width);
    return ix < nx && iy < ny ? known(ix, iy) : fresh(ix, iy);
  });
  values = std::move(grown);
  nx = new_nx;
  ny = new_ny;
}

}  // namespace

void InfluenceTable::grow(int nx, int ny) {
  grow_table(
      values_, nx_, ny_, nx, ny, [this](int ix, int iy) { return (*this)(ix, iy); },
      [this](int ix, int iy) { return influence(component_, ix * dx_, iy * dy_, dx_, dy_, poisson_); });
}

void UncoupledTable::grow(int nx, int ny) {
  grow_table(
      values_, nx_, ny_, nx, ny, [this](int ix, int iy) { return at(ix, iy); },
      [this](int ix, int iy) { return influence(ix * dx_, iy * dy_, dx_, dy_, poisson_); });
}

}  // namespace treadmark::kalker
