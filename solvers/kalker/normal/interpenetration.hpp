// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <climits>
#include <cmath>
#include <span>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/solvers/kalker/normal/normal_operator.hpp"

namespace treadmark::kalker {

/// A rectangle of elements of a grid: columns x0 .. x1-1, rows y0 .. y1-1.
struct ElementBox {
  int x0 = INT_MAX, y0 = INT_MAX, x1 = INT_MIN, y1 = INT_MIN;

  bool empty() const { return x1 <= x0 || y1 <= y0; }
  int nx() const { return x1 - x0; }
  int ny() const { return y1 - y0; }
  std::size_t size() const { return static_cast<std::size_t>(nx()) * static_cast<std::size_t>(ny()); }
  bool contains(const ElementBox& other) const {
    return other.empty() || (x0 <= other.x0 && y0 <= other.y0 && other.x1 <= x1 && other.y1 <= y1);
  }
  void include(int ix, int iy) {
    x0 = std::min(x0, ix);
    y0 = std::min(y0, iy);
    x1 = std::max(x1, ix + 1);
    y1 = std::max(y1, iy + 1);
  }
  void include(const ElementBox& other) {
    if (other.empty()) return;
    include(other.x0, other.y0);
    include(other.x1 - 1, other.y1 - 1);
  }
  friend bool operator==(const ElementBox&, const ElementBox&) = default;
};

/// The overlap of two bodies that are moved together by an approach without deforming: what the approximate methods of
/// virtual penetration start from. Refers to the gap that it was made of.
class Interpenetration {
 public:
  /// gap: undeformed distance h [m], size grid.size(), NaN = never in contact; at least 3 x 3 elements.
  Interpenetration(const Grid2& grid, std::span<const double> gap, double approach);

  /// Elements that overlap; empty = no contact.
  const ElementBox& box() const { return box_; }
  const Grid2& grid() const { return grid_; }
  /// h - approach [m], negative where the bodies overlap; infinite outside the grid and where contact is excluded.
  double distance(int ix, int iy) const {
    if (ix < 0 || iy < 0 || ix >= grid_.nx || iy >= grid_.ny) return HUGE_VAL;
    const double h = gap_[grid_.index(ix, iy)];
    return std::isnan(h) ? HUGE_VAL : h - approach_;
  }
  /// Column of the least distance within a row; the first of equal ones.
  int deepest_column(int iy) const { return deepest_column_[static_cast<std::size_t>(iy)]; }
  double least_distance(int iy) const { return distance(deepest_column(iy), iy); }
  /// Element of the least distance of all, which is -depth(). Only with contact.
  int deepest_row() const { return deepest_row_; }
  double depth() const { return -least_distance(deepest_row_); }

 private:
  Grid2 grid_;
  std::span<const double> gap_;
  double approach_;
  ElementBox box_;
  std::vector<int> deepest_column_;
  int deepest_row_ = 0;
};

/// Curvatures A, B below this [1/m] are taken for this: the methods need a minimum in both directions.
inline constexpr double kLeastCurvature = 0.1;

/// From inside to outside, where a level lies between the distances there, as a share of the way; half the way without
/// a neighbour.
inline double share_to_level(double inside, double outside, double level) {
  return std::isfinite(outside) ? (level - inside) / (outside - inside) : 0.5;
}

/// What KPEC finds Hertz' ellipse from.
struct Outline {
  double curvature_x = kLeastCurvature;   ///< A of A x^2 [1/m]
  double middle = 0.0, half_width = 0.0;  ///< across, of where the bodies overlap beyond the level [m]
  double deepest = 0.0;                   ///< how far from the middle they overlap most [m]
};

/// Normal displacement of the problem's bodies, sheet included, [m] inside a box of elements by the pressures [Pa]
/// inside that box; elements outside the box are left alone. Fields have the grid's size.
void half_space_displacement(NormalOperatorCache& operators, const ContactProblem& problem, const ElementBox& box,
                             std::span<const double> pressure, std::span<double> displacement);

/// The same of single elements outside a box, by the pressures inside it, summed element by element, which costs less
/// than coefficients for a box around all of them. elements: places in the grid. Of the problem whose operators were
/// asked for last. False, and nothing is done: they are many, or coefficients are not those of half-spaces.
bool sum_half_space_displacement(NormalOperatorCache& operators, const ContactProblem& problem, const ElementBox& box,
                                 std::span<const double> pressure, std::span<const std::size_t> elements,
                                 std::span<double> displacement);

}  // namespace treadmark::kalker
