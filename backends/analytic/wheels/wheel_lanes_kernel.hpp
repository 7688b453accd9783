// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/analytic/wheels/wheel_lanes.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/lanes4.hpp"

namespace treadmark::analytic {
namespace {

using namespace lanes;
static_assert(kWheelLanes == kLanes);

/// As fast_sin_cos.
TREADMARK_LANES void sin_cos(const V4& x, V4& sine, V4& cosine) {
  constexpr double kRound = 6755399441055744.0, kTwoOverPi = 0.63661977236758134308;
  constexpr double kHalfPi1 = 1.57079632673412561417, kHalfPi2 = 6.07710050630396597660e-11,
                   kHalfPi3 = 2.02226624879595063154e-21;
  const V4 shifted = x * kTwoOverPi + kRound, n = shifted - kRound;
  const M4 quadrant = (M4)shifted;
  const V4 r = ((x - n * kHalfPi1) - n * kHalfPi2) - n * kHalfPi3, w = r * r;
  const V4 s =
      r + r * w *
              (-1.0 / 6.0 +
               w * (1.0 / 120.0 +
                    w * (-1.0 / 5040.0 +
                         w * (1.0 / 362880.0 +
                              w * (-1.0 / 39916800.0 + w * (1.0 / 6227020800.0 - w * (1.0 / 1307674368000.0)))))));
  const V4 c =
      1.0 +
      w * (-0.5 + w * (1.0 / 24.0 +
                       w * (-1.0 / 720.0 +
                            w * (1.0 / 40320.0 + w * (-1.0 / 3628800.0 +
                                                      w * (1.0 / 479001600.0 + w * (-1.0 / 87178291200.0 +
                                                                                    w * (1.0 / 20922789888000.0))))))));
  const M4 swap = ((M4)s ^ (M4)c) & -(quadrant & 1);
  sine = (V4)(((M4)s ^ swap) ^ ((quadrant & 2) << 62));
  cosine = (V4)(((M4)c ^ swap) ^ (((quadrant + 1) & 2) << 62));
}

/// Twice the arc tangent, for |u| <= tan(kWidestFlatLane/2): the first term left out is below 1e-17.
TREADMARK_LANES V4 twice_arc_tangent(const V4& u) {
  const V4 w = u * u;
  V4 sum = all(1.0 / 27.0);
  for (int i = 25; i > 0; i -= 2) sum = 1.0 / i - w * sum;
  return 2.0 * u * sum;
}

struct Depth {
  V4 d, by_theta, by_y;
};
/// Adds the depth of one flat at points (x, y, z), r = |(x, z)|.
TREADMARK_LANES void add_flat(const FlatLanes& f, const V4& x, const V4& y, const V4& z, const V4& r, Depth& sum) {
  const V4 zero = all(0.0), ahead = z * f.cos_center + x * f.sin_center, side = x * f.cos_center - z * f.sin_center;
  const V4 e = y - f.y_center;
  M4 in = ahead > r * f.cos_half_angle;
  if (f.half_width > 0.0) in &= magnitude(e) < f.half_width;
  if (bits(in) == 0) return;
  const V4 tan_half = in ? side / (r + ahead) : zero;
  V4 d, d1;
  if (f.fresh) {
    d = f.depth - f.chord_radius * (side * tan_half / ahead);
    d = d > 0.0 ? d : zero;
    d1 = -f.chord_radius * side * r / (ahead * ahead);
  } else {
    V4 s, c;
    sin_cos(f.wave_number * twice_arc_tangent(tan_half), s, c);
    d = 0.5 * f.depth * (1.0 + c);
    d1 = -0.5 * f.depth * f.wave_number * s;
  }
  V4 w = all(1.0), w1 = zero;
  if (f.half_width > 0.0) {
    V4 s, c;
    sin_cos(f.y_wave_number * (in ? e : zero), s, c);
    w = 0.5 * (1.0 + c);
    w1 = -0.5 * f.y_wave_number * s;
  }
  sum.d += in ? d * w : zero;
  sum.by_theta += in ? d1 * w : zero;
  sum.by_y += in ? d * w1 : zero;
}

TREADMARK_LANES V4 profile(const PieceLanes& p, const V4& y, V4& slope) {
  const V4 e = y - p.x0;
  if (p.arc) {
    const V4 s = p.s0 + p.k * e, inside = (1.0 - s) * (1.0 + s), c = root(inside > 0.0 ? inside : all(0.0));
    slope = s / c;
    return p.h0 + e * (s + p.s0) / (c + p.c0);
  }
  const V4 t = e / p.half;
  V4 h = all(p.c[PieceLanes::kTerms - 1]), d = all(0.0);
  for (int i = PieceLanes::kTerms - 2; i >= 0; --i) {
    d = d * t + h;
    h = h * t + p.c[i];
  }
  slope = d / p.half;
  return h;
}

/// WheelRay::is_outermost, to which the numbers belong.
TREADMARK_LANES M4 outermost(const WheelLanesInput& in, const V4& x, const V4& y, const V4& z, const V4& r,
                             const V4& spin, const V4& depth) {
  V4 margin = (x * in.n_x + z * in.n_z) / r;
  if (in.chords != nullptr) {
    const double last = in.chord_cells - 1;
    V4 steepest = y;
    for (int k = 0; k < kWheelLanes; ++k) {
      const double cell = (y[k] - in.chords_begin) * in.chords_per_length;
      steepest[k] = in.chords[cell > 0.0 ? static_cast<int>(cell < last ? cell : last) : 0];
    }
    margin -= steepest * in.n_y;
  }
  const M4 flat = depth > 0.0;
  if (bits(flat) != 0) {
    const double lean = in.n_y < 0.0 ? -in.n_y : in.n_y;
    margin -= flat ? in.max_d_theta * magnitude(spin) / (r * r) + in.max_d_y * lean : all(0.0);
  }
  constexpr double kBeside = 1e-6;
  return margin > kBeside;
}

unsigned wheel_lanes(const WheelLanesInput& in, WheelLanesHits& hits) {
  const V4 o_x = load(hits.o_x), o_y = load(hits.o_y), o_z = load(hits.o_z), guess = load(hits.t);
  const V4 closest = -(o_x * in.n_x + o_z * in.n_z) / in.a, spin = o_z * in.n_x - o_x * in.n_z;
  const V4 room = in.r_max * in.r_max - spin * spin / in.a;
  const V4 t_high = closest + root((room > 0.0 ? room : all(0.0)) / in.a);
  V4 t = (guess >= closest) & (guess <= t_high) ? guess : t_high;
  M4 fine = room > 0.0, settled = fine & ~fine;

  constexpr int kSteps = 8;
  constexpr double kSteep = 50.0, kExact = 1e-12;
  V4 x, y, z, r, dh, slope, step, f_y;
  Depth depth;
  for (int i = 0; i <= kSteps; ++i) {
    x = o_x + t * in.n_x, y = o_y + t * in.n_y, z = o_z + t * in.n_z;
    r = root(x * x + z * z);
    depth = {all(0.0), all(0.0), all(0.0)};
    for (int k = 0; k < in.flat_count; ++k) add_flat(in.flats[k], x, y, z, r, depth);
    const V4 g = r - in.radius - profile(in.piece, y, dh) + depth.d;
    f_y = depth.by_y - dh;
    slope = (x * in.n_x + z * in.n_z) / r + depth.by_theta * spin / (r * r) + f_y * in.n_y;
    if (i > 0 && (bits(fine & ~settled) == 0)) break;  // this time for the derivatives alone
    step = g / slope;
    fine &= (magnitude(step) < in.radius) & (magnitude(slope) < kSteep);
    t -= fine ? step : all(0.0);
    const V4 size = magnitude(step), steep = magnitude(slope);
    settled = size <= in.near * (steep < 1.0 ? steep : all(1.0)) / (1.0 + f_y * f_y);
    if (bits(fine & ~settled) == 0 && !(in.exact && bits(fine & (size > kExact)) != 0)) break;
  }
  store(hits.t, t);
  store(hits.x, x), store(hits.y, y), store(hits.z, z), store(hits.r, r);
  store(hits.f_theta, depth.by_theta), store(hits.f_y, f_y), store(hits.depth, depth.d);
  const V4 y_hit = o_y + t * in.n_y;
  return static_cast<unsigned>(bits(fine & settled & (slope > 0.0) & (t >= closest) & (t <= t_high) &
                                    (y_hit >= in.piece.y_low) & (y_hit <= in.piece.y_high) &
                                    outermost(in, x, y, z, r, spin, depth.d)));
}

}  // namespace

TREADMARK_KERNEL(WheelLanesKernel, wheel_lanes);

}  // namespace treadmark::analytic
