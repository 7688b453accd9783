// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/analyn.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/solvers/kalker/normal/hertz.hpp"

namespace treadmark::kalker {

namespace {

/// Elements on each side of the deepest one of a row that the curvature along the row is fitted to, at most.
constexpr int kMostElements = 10;
/// They must overlap by more than this share of the row's deepest overlap.
constexpr double kFittedShare = 0.3;

/// The deepest point of a row: vertex of the parabola through the deepest element and its neighbours.
struct Vertex {
  double x = 0.0, distance = 0.0;  ///< [m], < 0: overlap
};

Vertex vertex(const Interpenetration& overlap, int iy, bool at_element) {
  const int ix = overlap.deepest_column(iy);
  const double behind = overlap.distance(ix - 1, iy), here = overlap.distance(ix, iy),
               ahead = overlap.distance(ix + 1, iy);
  Vertex result{overlap.grid().x(ix), here};
  const double second = behind - 2.0 * here + ahead;
  if (at_element || !std::isfinite(second) || !(second > 0.0)) return result;
  const double share = 0.5 * (behind - ahead) / second;
  result.x += share * overlap.grid().dx;
  result.distance -= 0.5 * share * share * second;
  return result;
}

/// A of A x^2 about the deepest element of a row, by least squares over an equal number of elements on both sides.
double curvature_along(const Interpenetration& overlap, int iy) {
  const int ix = overlap.deepest_column(iy);
  const double here = overlap.distance(ix, iy), dx = overlap.grid().dx;
  const auto greater_neighbour = [&](int k) {
    return std::max(overlap.distance(ix - k, iy), overlap.distance(ix + k, iy));
  };
  if (!std::isfinite(greater_neighbour(1))) {  // at the border: the inner side, mirrored
    const double inner = std::min(overlap.distance(ix - 1, iy), overlap.distance(ix + 1, iy));
    return std::isfinite(inner) ? std::max(kLeastCurvature, (inner - here) / (dx * dx)) : kLeastCurvature;
  }
  int reach = 1;
  while (reach < kMostElements && greater_neighbour(reach + 1) < kFittedShare * here) ++reach;
  // Mean of k^2 over -reach .. reach; A is the slope of the distance over k^2.
  const double mean = reach * (reach + 1) / 3.0;
  double product = 0.0, square = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    const double weight = k * k - mean;
    product += weight * overlap.distance(ix + k, iy);
    square += weight * weight;
  }
  return std::max(kLeastCurvature, product / (square * dx * dx));
}

/// B of B y^2: half the second difference across the rows, at the border that of the rows next to it.
double curvature_across(const Interpenetration& overlap, int iy) {
  const int ix = overlap.deepest_column(iy);
  const double dy = overlap.grid().dy;
  for (const int centre : {iy, iy - 1, iy + 1}) {
    const double second =
        overlap.distance(ix, centre - 1) - 2.0 * overlap.distance(ix, centre) + overlap.distance(ix, centre + 1);
    if (std::isfinite(second)) return std::max(kLeastCurvature, second / (2.0 * dy * dy));
  }
  return kLeastCurvature;
}

}  // namespace

std::vector<double> analyn_pressure(const Interpenetration& overlap, const CombinedMaterial& material,
                                    Conventions conventions) {
  const Grid2& grid = overlap.grid();
  const ElementBox& box = overlap.box();
  const bool at_element = conventions == Conventions::contact;
  double depth = 0.0;
  for (int iy = box.y0; iy < box.y1; ++iy) depth = std::max(depth, -vertex(overlap, iy, at_element).distance);

  std::vector<double> pressure(grid.size(), 0.0);
  for (int iy = box.y0; iy < box.y1; ++iy) {
    if (!(overlap.least_distance(iy) < 0.0)) continue;
    const Vertex deepest = vertex(overlap, iy, at_element);
    const double a_curvature = curvature_along(overlap, iy), b_curvature = curvature_across(overlap, iy);
    const HertzShape whole = hertz_from_curvatures(a_curvature, b_curvature, {false, depth}, material);
    // Hertz' contact ends across where the gap above its least is B b^2: there the row's share of the depth is used up.
    const double share = 1.0 - (deepest.distance + depth) / (b_curvature * whole.semi_axis_y * whole.semi_axis_y);
    if (!(share > 0.0)) continue;
    // At this share of the depth the ellipse is as round; its sides go with the root of it.
    HertzShape row = whole;
    const double root = std::sqrt(share);
    row.semi_axis_x *= root, row.semi_axis_y *= root;
    row.force *= share * root, row.approach *= share;
    for (int ix = box.x0; ix < box.x1; ++ix)
      if (std::isfinite(overlap.distance(ix, iy)))
        pressure[grid.index(ix, iy)] = hertz_pressure(row, grid.x(ix) - deepest.x, 0.0);
  }
  return pressure;
}

}  // namespace treadmark::kalker
