// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/mesh/patch.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/lanes4.hpp"

namespace treadmark::mesh {
namespace {

using namespace lanes;

constexpr double kGrazingLine = 0.01, kLeastCosine = 0.1;

TREADMARK_LANES double dot3(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// What does not depend on the plane but on the direction of its lines.
TREADMARK_LANES void prepare_fits(const double* direction, const PatchSource& source, double* patch) {
  double edges[3][3];  // from corner k to the next one
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) edges[k][j] = source.corners[(k + 1) % 3][j] - source.corners[k][j];
  double towards = 0.0, above[kLanes], below[kLanes];
  for (int k = 0; k < 3; ++k) {
    const double *next = edges[k], *facing = edges[(k + 1) % 3], *back = edges[(k + 2) % 3];
    // the foot of corner k on the edge from the next corner to the other one
    above[k] = -dot3(facing, next);
    below[k] = dot3(facing, facing);
    const KeptFit& fit = *source.fits[k];
    const double n[3] = {fit.normal[0], fit.normal[1], fit.normal[2]};
    const double a[3] = {fit.axis_u[0], fit.axis_u[1], fit.axis_u[2]};
    const double axis_v[3] = {n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2], n[0] * a[1] - n[1] * a[0]};
    double* f = patch + kFits + k * kFitEntries;
    V4 to_next = all(0.0), to_other = to_next, along = to_next;
    for (int j = 0; j < 3; ++j) {
      const V4 axes = {a[j], axis_v[j], n[j], n[j]};  // the last counts for nothing
      to_next = fma(axes, all(next[j]), to_next);
      to_other = fma(axes, all(-back[j]), to_other);
      along = fma(axes, all(direction[j]), along);
    }
    store(f + kNextU, to_next);  // each writes one entry of the one behind it
    store(f + kOtherU, to_other);
    store(f + kAlongU, along);
    const double du = along[0], dv = along[1], *c = f + kCubic;
    towards += along[2];
    for (int i = 0; i < 9; ++i) f[kCubic + i] = fit.cubic[i];
    const double uu = du * du, uv = du * dv, vv = dv * dv;
    f[kBend] = c[2] * uu + c[3] * uv + c[4] * vv;
    f[kBendU] = 3.0 * c[5] * uu + 2.0 * c[6] * uv + c[7] * vv;
    f[kBendV] = c[6] * uu + 2.0 * c[7] * uv + 3.0 * c[8] * vv;
    f[kTwist] = uu * (c[5] * du + c[6] * dv) + vv * (c[7] * du + c[8] * dv);
  }
  const double cosine = (towards < 0.0 ? -towards : towards) / 3.0;
  above[3] = source.bulge;
  below[3] = cosine > kLeastCosine ? cosine : kLeastCosine;
  static_assert(kReach == kFeet + 3);
  store(patch + kFeet, load(above) / load(below));
}

static void prepare_patch(const PlaneLines& lines, const PatchSource& source, double* patch) {
  const double* q = source.places;
  for (int i = 0; i < 9; ++i) patch[kCornerPlaces + i] = q[i];
  const double area = (q[3] - q[0]) * (q[7] - q[1]) - (q[4] - q[1]) * (q[6] - q[0]);
  patch[kInverseArea] = 1.0 / area;
  const double direction[3] = {lines.rotation[0][2], lines.rotation[1][2], lines.rotation[2][2]};
  prepare_fits(direction, source, patch);
}

/// Entries of one patch for all lanes.
struct OnePatch {
  const double* patch;
  [[gnu::always_inline]] inline V4 operator()(int i) const { return all(patch[i]); }
};

/// Entries of four patches, each in its lane.
struct FourPatches {
  const double* block;
  [[gnu::always_inline]] inline V4 operator()(int i) const { return load(block + kLanes * i); }
};

/// One cubic and its slopes at (u, v).
template <class Patch>
struct Cubic {
  V4 height, slope_u, slope_v;
  [[gnu::always_inline]] inline Cubic(const Patch& patch, int at, V4 u, V4 v) {
    const auto c = [&](int i) { return patch(at + kCubic + i); };
    const V4 two = all(2.0);
    const V4 a = fma(c(6), v, fma(c(5), u, c(2))), b = fma(c(7), u, fma(c(8), v, c(4)));
    height = fma(u, fma(u, a, fma(c(3), v, c(0))), v * fma(v, b, c(1)));
    slope_u = fma(u, fma(c(5), u, two * a), fma(v, fma(c(7), v, c(3)), c(0)));
    slope_v = fma(v, fma(c(8), v, two * b), fma(u, fma(c(6), u, c(3)), c(1)));
  }
};

/// The blend of SmoothPatches at four places of the facet: its weights, the places in the frames of the fits, and how
/// far along the line the surface lies.
struct BlendLanes {
  V4 foot[3], place[3], step[3], beta[3], w[3], per_sum;
  V4 u[3], v[3], n[3], t;
  M4 fine;  ///< t is one
};

/// e: what is opposite to the corners, total: their sum, b = e / total.
template <class Patch>
[[gnu::always_inline]] static inline void solve_lanes(const Patch& patch, double side, const V4 (&e)[3],
                                                      const V4& total, const V4 (&b)[3], BlendLanes& s) {
  const V4 one = all(1.0), zero = all(0.0), two = all(2.0), three = all(3.0);
  // weights: see blend_weights; their ratios need no barycentric coordinates, so that both divisions run at a time
  V4 square[3];
  for (int k = 0; k < 3; ++k) {
    const V4 product = e[(k + 1) % 3] * e[(k + 2) % 3];
    square[k] = product * product;
    s.w[k] = zero;
  }
  const V4 sum = square[0] + square[1] + square[2], total2 = total * total;
  s.per_sum = one / sum;
  s.fine = sum > all(1e-200) * (total2 * total2);
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    s.foot[k] = patch(kFeet + k);
    s.place[k] = least(most(fma(b[k], s.foot[k], b[j]), zero), one);
    s.step[k] = s.place[k] * s.place[k] * fma(all(-2.0), s.place[k], three);
    s.beta[k] = square[k] * s.per_sum;
    s.w[j] = fma(s.beta[k], s.step[k], s.w[j]);
    s.w[i] = s.w[i] + fma(-s.beta[k], s.step[k], s.beta[k]);
  }

