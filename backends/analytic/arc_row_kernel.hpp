// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Included by arc_row_generic.cpp and arc_row_avx2.cpp only.
#pragma once

#include "treadmark/backends/analytic/arc_row.hpp"
#include "treadmark/backends/analytic/lanes4.hpp"

namespace treadmark::analytic {
namespace {

void arc_row(const ArcRow& r, int first, int last, double* z, double* slope) {
  const Lanes sign = all(r.c0 < 0.0 ? -1.0 : 1.0);
  for (int i = first; i < last; i += 4) {
    const Lanes x = r.x_first + Lanes{double(i), double(i + 1), double(i + 2), double(i + 3)} * r.dx;
    const Lanes w = r.w_row + r.w_x * x, s = r.s0 + r.k * (w - r.x0), square = (1.0 - s) * (1.0 + s);
    const Lanes c = sign * root(square > 0.0 ? square : all(0.0));
    const Lanes h = r.h0 + (w - r.x0) * (s + r.s0) / (c + r.c0), height = (h - (r.a_row + r.a_x * x)) * r.per_m;
    const int count = last - i < 4 ? last - i : 4;
    if (count == 4)
      store(height, z + i);
    else
      for (int lane = 0; lane < count; ++lane) z[i + lane] = height[lane];
    if (slope == nullptr) continue;
    const Lanes tangent = s / c;
    for (int lane = 0; lane < count; ++lane) slope[i + lane] = tangent[lane];
  }
}

}  // namespace
}  // namespace treadmark::analytic
