// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>

namespace treadmark::scans {

/// The points over one interval of a spline level, with what is known of them: point i lies at a[i], s[i].
struct IntervalPoints {
  const float *a, *s;
  const std::uint32_t* begin;       ///< of the interval's first cell (BandPoints::begin)
  std::size_t rows, cells, across;  ///< of cells in the interval; its cells along s; those of the whole band
  double a0, s0;                    ///< where the interval begins [m]
  double per_a, per_s;              ///< 1 / distance of knots [1/m]
};

/// Arithmetic over the points of an interval and its 4 x 4 functions B, function 4 i_a + i_s. What weighs nothing does
/// not count.
struct PointSums {
  /// Adds sums of w B r, w B^2 and B, where r is cut off at so many standard deviations.
  void (*functions)(const IntervalPoints& points, const float* residual, const float* weight, float clip, double* wbr,
                    double* wbb, double* b);
  /// Adds sums of w B_m B_n to products[16 m + n], of all n up to those with the i_a of m, and of w B_m r.
  void (*products)(const IntervalPoints& points, const float* residual, const float* weight, double* products,
                   double* wbr);
  /// Takes the sum of c B off the residuals, also of points that weigh nothing.
  void (*subtract)(const IntervalPoints& points, const double* c, float* residual);

  static const PointSums generic;
  static const PointSums* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::scans