  // the blend along the line is a cubic in t, because the weights stay
  V4 g0 = zero, g1 = zero, g2 = zero, g3 = zero;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3, at = kFits + k * kFitEntries;
    s.u[k] = fma(b[i], patch(at + kNextU), b[j] * patch(at + kOtherU));
    s.v[k] = fma(b[i], patch(at + kNextV), b[j] * patch(at + kOtherV));
    s.n[k] = fma(b[i], patch(at + kNextW), b[j] * patch(at + kOtherW));
    const Cubic<Patch> p(patch, at, s.u[k], s.v[k]);
    const V4 along = fma(-p.slope_u, patch(at + kAlongU), fma(-p.slope_v, patch(at + kAlongV), patch(at + kAlongW)));
    const V4 bend = fma(patch(at + kBendU), s.u[k], fma(patch(at + kBendV), s.v[k], patch(at + kBend)));
    g0 = fma(s.w[k], s.n[k] - p.height, g0);
    g1 = fma(s.w[k], along, g1);
    g2 = fma(-s.w[k], bend, g2);
    g3 = fma(-s.w[k], patch(at + kTwist), g3);
  }
  const V4 out = all(side), grazing = all(kGrazingLine), g22 = g2 * two, g33 = g3 * three;
  // Newton's method; the slope changes little, so that its inverse is corrected instead of divided again
  const V4 per_slope = one / g1;
  s.t = -g0 * per_slope;
  s.fine &= out * g1 > grazing;
  M4 open = s.fine;
  constexpr int kMost = 12;
  for (int i = 0; i < kMost; ++i) {
    const V4 value = fma(s.t, fma(s.t, fma(s.t, g3, g2), g1), g0), slope = fma(s.t, fma(s.t, g33, g22), g1);
    s.fine &= ~open | (out * slope > grazing);
    open &= s.fine;
    const V4 inverse = per_slope * fma(-slope, per_slope, two), change = value * inverse;
    s.t = select(open, s.t - change, s.t);
    open &= magnitude(change) > fma(all(1e-9), magnitude(s.t), all(1e-16));
    if (bits(open) == 0) break;
  }
  s.fine &= ~open & (out * fma(s.t, fma(s.t, g33, g22), g1) > grazing) & (magnitude(s.t) <= patch(kReach));
}

