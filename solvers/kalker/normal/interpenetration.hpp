// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/solvers/kalker/normal/element_box.hpp"

namespace treadmark::kalker {

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

}  // namespace treadmark::kalker
