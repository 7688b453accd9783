// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::analytic {

/// Points of a row of a plane over one arc, on raw numbers only, see core/kernel.hpp. Point i has x = x_first + i dx,
/// meets the arc (see ArcGraph) at w = w_row + w_x x and has the height (h(w) - a_row - a_x x) per_m.
struct ArcRow {
  double x0, h0, s0, c0, k;
  double w_row, w_x, a_row, a_x, per_m, x_first, dx;
};

struct ArcRowKernel {
  /// Heights of points first to last - 1 and, unless null, the slopes of the arc there.
  void (*heights)(const ArcRow& row, int first, int last, double* z, double* slope);

  static const ArcRowKernel generic;
  static const ArcRowKernel* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::analytic