/// Heights on four lines, and slopes if wanted.
template <bool kSlopes, class Patch>
[[gnu::always_inline]] static inline void evaluate_lanes(const Patch& patch, double side, const V4& x, const V4& y,
                                                         V4& z, V4& dzdx, V4& dzdy) {
  const V4 one = all(1.0), zero = all(0.0), two = all(2.0);
  V4 qx[3], qy[3], qz[3], e[3], b[3];
  for (int k = 0; k < 3; ++k) {
    qx[k] = patch(kCornerPlaces + 3 * k);
    qy[k] = patch(kCornerPlaces + 3 * k + 1);
    qz[k] = patch(kCornerPlaces + 3 * k + 2);
  }
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    e[k] = (qx[i] - x) * (qy[j] - y) - (qy[i] - y) * (qx[j] - x);
  }
  const V4 total = e[0] + e[1] + e[2], per = one / total;
  for (int k = 0; k < 3; ++k) b[k] = e[k] * per;
  const V4 flat = b[0] * qz[0] + b[1] * qz[1] + b[2] * qz[2];
  BlendLanes blend;
  solve_lanes(patch, side, e, total, b, blend);
  const V4 t = blend.t, per_sum = blend.per_sum;
  const V4(&u)[3] = blend.u, (&v)[3] = blend.v, (&n)[3] = blend.n, (&w)[3] = blend.w;
  const V4(&foot)[3] = blend.foot, (&place)[3] = blend.place, (&step)[3] = blend.step, (&beta)[3] = blend.beta;
  const V4 missing = all(__builtin_nan(""));
  z = select(blend.fine, flat + t, missing);
  if (!kSlopes) return;

  // derivatives of the blend by the barycentric coordinates, taken for independent; along the lines it is 0 at the
  // solution
  V4 f[3], h[3], by[3], gt = zero;
  for (int k = 0; k < 3; ++k) by[k] = zero;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3, at = kFits + k * kFitEntries;
    const V4 us = fma(t, patch(at + kAlongU), u[k]), vs = fma(t, patch(at + kAlongV), v[k]);
    const Cubic<Patch> p(patch, at, us, vs);
    f[k] = fma(t, patch(at + kAlongW), n[k]) - p.height;
    gt = fma(w[k], fma(-p.slope_u, patch(at + kAlongU), fma(-p.slope_v, patch(at + kAlongV), patch(at + kAlongW))), gt);
    by[i] =
        fma(w[k], fma(-p.slope_u, patch(at + kNextU), fma(-p.slope_v, patch(at + kNextV), patch(at + kNextW))), by[i]);
    by[j] = fma(w[k], fma(-p.slope_u, patch(at + kOtherU), fma(-p.slope_v, patch(at + kOtherV), patch(at + kOtherW))),
                by[j]);
  }
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const V4 apart = f[j] - f[i];
    h[k] = fma(step[k], apart, f[i]);
    const V4 rise = beta[k] * all(6.0) * place[k] * (one - place[k]) * apart;
    by[j] += rise;
    by[k] = fma(rise, foot[k], by[k]);
  }
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    by[k] = fma(two * e[k] * total * per_sum, fma(e[j] * e[j], h[i], e[i] * e[i] * h[j]), by[k]);
  }
  V4 sx = zero, sy = zero;
  const V4 per_gt = one / gt;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const V4 s = fma(-by[k], per_gt, qz[k]);
    sx = fma(s, qy[i] - qy[j], sx);
    sy = fma(s, qx[j] - qx[i], sy);
  }
  const V4 per_area = patch(kInverseArea);
  dzdx = select(blend.fine, sx * per_area, missing);
  dzdy = select(blend.fine, sy * per_area, missing);
}

