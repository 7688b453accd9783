// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/mesh/fit.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/lanes4.hpp"

namespace treadmark::mesh {
namespace {

using namespace lanes;
static_assert(FitBlock::kLanesOfFit == kLanes);

/// Turns the axes to the longest and shortest spread of the points (x, y), and tells their spreads.
TREADMARK_LANES void turn_to_spread(FitBlock& block, V4* x, V4* y, V4& spread_x, V4& spread_y) {
  const V4 one = all(1.0), zero = all(0.0), half = all(0.5), count = load(block.count);
  V4 xx = zero, xy = zero, yy = zero;
  for (int i = 0; i < block.rows; ++i) {
    xx = fma(x[i], x[i], xx);
    xy = fma(x[i], y[i], xy);
    yy = fma(y[i], y[i], yy);
  }
  // cosine and sine of half the angle of (xx - yy, 2 xy)
  const V4 apart = xx - yy, length = root(fma(apart, apart, all(4.0) * xy * xy)), twice = apart / length;
  const M4 turned = length > zero;
  const V4 cosine = select(turned, root(most(half + half * twice, zero)), one);
  V4 sine = select(turned, root(most(half - half * twice, zero)), zero);
  sine = select(xy < zero, -sine, sine);
  for (int k = 0; k < 3; ++k) {
    const V4 u = load(block.axis_u[k]), v = load(block.axis_v[k]);
    store(block.axis_u[k], fma(cosine, u, sine * v));
    store(block.axis_v[k], fma(cosine, v, -(sine * u)));
  }
  xx = yy = zero;
  for (int i = 0; i < block.rows; ++i) {
    const V4 along = fma(cosine, x[i], sine * y[i]), across = fma(cosine, y[i], -(sine * x[i]));
    x[i] = along;
    y[i] = across;
    xx = fma(along, along, xx);
    yy = fma(across, across, yy);
  }
  const V4 least = all(1e-12) * root(most(xx, yy) / count);
  spread_x = most(least, root(xx / count));
  spread_y = most(least, root(yy / count));
}

static void fit_cubics(FitBlock& block) {
  constexpr int kTerms = FitBlock::kTerms, kMostRows = FitBlock::kMostRows;
  const int rows = block.rows;
  const V4 one = all(1.0), zero = all(0.0);
  V4 x[kMostRows], y[kMostRows], column[kTerms + 1][kMostRows];  // the last one: heights
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    store(block.axis_v[k],
          load(block.normal[i]) * load(block.axis_u[j]) - load(block.normal[j]) * load(block.axis_u[i]));
  }
  const auto along = [&](int row, const double(&axis)[3][kLanes]) {
    V4 sum = zero;
    for (int k = 0; k < 3; ++k) sum = fma(load(block.from[row][k]), load(axis[k]), sum);
    return sum;
  };
  for (int i = 0; i < rows; ++i) {
    x[i] = along(i, block.axis_u);
    y[i] = along(i, block.axis_v);
  }
  V4 spread_x, spread_y, length[kTerms];
  turn_to_spread(block, x, y, spread_x, spread_y);
  const V4 per_x = one / spread_x, per_y = one / spread_y;
  for (int k = 0; k < kTerms; ++k) length[k] = zero;
  for (int i = 0; i < rows; ++i) {
    const V4 u = x[i] * per_x, v = y[i] * per_y, uu = u * u, uv = u * v, vv = v * v;
    const V4 weight = one / (all(0.25) + uu + vv);
    const V4 terms[kTerms] = {u, v, uu, uv, vv, uu * u, uu * v, u * vv, vv * v};
    for (int k = 0; k < kTerms; ++k) {
      const V4 a = column[k][i] = weight * terms[k];
      length[k] = fma(a, a, length[k]);
    }
    column[kTerms][i] = weight * along(i, block.normal);
  }
  // modified Gram-Schmidt of the columns at unit length, the heights carried along (Bjorck 1967)
  V4 r[kTerms][kTerms + 1], per[kTerms];  // per: one over the diagonal of r
  for (int k = 0; k < kTerms; ++k) {
    length[k] = one / root(length[k]);
    for (int i = 0; i < rows; ++i) column[k][i] *= length[k];
  }
  for (int k = 0; k < kTerms; ++k) {
    V4 square = zero;
    for (int i = 0; i < rows; ++i) square = fma(column[k][i], column[k][i], square);
    const V4 diagonal = root(square);
    per[k] = one / diagonal;
    for (int i = 0; i < rows; ++i) column[k][i] *= per[k];
    for (int j = k + 1; j <= kTerms; ++j) {
      V4 sum = zero;
      for (int i = 0; i < rows; ++i) sum = fma(column[k][i], column[j][i], sum);
      for (int i = 0; i < rows; ++i) column[j][i] = fma(-sum, column[k][i], column[j][i]);
      r[k][j] = sum;
    }
  }
  V4 powers_u[4] = {one, per_x, per_x * per_x, per_x * per_x * per_x};
  V4 powers_v[4] = {one, per_y, per_y * per_y, per_y * per_y * per_y};
  constexpr int kPowerU[kTerms] = {1, 0, 2, 1, 0, 3, 2, 1, 0}, kPowerV[kTerms] = {0, 1, 0, 1, 2, 0, 1, 2, 3};
  V4 c[kTerms];
  for (int k = kTerms - 1; k >= 0; --k) {
    V4 sum = r[k][kTerms];
    for (int j = k + 1; j < kTerms; ++j) sum = fma(-r[k][j], c[j], sum);
    c[k] = sum * per[k];
  }
  for (int k = 0; k < kTerms; ++k)
    store(block.cubic[k], c[k] * length[k] * powers_u[kPowerU[k]] * powers_v[kPowerV[k]]);
  // the least singular value is at least one over the Frobenius norm of the inverse
  V4 norm = zero;
  for (int column_of = 0; column_of < kTerms; ++column_of) {
    V4 inverse[kTerms];
    inverse[column_of] = per[column_of];
    norm = fma(per[column_of], per[column_of], norm);
    for (int k = column_of - 1; k >= 0; --k) {
      V4 sum = zero;
      for (int j = k + 1; j <= column_of; ++j) sum = fma(r[k][j], inverse[j], sum);
      inverse[k] = -(sum * per[k]);
      norm = fma(inverse[k], inverse[k], norm);
    }
  }
  store(block.least_singular_value, one / root(norm));
}

}  // namespace

TREADMARK_KERNEL(FitKernel, fit_cubics);

}  // namespace treadmark::mesh
