// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <math.h>  // sqrt without the overloads of <cmath>

#include "treadmark/backends/displacement/band_kernel.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/lanes4.hpp"

namespace treadmark::displacement {

namespace {

using lanes::load, lanes::M4, lanes::V4;

template <bool kWheel, bool kTangent>
void solve_points(const BandAxes& axes, std::size_t n, const BandPoints& p) {
  const double lx = axes.along[0], ly = axes.along[1], lz = axes.along[2], ux = axes.up[0], uy = axes.up[1],
               uz = axes.up[2];
  const double cx = axes.across[0], cy = axes.across[1], cz = axes.across[2];
  const double *t = p.t, *d = p.d, *d_u = p.d_u, *d_y = p.d_y, *sin = p.sin, *cos = p.cos, *per_r = p.per_r, *h = p.h,
               *hx = p.hx, *hy = p.hy;
  double* __restrict step = p.step;
  double* __restrict steepness = p.steepness;
  double* __restrict gx = p.gx;
  double* __restrict gy = p.gy;
  double* __restrict gz = p.gz;
  double* __restrict back_x = p.back_x;
  double* __restrict back_y = p.back_y;
#pragma GCC ivdep
  for (std::size_t i = 0; i < n; ++i) {
    const double s = kWheel ? sin[i] : 0.0, c = kWheel ? cos[i] : 1.0, one = kWheel ? per_r[i] : 1.0,
                 bend = kWheel ? per_r[i] : 0.0;
    const double ex = lx * s + ux * c, ey = ly * s + uy * c, ez = lz * s + uz * c;
    const double ax = lx * c - ux * s, ay = ly * c - uy * s, az = lz * c - uz * s;
    const double Me = ez - hx[i] * ex - hy[i] * ey, Ma = az - hx[i] * ax - hy[i] * ay;
    const double along = d_u[i] * one * Me + d[i] * bend * Ma, across = d_y[i] * Me;
    const double F = t[i] - d[i] * (kTangent ? Me : ez) - h[i];
    const double z = 1.0 - az * along - cz * across;
    gx[i] = -hx[i] - ax * along - cx * across;
    gy[i] = -hy[i] - ay * along - cy * across;
    gz[i] = z;
    step[i] = -F / z;
    steepness[i] = sqrt(1.0 + hx[i] * hx[i] + hy[i] * hy[i]);
    back_x[i] = d[i] * ex;
    back_y[i] = d[i] * ey;
  }
}

template <bool kTangent>
void solve_any(const BandAxes& axes, std::size_t n, const BandPoints& p) {
  if (axes.wheel)
    solve_points<true, kTangent>(axes, n, p);
  else
    solve_points<false, kTangent>(axes, n, p);
}

bool turn_points(const BandTurn& v, std::size_t n, const double* x, const double* t, double* __restrict u,
                 double* __restrict sin, double* __restrict cos, double* __restrict per_r) {
  double outside = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = v.oa + v.xa * x[i] + v.ta * t[i], b = v.ob + v.xb * x[i] + v.tb * t[i];
    const double one = 1.0 / sqrt(a * a + b * b);
    sin[i] = a * one, cos[i] = b * one, per_r[i] = one;
    const double ahead = a * v.sin + b * v.cos, ratio = (a * v.cos - b * v.sin) / ahead, w = ratio * ratio;
    constexpr double kSeries = 0.125 * 0.125;
    outside += (w <= kSeries ? 0.0 : 1.0) + (ahead > 0.0 ? 0.0 : 1.0);
    // series of the arc tangent; the next term is 3e-17 at the end of its range
    const double tail =
        1.0 / 3.0 -
        w * (1.0 / 5.0 - w * (1.0 / 7.0 - w * (1.0 / 9.0 - w * (1.0 / 11.0 - w * (1.0 / 13.0 - w * (1.0 / 15.0))))));
    u[i] = v.theta + (ratio - ratio * w * tail);
  }
  return outside == 0.0;
}

/// Weights of the heights at -2 .. 2, and their derivatives.
struct Weights5 {
  double w[5], d[5];
  explicit inline Weights5(double s) {
    const double q = s * s, one = q - 1.0, four = q - 4.0;
    w[0] = s * one * (s - 2.0) * (1.0 / 24.0), w[4] = s * one * (s + 2.0) * (1.0 / 24.0);
    w[1] = -s * four * (s - 1.0) * (1.0 / 6.0), w[3] = -s * four * (s + 1.0) * (1.0 / 6.0);
    w[2] = one * four * 0.25;
    d[0] = (((4.0 * s - 6.0) * s - 2.0) * s + 2.0) * (1.0 / 24.0),
    d[4] = (((4.0 * s + 6.0) * s - 2.0) * s - 2.0) * (1.0 / 24.0);
    d[1] = (((-4.0 * s + 3.0) * s + 8.0) * s - 4.0) * (1.0 / 6.0),
    d[3] = (((-4.0 * s - 3.0) * s + 8.0) * s + 4.0) * (1.0 / 6.0);
    d[2] = s * (q - 2.5);
  }
};

void interpolate_points(std::size_t n, const double* const rows[5], const double* sx, const double* sy,
                        double* __restrict h, double* __restrict h_sx, double* __restrict h_sy) {
  const double *r0 = rows[0], *r1 = rows[1], *r2 = rows[2], *r3 = rows[3], *r4 = rows[4];
  for (std::size_t i = 0; i < n; ++i) {
    const Weights5 a(sx[i]), b(sy[i]);
    const double* const at[5] = {r0 + i - 2, r1 + i - 2, r2 + i - 2, r3 + i - 2, r4 + i - 2};
    // differences from the middle keep what is small exact
    const double middle = r2[i];
    double value = 0.0, along = 0.0, across = 0.0;
#pragma GCC unroll 5
    for (int k = 0; k < 5; ++k) {
      const double z0 = at[k][0] - middle, z1 = at[k][1] - middle, z2 = at[k][2] - middle, z3 = at[k][3] - middle,
                   z4 = at[k][4] - middle;
      const double row = a.w[0] * z0 + a.w[1] * z1 + a.w[2] * z2 + a.w[3] * z3 + a.w[4] * z4;
      value += b.w[k] * row;
      across += b.d[k] * row;
      along += b.w[k] * (a.d[0] * z0 + a.d[1] * z1 + a.d[2] * z2 + a.d[3] * z3 + a.d[4] * z4);
    }
    h[i] = middle + value;
    h_sx[i] = along;
    h_sy[i] = across;
  }
}

void fifth_differences(std::size_t n, const double* const six[6], double* __restrict difference) {
  const double *a = six[0], *b = six[1], *c = six[2], *d = six[3], *e = six[4], *f = six[5];
  for (std::size_t i = 0; i < n; ++i) {
    const double size = fabs((f[i] - a[i]) - 5.0 * (e[i] - b[i]) + 10.0 * (d[i] - c[i]));
    difference[i] = size <= 1e300 ? size : 1e300;
  }
}

inline double greater(double a, double b) { return a > b ? a : b; }

void missing_terms(std::size_t n, const double* const along[5], const double* const across[2], const double* sx,
                   const double* sy, double* __restrict value, double* __restrict by_sx, double* __restrict by_sy) {
  const double *a0 = along[0], *a1 = along[1], *a2 = along[2], *a3 = along[3], *a4 = along[4], *b = across[0],
               *c = across[1];
#pragma GCC ivdep
  for (std::size_t i = 0; i < n; ++i) {
    const double x = greater(greater(greater(a0[i], a1[i]), greater(a2[i], a3[i])), a4[i]);
    const double y0 = greater(b[i], c[i]), y1 = greater(b[i + 1], c[i + 1]), y2 = greater(b[i + 2], c[i + 2]),
                 y3 = greater(b[i + 3], c[i + 3]), y4 = greater(b[i + 4], c[i + 4]);
    const double y = greater(greater(greater(y0, y1), greater(y2, y3)), y4);
    const double s = sx[i], t = sy[i], ss = s * s, tt = t * t;
    value[i] = (x * fabs(s * (ss - 1.0) * (ss - 4.0)) + y * fabs(t * (tt - 1.0) * (tt - 4.0))) * (1.0 / 120.0);
    by_sx[i] = x * fabs((5.0 * ss - 15.0) * ss + 4.0) * (1.0 / 120.0);
    by_sy[i] = y * fabs((5.0 * tt - 15.0) * tt + 4.0) * (1.0 / 120.0);
  }
}

inline std::uint8_t bend_of(const double* z, double before, double behind, const BendLimits& limits) {
  constexpr double kRounding = 1e-8;  // [m]
  const double x1 = z[0] - z[-1], x2 = z[1] - z[0], y1 = z[0] - before, y2 = behind - z[0];
  const double xx = fabs(x2 - x1), yy = fabs(y2 - y1), ax = fabs(x1), bx = fabs(x2), ay = fabs(y1), by = fabs(y2);
  // the slope without the jump, if there is one
  const double sx = (bx < ax ? bx : ax) * limits.per_dx, sy = (by < ay ? by : ay) * limits.per_dy;
  // A second derivative is the curvature times (1 + slope^2)^1.5; a slope that is not known is none.
  const double square = (sx == sx ? sx * sx : 0.0) + (sy == sy ? sy * sy : 0.0),
               steep = (1.0 + square) * sqrt(1.0 + square);
  return static_cast<std::uint8_t>((xx <= limits.most_x * steep + kRounding ? kAlongX : 0) |
                                   (yy <= limits.most_y * steep + kRounding ? kAlongY : 0));
}

void bends_of(std::size_t n, const double* z, const double* before, const double* behind, const BendLimits& limits,
              std::uint8_t* bends) {
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    // What is smooth without regard to slopes, most of it.
    const V4 twice = 2.0 * load(z + i), xx = load(z + i + 1) + load(z + i - 1) - twice,
             yy = load(before + i) + load(behind + i) - twice;
    const M4 bad = ~((xx <= limits.most_x) & (-xx <= limits.most_x) & (yy <= limits.most_y) & (-yy <= limits.most_y));
    if (((bad[0] | bad[1]) | (bad[2] | bad[3])) == 0) {
      for (int k = 0; k < 4; ++k) bends[i + static_cast<std::size_t>(k)] = kAlongX | kAlongY;
      continue;
    }
    for (std::size_t k = i; k < i + 4; ++k) bends[k] = bend_of(z + k, before[k], behind[k], limits);
  }
  for (; i < n; ++i) bends[i] = bend_of(z + i, before[i], behind[i], limits);
}

void smooth_of(std::size_t n, const std::uint8_t* before, const std::uint8_t* row, const std::uint8_t* behind,
               std::uint8_t* __restrict smooth) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint8_t *a = before + i, *b = row + i, *c = behind + i;
    const int along_x = b[-1] & b[0] & b[1], along_y = a[0] & b[0] & c[0];
    const int all = along_x & along_y & a[-1] & a[1] & c[-1] & c[1];
    smooth[i] = static_cast<std::uint8_t>((along_x & kAlongX) | (along_y & kAlongY) | ((all & (all >> 1) & 1) << 2));
  }
}

}  // namespace

TREADMARK_KERNEL(BandKernel, &solve_any<false>, &solve_any<true>, &turn_points, &interpolate_points, &missing_terms,
                 &fifth_differences, &bends_of, &smooth_of);

}  // namespace treadmark::displacement