template <bool kSlopes>
[[gnu::always_inline]] static inline void patch_points(const double* patch, double side, const double* x,
                                                       const double* y, int count, double* z, double* dzdx,
                                                       double* dzdy) {
  const OnePatch one{patch};
  for (int i = 0; i < count; i += kLanes) {
    double px[kLanes], py[kLanes], results[3][kLanes];
    const int lanes = count - i < kLanes ? count - i : kLanes;
    V4 h, hx = all(0.0), hy = hx;
    if (lanes == kLanes) {
      evaluate_lanes<kSlopes>(one, side, load(x + i), load(y + i), h, hx, hy);
      store(z + i, h);
      if (kSlopes) store(dzdx + i, hx), store(dzdy + i, hy);
      continue;
    }
    for (int k = 0; k < kLanes; ++k) px[k] = x[i + (k < lanes ? k : 0)], py[k] = y[i + (k < lanes ? k : 0)];
    evaluate_lanes<kSlopes>(one, side, load(px), load(py), h, hx, hy);
    store(results[0], h), store(results[1], hx), store(results[2], hy);
    for (int k = 0; k < lanes; ++k) {
      z[i + k] = results[0][k];
      if (kSlopes) dzdx[i + k] = results[1][k], dzdy[i + k] = results[2][k];
    }
  }
}

static void patch_points(const double* patch, double side, const double* x, const double* y, int count, double* z,
                         double* dzdx, double* dzdy) {
  if (dzdx)
    patch_points<true>(patch, side, x, y, count, z, dzdx, dzdy);
  else
    patch_points<false>(patch, side, x, y, count, z, dzdx, dzdy);
}

static void patch_mixed(const double* patches, double side, const double* x, const double* y, double* z, double* dzdx,
                        double* dzdy) {
  alignas(32) double block[kPatchEntries * kLanes];
  for (int i = 0; i < kPatchEntries; ++i)
    store(block + kLanes * i,
          V4{patches[i], patches[i + kPatchEntries], patches[i + 2 * kPatchEntries], patches[i + 3 * kPatchEntries]});
  V4 h, hx = all(0.0), hy = hx;
  if (dzdx) {
    evaluate_lanes<true>(FourPatches{block}, side, load(x), load(y), h, hx, hy);
    store(dzdx, hx), store(dzdy, hy);
  } else {
    evaluate_lanes<false>(FourPatches{block}, side, load(x), load(y), h, hx, hy);
  }
  store(z, h);
}

/// On a lattice of barycentric coordinates of six steps. At the corners the surface meets the facet.
static double patch_bulge(const PatchSource& source, const double* direction) {
  constexpr int kSteps = 6, kPoints = (kSteps + 1) * (kSteps + 2) / 2 - 3;
  constexpr int kGroups = (kPoints + kLanes - 1) / kLanes;
  double patch[kPatchEntries];
  prepare_fits(direction, source, patch);
  double lattice[3][kGroups * kLanes];
  int count = 0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps - i; ++j) {
      const int l = kSteps - i - j;
      if (i == kSteps || j == kSteps || l == kSteps) continue;
      const int at[3] = {i, j, l};
      for (int k = 0; k < 3; ++k) lattice[k][count] = at[k] / static_cast<double>(kSteps);
      ++count;
    }
  for (; count < kGroups * kLanes; ++count)
    for (int k = 0; k < 3; ++k) lattice[k][count] = lattice[k][0];
  for (int k = 0; k < 3; ++k) {
    const double* f = patch + kFits + k * kFitEntries;
    if (!(f[kAlongW] - f[kCubic] * f[kAlongU] - f[kCubic + 1] * f[kAlongV] > kGrazingLine)) return __builtin_nan("");
  }
  const OnePatch one{patch};
  V4 farthest = all(0.0);
  M4 fine = each(-1);
  for (int g = 0; g < kGroups; ++g) {
    const V4 b[3] = {load(lattice[0] + kLanes * g), load(lattice[1] + kLanes * g), load(lattice[2] + kLanes * g)};
    BlendLanes s;
    solve_lanes(one, 1.0, b, all(1.0), b, s);
    fine &= s.fine;
    farthest = most(farthest, magnitude(s.t));
  }
  if (bits(fine) != (1 << kLanes) - 1) return __builtin_nan("");
  double result = 0.0;
  for (int k = 0; k < kLanes; ++k) result = result > farthest[k] ? result : farthest[k];
  return result;
}

}  // namespace

TREADMARK_KERNEL(PatchKernel, prepare_patch, patch_points, patch_mixed, patch_bulge);

}  // namespace treadmark::mesh
