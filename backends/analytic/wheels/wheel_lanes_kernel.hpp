// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Included by wheel_lanes_generic.cpp and wheel_lanes_avx2.cpp only.
#pragma once

#include "treadmark/backends/analytic/lanes4.hpp"
#include "treadmark/backends/analytic/wheels/wheel_lanes.hpp"

namespace treadmark::analytic {
namespace {

static_assert(kWheelLanes == 4);

/// As fast_sin_cos.
TREADMARK_LANES void sin_cos(const Lanes& x, Lanes& sine, Lanes& cosine) {
  constexpr double kRound = 6755399441055744.0, kTwoOverPi = 0.63661977236758134308;
  constexpr double kHalfPi1 = 1.57079632673412561417, kHalfPi2 = 6.07710050630396597660e-11,
                   kHalfPi3 = 2.02226624879595063154e-21;
  const Lanes shifted = x * kTwoOverPi + kRound, n = shifted - kRound;
  const Mask quadrant = (Mask)shifted;
  const Lanes r = ((x - n * kHalfPi1) - n * kHalfPi2) - n * kHalfPi3, w = r * r;
  const Lanes s =
      r + r * w *
              (-1.0 / 6.0 +
               w * (1.0 / 120.0 +
                    w * (-1.0 / 5040.0 +
                         w * (1.0 / 362880.0 +
                              w * (-1.0 / 39916800.0 + w * (1.0 / 6227020800.0 - w * (1.0 / 1307674368000.0)))))));
  const Lanes c =
      1.0 +
      w * (-0.5 + w * (1.0 / 24.0 +
                       w * (-1.0 / 720.0 +
                            w * (1.0 / 40320.0 + w * (-1.0 / 3628800.0 +
                                                      w * (1.0 / 479001600.0 + w * (-1.0 / 87178291200.0 +
                                                                                    w * (1.0 / 20922789888000.0))))))));
  const Mask swap = ((Mask)s ^ (Mask)c) & -(quadrant & 1);
  sine = (Lanes)(((Mask)s ^ swap) ^ ((quadrant & 2) << 62));
  cosine = (Lanes)(((Mask)c ^ swap) ^ (((quadrant + 1) & 2) << 62));
}

/// Twice the arc tangent, for |u| <= tan(kWidestFlatLane/2): the first term left out is below 1e-17.
TREADMARK_LANES Lanes twice_arc_tangent(const Lanes& u) {
  const Lanes w = u * u;
  Lanes sum = all(1.0 / 27.0);
  for (int i = 25; i > 0; i -= 2) sum = 1.0 / i - w * sum;
  return 2.0 * u * sum;
}

struct Depth {
  Lanes d, by_theta, by_y;
};
/// Adds the depth of one flat at points (x, y, z), r = |(x, z)|.
TREADMARK_LANES void add_flat(const FlatLanes& f, const Lanes& x, const Lanes& y, const Lanes& z, const Lanes& r,
                              Depth& sum) {
  const Lanes zero = all(0.0), ahead = z * f.cos_center + x * f.sin_center, side = x * f.cos_center - z * f.sin_center;
  const Lanes e = y - f.y_center;
  Mask in = ahead > r * f.cos_half_angle;
  if (f.half_width > 0.0) in &= magnitude(e) < f.half_width;
  if (bits(in) == 0) return;
  const Lanes tan_half = in ? side / (r + ahead) : zero;
  Lanes d, d1;
  if (f.fresh) {
    d = f.depth - f.chord_radius * (side * tan_half / ahead);
    d = d > 0.0 ? d : zero;
    d1 = -f.chord_radius * side * r / (ahead * ahead);
  } else {
    Lanes s, c;
    sin_cos(f.wave_number * twice_arc_tangent(tan_half), s, c);
    d = 0.5 * f.depth * (1.0 + c);
    d1 = -0.5 * f.depth * f.wave_number * s;
  }
  Lanes w = all(1.0), w1 = zero;
  if (f.half_width > 0.0) {
    Lanes s, c;
    sin_cos(f.y_wave_number * (in ? e : zero), s, c);
    w = 0.5 * (1.0 + c);
    w1 = -0.5 * f.y_wave_number * s;
  }
  sum.d += in ? d * w : zero;
  sum.by_theta += in ? d1 * w : zero;
  sum.by_y += in ? d * w1 : zero;
}

TREADMARK_LANES Lanes profile(const PieceLanes& p, const Lanes& y, Lanes& slope) {
  const Lanes e = y - p.x0;
  if (p.arc) {
    const Lanes s = p.s0 + p.k * e, inside = (1.0 - s) * (1.0 + s), c = root(inside > 0.0 ? inside : all(0.0));
    slope = s / c;
    return p.h0 + e * (s + p.s0) / (c + p.c0);
  }
  const Lanes t = e / p.half;
  Lanes h = all(p.c[PieceLanes::kTerms - 1]), d = all(0.0);
  for (int i = PieceLanes::kTerms - 2; i >= 0; --i) {
    d = d * t + h;
    h = h * t + p.c[i];
  }
  slope = d / p.half;
  return h;
}

/// WheelRay::is_outermost, to which the numbers belong.
TREADMARK_LANES Mask outermost(const WheelLanesInput& in, const Lanes& x, const Lanes& y, const Lanes& z,
                               const Lanes& r, const Lanes& spin, const Lanes& depth) {
  Lanes margin = (x * in.n_x + z * in.n_z) / r;
  if (in.chords != nullptr) {
    const double last = in.chord_cells - 1;
    Lanes steepest = y;
    for (int k = 0; k < kWheelLanes; ++k) {
      const double cell = (y[k] - in.chords_begin) * in.chords_per_length;
      steepest[k] = in.chords[cell > 0.0 ? static_cast<int>(cell < last ? cell : last) : 0];
    }
    margin -= steepest * in.n_y;
  }
  const Mask flat = depth > 0.0;
  if (bits(flat) != 0) {
    const double lean = in.n_y < 0.0 ? -in.n_y : in.n_y;
    margin -= flat ? in.max_d_theta * magnitude(spin) / (r * r) + in.max_d_y * lean : all(0.0);
  }
  constexpr double kBeside = 1e-6;
  return margin > kBeside;
}

unsigned wheel_lanes(const WheelLanesInput& in, WheelLanesHits& hits) {
  const Lanes o_x = load(hits.o_x), o_y = load(hits.o_y), o_z = load(hits.o_z), guess = load(hits.t);
  const Lanes closest = -(o_x * in.n_x + o_z * in.n_z) / in.a, spin = o_z * in.n_x - o_x * in.n_z;
  const Lanes room = in.r_max * in.r_max - spin * spin / in.a;
  const Lanes t_high = closest + root((room > 0.0 ? room : all(0.0)) / in.a);
  Lanes t = (guess >= closest) & (guess <= t_high) ? guess : t_high;
  Mask fine = room > 0.0, settled = fine & ~fine;

  constexpr int kSteps = 8;
  constexpr double kSteep = 50.0, kExact = 1e-12;
  Lanes x, y, z, r, dh, slope, step, f_y;
  Depth depth;
  for (int i = 0; i <= kSteps; ++i) {
    x = o_x + t * in.n_x, y = o_y + t * in.n_y, z = o_z + t * in.n_z;
    r = root(x * x + z * z);
    depth = {all(0.0), all(0.0), all(0.0)};
    for (int k = 0; k < in.flat_count; ++k) add_flat(in.flats[k], x, y, z, r, depth);
    const Lanes g = r - in.radius - profile(in.piece, y, dh) + depth.d;
    f_y = depth.by_y - dh;
    slope = (x * in.n_x + z * in.n_z) / r + depth.by_theta * spin / (r * r) + f_y * in.n_y;
    if (i > 0 && (bits(fine & ~settled) == 0)) break;  // this time for the derivatives alone
    step = g / slope;
    fine &= (magnitude(step) < in.radius) & (magnitude(slope) < kSteep);
    t -= fine ? step : all(0.0);
    const Lanes size = magnitude(step), steep = magnitude(slope);
    settled = size <= in.near * (steep < 1.0 ? steep : all(1.0)) / (1.0 + f_y * f_y);
    if (bits(fine & ~settled) == 0 && !(in.exact && bits(fine & (size > kExact)) != 0)) break;
  }
  store(t, hits.t);
  store(x, hits.x), store(y, hits.y), store(z, hits.z), store(r, hits.r);
  store(depth.by_theta, hits.f_theta), store(f_y, hits.f_y), store(depth.d, hits.depth);
  const Lanes y_hit = o_y + t * in.n_y;
  return bits(fine & settled & (slope > 0.0) & (t >= closest) & (t <= t_high) & (y_hit >= in.piece.y_low) &
              (y_hit <= in.piece.y_high) & outermost(in, x, y, z, r, spin, depth.d));
}

#undef TREADMARK_LANES

}  // namespace
}  // namespace treadmark::analytic
