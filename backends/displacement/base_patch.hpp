// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/displacement/band_kernel.hpp"
#include "treadmark/backends/displacement/base_heights.hpp"
#include "treadmark/core/kernel.hpp"

namespace treadmark::displacement {

/// Heights of the base between the points of a grid, by polynomials of fourth order, and where they are as good as the
/// base itself: the error of such a polynomial is its next term, a fifth difference, which is taken as the greatest of
/// all nearby along both axes. Joints of a profile, folds and misses show in it.
class BasePatch {
 public:
  /// slopes: whether they count too.
  BasePatch(const BaseHeights& base, const Grid2& grid, bool slopes)
      : base_(base), g_(grid), slopes_(slopes), kernel_(fastest_kernel<BandKernel>()) {}

  /// Looks at columns [begin, end), at most 64, and rows [first, last). False: the grid is too small.
  bool look(int begin, int end, int first, int last);

  /// Heights and slopes at (sx[k], sy[k]) steps from the points begin + k of a row, and whether they are good.
  void row(int iy, const double* sx, const double* sy, double* h, double* hx, double* hy, bool* good);

  static constexpr double kFarthest = 1.0;  ///< steps

 private:
  double* along(int iy) { return along_.data() + static_cast<std::size_t>(iy - first_ + 2) * width_; }
  double* across(int start) { return across_.data() + static_cast<std::size_t>(start - first_ + 3) * width_; }

  const BaseHeights& base_;
  const Grid2& g_;
  bool slopes_;
  const BandKernel& kernel_;
  int begin_ = 0, end_ = 0, first_ = 0, last_ = 0;
  std::size_t width_ = 0;
  std::vector<double> along_;  ///< greatest fifth difference along x, columns begin to end, rows first - 2 to last + 1
  std::vector<double>
      across_;  ///< fifth differences along y, columns begin - 2 to end + 1, by their first row, first - 3 to last - 1
};

}  // namespace treadmark::displacement
