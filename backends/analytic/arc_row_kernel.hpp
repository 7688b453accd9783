// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/analytic/arc_row.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/lanes4.hpp"

namespace treadmark::analytic {
namespace {

using namespace lanes;

void arc_row(const ArcRow& r, int first, int last, double* z, double* slope) {
  const V4 sign = all(r.c0 < 0.0 ? -1.0 : 1.0);
  for (int i = first; i < last; i += 4) {
    const V4 x = r.x_first + V4{double(i), double(i + 1), double(i + 2), double(i + 3)} * r.dx;
    const V4 w = r.w_row + r.w_x * x, s = r.s0 + r.k * (w - r.x0), square = (1.0 - s) * (1.0 + s);
    const V4 c = sign * root(square > 0.0 ? square : all(0.0));
    const V4 h = r.h0 + (w - r.x0) * (s + r.s0) / (c + r.c0), height = (h - (r.a_row + r.a_x * x)) * r.per_m;
    const int count = last - i < 4 ? last - i : 4;
    if (count == 4)
      store(z + i, height);
    else
      for (int lane = 0; lane < count; ++lane) z[i + lane] = height[lane];
    if (slope == nullptr) continue;
    const V4 tangent = s / c;
    for (int lane = 0; lane < count; ++lane) slope[i + lane] = tangent[lane];
  }
}

}  // namespace

TREADMARK_KERNEL(ArcRowKernel, arc_row);

}  // namespace treadmark::analytic
