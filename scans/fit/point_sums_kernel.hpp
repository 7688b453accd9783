// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/kernel.hpp"
#include "treadmark/core/lanes4.hpp"
#include "treadmark/scans/fit/point_sums.hpp"

namespace treadmark::scans {
namespace {

using namespace lanes;

TREADMARK_LANES double clamped(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

/// The four functions over an interval (de Boor 1978), t from 0 to 1.
TREADMARK_LANES V4 basis(double t) {
  constexpr double s = 1.0 / 6.0;
  const V4 c0{s, 4.0 * s, s, 0.0}, c1{-0.5, 0.0, 0.5, 0.0}, c2{0.5, -1.0, 0.5, 0.0}, c3{-s, 0.5, -0.5, s};
  return c0 + t * (c1 + t * (c2 + t * c3));
}

template <class Visit>
TREADMARK_LANES void visit(const IntervalPoints& p, const Visit& each) {
  for (std::size_t row = 0; row < p.rows; ++row) {
    const std::uint32_t* cell = p.begin + row * p.across;
    for (std::size_t i = cell[0]; i < cell[p.cells]; ++i)
      each(i, basis(clamped((p.a[i] - p.a0) * p.per_a, 0.0, 1.0)), basis(clamped((p.s[i] - p.s0) * p.per_s, 0.0, 1.0)));
  }
}

TREADMARK_LANES V4Anywhere* fours(double* numbers) { return reinterpret_cast<V4Anywhere*>(numbers); }

TREADMARK_LANES void add_to(double* sums, const V4 (&more)[4]) {
  for (int k = 0; k < 4; ++k) fours(sums)[k] += more[k];
}

static void sums_of_functions(const IntervalPoints& points, const float* residual, const float* weight, float clip,
                              double* wbr, double* wbb, double* b) {
  V4 sum_wbr[4] = {}, sum_wbb[4] = {}, sum_b[4] = {};
  visit(points, [&](std::size_t i, V4 ba, V4 bs) {
    if (!(weight[i] > 0.0f)) return;
    const double w = weight[i], most = clip / __builtin_sqrtf(weight[i]);
    const double wr = w * clamped(residual[i], -most, most);
    for (int k = 0; k < 4; ++k) {
      const V4 product = ba[k] * bs;
      sum_wbr[k] += wr * product;
      sum_wbb[k] += w * product * product;
      sum_b[k] += product;
    }
  });
  add_to(wbr, sum_wbr);
  add_to(wbb, sum_wbb);
  add_to(b, sum_b);
}

static void sums_of_products(const IntervalPoints& points, const float* residual, const float* weight, double* products,
                             double* wbr) {
  V4 sum_wbr[4] = {};
  V4Anywhere* const sums = fours(products);
  visit(points, [&](std::size_t i, V4 ba, V4 bs) {
    if (!(weight[i] > 0.0f)) return;
    const double w = weight[i], r = residual[i];
    V4 b[4];
    for (int k = 0; k < 4; ++k) b[k] = ba[k] * bs;
    for (int k = 0; k < 4; ++k) {
      const V4 wb = w * b[k];
      sum_wbr[k] += r * wb;
      for (int m = 0; m < 4; ++m)
        for (int n = 0; n <= k; ++n) sums[4 * (4 * k + m) + n] += wb[m] * b[n];
    }
  });
  add_to(wbr, sum_wbr);
}

static void subtract_functions(const IntervalPoints& points, const double* c, float* residual) {
  V4 rows[4];
  __builtin_memcpy(rows, c, sizeof rows);
  visit(points, [&](std::size_t i, V4 ba, V4 bs) {
    const V4 product = bs * (ba[0] * rows[0] + ba[1] * rows[1] + ba[2] * rows[2] + ba[3] * rows[3]);
    residual[i] -= static_cast<float>(lanes::sum(product));
  });
}

}  // namespace

TREADMARK_KERNEL(PointSums, sums_of_functions, sums_of_products, subtract_functions);

}  // namespace treadmark::scans
