// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>

namespace treadmark::offset {

/// A sheet of coefficients as its kernels see it: raw numbers only, see core/kernel.hpp.
struct SheetView {
  double u0, per_u, y0, per_y;  ///< voxels s = (u - u0) per_u, t = (y - y0) per_y
  double branch, period;        ///< s lies in [branch, branch + period); period 0: anywhere
  int turn;                     ///< rows are counted modulo this, if it is not 0
  const float* const* blocks;   ///< 512 values each, or nullptr; [(bi - bi_first) * bj_count + bj - bj_first]
  int bi_first, bi_count, bj_first, bj_count;
  const float* (*find)(const void* owner, std::int32_t bi,
                       std::int32_t bj);  ///< where there is no table: blocks == nullptr
  const void* owner;
};

/// Values and, unless null, derivatives by u and y of a B-spline at n points.
using SheetPoints = void (*)(const SheetView& sheet, std::size_t n, const double* u, const double* y, double* value,
                             double* d_u, double* d_y);

struct SheetKernel {
  SheetPoints of_degree[4];  ///< 1, 2 or 3

  static const SheetKernel generic;
  static const SheetKernel* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::offset
