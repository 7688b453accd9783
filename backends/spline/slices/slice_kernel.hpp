// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/spline/slices/slice_kernels.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/lanes4.hpp"

namespace treadmark::spline {
namespace {

using namespace lanes;

// The span of u, from one near it.
TREADMARK_LANES int span_of(const NetArrays& net, double u, int span) {
  while (span > 0 && u < net.starts[span]) --span;
  while (span + 1 < net.spans && u >= net.starts[span + 1]) ++span;
  return span;
}

// The last two: derivatives by v before a break where these jump.
struct Fields {
  V4 y, w, y_u, w_u, y_v, w_v, y_before, w_before;
};

// One field at four breaks, its derivative by t and by v; Horner's rule for all three.
template <bool straight>
TREADMARK_LANES void field_at_breaks(const double* p, long stride, V4 t, V4& value, V4& by_t, V4& by_v, V4& before) {
  V4 c{}, dc{}, d{}, e{};
  for (int m = 3; m >= 0; --m) {
    const double* q = p + 2 * m * stride;
    const V4 left = load(q), middle = load(q + 1), right = load(q + 2);
    dc = dc * t + c;
    if constexpr (straight) {
      c = c * t + middle;
      d = d * t + (right - middle);
      e = e * t + (middle - left);
    } else {
      c = c * t + ((1.0 / 6.0) * (left + right) + (2.0 / 3.0) * middle);
      d = d * t + (right - left);
    }
  }
  value = c, by_t = dc, by_v = straight ? d : 0.5 * d, before = e;
}

// At four breaks in one span.
template <bool straight>
TREADMARK_LANES Fields at_breaks(const NetArrays& net, int span, int k, V4 t) {
  const double* p = net.cubics + span * net.span_size + k;
  Fields f;
  field_at_breaks<straight>(p, net.stride, t, f.y, f.y_u, f.y_v, f.y_before);
  field_at_breaks<straight>(p + net.stride, net.stride, t, f.w, f.w_u, f.w_v, f.w_before);
  return f;
}

TREADMARK_LANES void sine_cosine(V4 x, V4& sine, V4& cosine) {
  // good to 3e-17 up to kGreatestAngle
  const V4 q = x * x;
  sine = x * (1.0 - q * (1.0 / 6.0) *
                        (1.0 - q * (1.0 / 20.0) *
                                   (1.0 - q * (1.0 / 42.0) * (1.0 - q * (1.0 / 72.0) * (1.0 - q * (1.0 / 110.0))))));
  cosine =
      1.0 - q * 0.5 *
                (1.0 - q * (1.0 / 12.0) *
                           (1.0 - q * (1.0 / 30.0) *
                                      (1.0 - q * (1.0 / 56.0) * (1.0 - q * (1.0 / 90.0) * (1.0 - q * (1.0 / 132.0))))));
}
constexpr double kGreatestAngle = 0.3;
constexpr double kTurn = 6.283185307179586476925;

// Position and derivatives in the turned frame.
struct Point {
  V4 p[3], by_u[3], by_v[3], before[3];
};
template <bool wheel>
TREADMARK_LANES Point turned(const SectionArrays& section, V4 u, const Fields& f) {
  if constexpr (!wheel)
    return {{u, f.y, f.w}, {all(1.0), f.y_u, f.w_u}, {all(0.0), f.y_v, f.w_v}, {all(0.0), f.y_before, f.w_before}};
  V4 sine, cosine;
  const V4 angle = u - section.reference;
  sine_cosine(angle, sine, cosine);
  if (bits(magnitude(angle) > kGreatestAngle) != 0)
    for (int i = 0; i < 4; ++i) sine[i] = __builtin_sin(angle[i]), cosine[i] = __builtin_cos(angle[i]);
  const V4 x = f.w * sine, z = f.w * cosine;
  return {{x, f.y, z},
          {z + f.w_u * sine, f.y_u, f.w_u * cosine - x},
          {f.w_v * sine, f.y_v, f.w_v * cosine},
          {f.w_before * sine, f.y_before, f.w_before * cosine}};
}
TREADMARK_LANES V4 on_axis(const double (&axis)[4], const V4 (&p)[3]) {
  return axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
}

template <bool wheel, bool straight>
void cut_breaks(SectionArrays& section, int first, int last, char* trouble) {
  constexpr int kMostSteps = 5;
  const NetArrays& net = section.net;
  const V4 target = all(section.c + section.across[3]);
  const V4 largest = all(section.largest_step), tolerance = all(section.u_tolerance);
  double before = section.before, slope = section.slope;
  const bool known = section.shift != 0.0;
  for (int g = first; g <= last; ++g) {
    const int k = 4 * g;
    trouble[g] = 1;
    V4 u;
    if (known) {
      const V4 change = section.shift * load(section.predicted + k);
      if (bits(magnitude(change) < section.largest_prediction) != 15) continue;
      u = load(section.u + k) + change;
    } else {
      u = before + slope * V4{1.0, 2.0, 3.0, 4.0};
    }
    Point at;
    V4 step, u_by_c, du;
    I4 spans{};
    bool done = false;
    for (int iteration = 0; iteration < kMostSteps && !done; ++iteration) {
      const V4 u_net = u + section.turn;
      Fields f;
      section.span = span_of(net, u_net[0], section.span);
      const V4 start = all(net.starts[section.span]), end = all(net.starts[section.span + 1]);
      // the first and the last span of a rail go on
      const bool low = !wheel && section.span == 0, high = !wheel && section.span + 1 == net.spans;
      if ((low || bits(u_net >= start) == 15) && (high || bits(u_net < end) == 15)) {
        f = at_breaks<straight>(net, section.span, k, u_net - start);
        spans = I4{section.span, section.span, section.span, section.span};
      } else {
        int least_span = section.span, greatest_span = section.span;
        M4 in{};
        for (int lane = 0; lane < 4; ++lane) {
          const int span = span_of(net, u_net[lane], section.span);
          least_span = span < least_span ? span : least_span;
          greatest_span = span > greatest_span ? span : greatest_span;
          spans[lane] = span, in[lane] = span;
        }
        if (greatest_span - least_span > 3) break;
        f = at_breaks<straight>(net, least_span, k, u_net - net.starts[least_span]);
        for (int span = least_span + 1; span <= greatest_span; ++span) {
          const Fields other = at_breaks<straight>(net, span, k, u_net - net.starts[span]);
          const M4 here = in == M4{span, span, span, span};
          f = {here ? other.y : f.y,
               here ? other.w : f.w,
               here ? other.y_u : f.y_u,
               here ? other.w_u : f.w_u,
               here ? other.y_v : f.y_v,
               here ? other.w_v : f.w_v,
               here ? other.y_before : f.y_before,
               here ? other.w_before : f.w_before};
        }
        section.span = spans[3];
        // over the seam of a wheel, or beyond its end
        if (wheel && bits((u_net >= net.starts[0]) & (u_net < net.starts[net.spans])) != 15) break;
      }
      at = turned<wheel>(section, u, f);
      u_by_c = 1.0 / on_axis(section.across, at.by_u);
      step = (target - on_axis(section.across, at.p)) * u_by_c;
      du = -on_axis(section.across, at.by_v) * u_by_c;
      if (bits(magnitude(step) <= largest) != 15) break;
      u += step;
      done = bits(magnitude(step) <= tolerance) == 15;
    }
    if (!done) continue;
    trouble[g] = 0;
    V4 p[3], d[3];
    for (int i = 0; i < 3; ++i) {
      p[i] = at.p[i] + step * at.by_u[i];
      d[i] = at.by_v[i] + du * at.by_u[i];
    }
    store(section.s + k, on_axis(section.along, p) - section.along[3]);
    store(section.n + k, on_axis(section.normal, p) - section.normal[3]);
    store(section.ds + k, on_axis(section.along, d));
    store(section.dn + k, on_axis(section.normal, d));
    store(section.u + k, u);
    store(section.du + k, du);
    store(section.spans + k, spans);
    if constexpr (straight) {
      const V4 du_before = -on_axis(section.across, at.before) * u_by_c;
      for (int i = 0; i < 3; ++i) d[i] = at.before[i] + du_before * at.by_u[i];
      store(section.ds_end + k - 1, on_axis(section.along, d));
      store(section.dn_end + k - 1, on_axis(section.normal, d));
      store(section.du_end + k - 1, du_before);
    }
    // Adams and Bashforth's step of order 3 to the next cut, at the same distance.
    const V4 change = known ? u_by_c - load(section.u_by_c + k) : all(0.0);
    const V4 change_before = load(section.change + k);
    const V4 bend = known ? (change_before != 0.0 ? change - change_before : all(0.0)) : all(0.0);
    store(section.predicted + k, u_by_c + 0.5 * change + (5.0 / 12.0) * bend);
    store(section.u_by_c + k, u_by_c);
    store(section.change + k, change);
    before = u[3], slope = du[3];
    if constexpr (straight) slope = slope == slope ? slope : 0.0;  // missing behind the last break
  }
}

void cut(SectionArrays& section, int first, int last, char* trouble) {
  if (section.net.straight)
    section.wheel ? cut_breaks<true, true>(section, first, last, trouble)
                  : cut_breaks<false, true>(section, first, last, trouble);
  else
    section.wheel ? cut_breaks<true, false>(section, first, last, trouble)
                  : cut_breaks<false, false>(section, first, last, trouble);
}

// The bound of the interpolation error of SliceSection::near_cubic.
template <class T, class Bound>
TREADMARK_LANES T cubic_error(const TwistArrays& twist, T turn, T bend, const Bound& bound) {
  const T vvv = bound(4) + twist.turns_normal * bound(5), vv = bound(3) + twist.turns_normal * bound(6);
  return (4.0 * turn * vvv + 6.0 * bend * vv +
          6.0 * turn * (turn * bound(2) + bend * (2.0 * bound(1) + turn * bound(0)))) *
             (1.0 / 384.0) +
         turn * turn * turn * bound(0) * (1.0 / 24.0);
}

TREADMARK_LANES M4 near_cubic(const SectionArrays& section, const TwistArrays& twist, int k, V4 turn, V4 bend) {
  const M4 none{};
  const M4 slow = turn < twist.greatest_turn;
  if (bits(slow) == 0) return none;
  if (bits(turn == 0.0) == 15) return slow;
  const int* spans = section.spans + k;
  const int group = spans[0] / twist.spans_per_group;
  bool same = true, near = true;
  for (int i = 0; i < 4; ++i) {
    const int change = spans[i + 1] - spans[i];
    near = near && change >= -1 && change <= 1;
  }
  for (int i = 1; i < 5; ++i) same = same && spans[i] / twist.spans_per_group == group;
  if (same && near) {
    const V4 error = cubic_error(twist, turn, bend,
                                 [&](int which) { return load(twist.twist + (group * 7 + which) * twist.stride + k); });
    return slow & (error <= twist.greatest_error);
  }
  M4 result{};
  for (int i = 0; i < 4; ++i) {
    const int change = spans[i + 1] - spans[i];
    if (change < -1 || change > 1 || !slow[i]) continue;
    bool good = true;
    for (int end = i; end < i + 2; ++end) {
      const float* p = twist.twist + spans[end] / twist.spans_per_group * 7 * twist.stride + k + i;
      good = good && cubic_error(twist, double(turn[i]), double(bend[i]), [&](int which) {
                       return static_cast<double>(p[which * twist.stride]);
                     }) <= twist.greatest_error;
    }
    result[i] = good ? -1 : 0;
  }
  return result;
}

// The cubic on [0, 1] by its first value, its rise and its end slopes.
TREADMARK_LANES void hermite(V4 (&c)[4], V4 first, V4 rise, V4 slope_0, V4 slope_1) {
  c[0] = first, c[1] = slope_0, c[2] = 3.0 * rise - 2.0 * slope_0 - slope_1, c[3] = slope_0 + slope_1 - 2.0 * rise;
  transpose(c);
}

template <bool place>
void prepare_cells(const SectionArrays& section, const TwistArrays& twist, const SampleArrays& samples, int first,
                   int last, CellCubics* cells, int* first_sample, int* sample_count, char* fast) {
  constexpr double kUpright = 1e-9;  // [m]
  const double inverse_step = 1.0 / samples.step;
  const V4 zero = all(0.0), end = all(samples.count);
  for (int k = first / 4 * 4; k < last; k += 4) {
    const V4 sa = load(section.s + k), sb = load(section.s + k + 1), dsa = load(section.ds + k),
             dsb = load(section.ds_end + k);
    const V4 rise = sb - sa, reach = most(magnitude(dsa), magnitude(dsb));
    const V4 dua = load(section.du + k), dub = load(section.du_end + k);
    // Sufficient for a monotonic cubic (Fritsch and Carlson 1980).
    M4 good =
        (dsa * rise > zero) & (dsb * rise > zero) & (reach <= 3.0 * magnitude(rise)) & (magnitude(rise) > kUpright);
    good &= near_cubic(section, twist, k, most(magnitude(dua), magnitude(dub)), magnitude(dub - dua));
    const int good_bits = bits(good);
    for (int i = 0; i < 4; ++i) fast[k + i] = static_cast<char>((good_bits >> i) & 1);
    const V4 from = least(most((least(sa, sb) - samples.first) * inverse_step + (1.0 - samples.slack), zero), end);
    const V4 to = least(most((most(sa, sb) - samples.first) * inverse_step + (1.0 + samples.slack), zero), end);
    const I4 from_i = __builtin_convertvector(good ? from : zero, I4),
             to_i = __builtin_convertvector(good ? to : zero, I4);
    const I4 count = to_i - from_i;
    store(first_sample + k, from_i);
    store(sample_count + k, count > 0 ? count : I4{});
    // One division for three quotients.
    const V4 both = dsa * dsb, inverse = 1.0 / (both * rise), rise_inverse = rise * rise * inverse;
    const V4 inverse_rise = both * inverse, slope_a = least(rise_inverse * dsb, all(3.0)),
             slope_b = least(rise_inverse * dsa, all(3.0));
    V4 f[4], s[4], n[4], u[4];
    f[0] = zero;
    f[1] = slope_a * inverse_rise;
    f[2] = (3.0 - 2.0 * slope_a - slope_b) * inverse_rise * inverse_rise;
    f[3] = (slope_a + slope_b - 2.0) * inverse_rise * inverse_rise * inverse_rise;
    transpose(f);
    const V4 na = load(section.n + k), ua = load(section.u + k);
    hermite(s, sa, rise, dsa, dsb);
    hermite(n, na, load(section.n + k + 1) - na, load(section.dn + k), load(section.dn_end + k));
    if constexpr (place) hermite(u, ua, load(section.u + k + 1) - ua, dua, dub);
    for (int i = 0; i < 4; ++i) {
      store(cells[k + i].s, s[i]);
      store(cells[k + i].n, n[i]);
      store(cells[k + i].f, f[i]);
      if constexpr (place) store(cells[k + i].u, u[i]);
    }
  }
}

template <bool place>
void solve_pairs(const CellCubics* cells, const SampleArrays& samples, int* pair_cell, int* pair_sample, int count,
                 const HitArrays& hits, char* redo) {
  constexpr double kSettled = 1e-9, kBeside = 1e-6;  // of a cell
  constexpr int kMoreSteps = 4;
  if (count == 0) return;
  for (int i = 0; i < 3; ++i)
    pair_cell[count + i] = pair_cell[count - 1], pair_sample[count + i] = pair_sample[count - 1];
  for (int j = 0; j < count; j += 4) {
    const int* c = pair_cell + j;
    const int* i = pair_sample + j;
    V4 s[4], n[4], q[4];
    for (int lane = 0; lane < 4; ++lane) {
      s[lane] = load(cells[c[lane]].s);
      n[lane] = load(cells[c[lane]].n);
      q[lane] = load(cells[c[lane]].f);
    }
    transpose(s);
    transpose(n);
    transpose(q);
    const V4 target = samples.first + samples.step * V4{double(i[0]), double(i[1]), double(i[2]), double(i[3])};
    const V4 d = target - s[0];
    V4 f = d * (q[1] + d * (q[2] + d * q[3]));
    // the slope of the inverse serves for Newton's steps
    const V4 inverse = q[1] + d * (2.0 * q[2] + d * (3.0 * q[3]));
    f += (d - f * (s[1] + f * (s[2] + f * s[3]))) * inverse;
    const V4 step = (d - f * (s[1] + f * (s[2] + f * s[3]))) * inverse;
    f += step;
    M4 settled = magnitude(step) <= kSettled;
    if (bits(settled) != 15) {
      // Cells that turn much, at corners of a profile: Newton's own slope, within the cell.
      V4 g = f, last = step;
      for (int more = 0; more < kMoreSteps; ++more) {
        last = (d - g * (s[1] + g * (s[2] + g * s[3]))) / (s[1] + g * (2.0 * s[2] + g * (3.0 * s[3])));
        g += last;
      }
      const M4 rescued = (magnitude(last) <= kSettled) & (magnitude(g - 0.5) <= 0.5 + kBeside);
      f = settled ? f : g;
      settled |= rescued;
    }
    const V4 height = n[0] + f * (n[1] + f * (n[2] + f * n[3]));
    const int good = bits(settled);
    V4 u{};
    if constexpr (place) {
      V4 b[4];
      for (int lane = 0; lane < 4; ++lane) b[lane] = load(cells[c[lane]].u);
      transpose(b);
      u = b[0] + f * (b[1] + f * (b[2] + f * b[3]));
      f = least(most(f, all(0.0)), all(1.0));
    }
    for (int lane = 0; lane < 4; ++lane) {
      if (good != 15 && !((good >> lane) & 1)) {
        redo[c[lane]] = 1;
        continue;
      }
      double& known = hits.n[i[lane]];
      if (hits.sign * height[lane] <= hits.sign * known) continue;  // false where there was none
      known = height[lane];
      if constexpr (place) {
        hits.cell[i[lane]] = c[lane];
        hits.v[i[lane]] = c[lane] + 1.0 + f[lane];
        hits.u[i[lane]] = u[lane];
      }
    }
  }
}

template <bool place>
void hit_cells(const SectionArrays& section, const TwistArrays& twist, const SampleArrays& samples, int first, int last,
               const CellArrays& work, const HitArrays& hits) {
  constexpr int kPairs = 512;
  int cell[kPairs + 4], sample[kPairs + 4];
  prepare_cells<place>(section, twist, samples, first, last, work.cells, work.first_sample, work.sample_count,
                       work.fast);
  int pairs = 0;
  for (int k = first; k < last; ++k) {
    int i = work.first_sample[k], count = work.sample_count[k];
    for (;; i += 4, count -= 4) {
      if (pairs > kPairs - 4) {
        solve_pairs<place>(work.cells, samples, cell, sample, pairs, hits, work.redo);
        pairs = 0;
      }
      // always four: the next ones overwrite what is too much
      store(cell + pairs, I4{k, k, k, k});
      store(sample + pairs, I4{i, i + 1, i + 2, i + 3});
      pairs += count < 4 ? count : 4;
      if (count <= 4) break;
    }
  }
  solve_pairs<place>(work.cells, samples, cell, sample, pairs, hits, work.redo);
}

void hit(const SectionArrays& section, const TwistArrays& twist, const SampleArrays& samples, int first, int last,
         const CellArrays& work, const HitArrays& hits) {
  hits.v == nullptr ? hit_cells<false>(section, twist, samples, first, last, work, hits)
                    : hit_cells<true>(section, twist, samples, first, last, work, hits);
}

template <bool wheel, bool straight>
void slopes_at(SectionArrays& section, const HitArrays& hits, int count, const SlopeArrays& slopes) {
  const NetArrays& net = section.net;
  for (int i = 0; i < count; i += 4) {
    const V4 u = load(hits.u + i), u_net = u + section.turn;
    const V4 cell =
        V4{double(hits.cell[i]), double(hits.cell[i + 1]), double(hits.cell[i + 2]), double(hits.cell[i + 3])};
    const V4 f = load(hits.v + i) - (cell + 1.0), g = 1.0 - f;
    V4 basis[4] = {g * g * g * (1.0 / 6.0), 2.0 / 3.0 - f * f * (1.0 - 0.5 * f), 2.0 / 3.0 - g * g * (1.0 - 0.5 * g),
                   f * f * f * (1.0 / 6.0)};
    V4 basis_v[4] = {-0.5 * g * g, f * (1.5 * f - 2.0), g * (2.0 - 1.5 * g), 0.5 * f * f};
    if constexpr (straight) {
      basis[0] = basis[3] = basis_v[0] = basis_v[3] = all(0.0);
      basis[1] = g, basis[2] = f, basis_v[1] = all(-1.0), basis_v[2] = all(1.0);
    }
    transpose(basis);
    transpose(basis_v);
    V4 w[4], y_u[4], w_u[4], y_v[4], w_v[4];
    for (int lane = 0; lane < 4; ++lane) {
      double u_lane = u_net[lane];
      const double u_end = net.starts[net.spans];
      if (wheel && !(u_lane >= net.starts[0] && u_lane < u_end))
        u_lane -= kTurn * __builtin_floor((u_lane - u_end) / kTurn + 1.0);
      section.span = span_of(net, u_lane, section.span);
      const double t = u_lane - net.starts[section.span];
      const double* p = net.cubics + section.span * net.span_size + hits.cell[i + lane];
      const V4 y1 = load(p + 2 * net.stride), y2 = load(p + 4 * net.stride), y3 = load(p + 6 * net.stride);
      const V4 w1 = load(p + 3 * net.stride), w2 = load(p + 5 * net.stride), w3 = load(p + 7 * net.stride);
      const V4 line_y = load(p) + t * (y1 + t * (y2 + t * y3)),
               line_w = load(p + net.stride) + t * (w1 + t * (w2 + t * w3));
      // of straight cells the outer lines do not count, and may be missing
      const auto counted = [](V4 x) __attribute__((always_inline)) {
        return straight ? M4{0, -1, -1, 0} ? x : V4{} : x;
      };
      w[lane] = counted(basis[lane] * line_w);
      y_u[lane] = counted(basis[lane] * (y1 + t * (2.0 * y2 + (3.0 * t) * y3)));
      w_u[lane] = counted(basis[lane] * (w1 + t * (2.0 * w2 + (3.0 * t) * w3)));
      y_v[lane] = counted(basis_v[lane] * line_y);
      w_v[lane] = counted(basis_v[lane] * line_w);
    }
    const auto sum = [](V4(&x)[4]) __attribute__((always_inline)) {
      transpose(x);
      return (x[0] + x[1]) + (x[2] + x[3]);
    };
    Fields fields{all(0.0), wheel ? sum(w) : all(0.0), sum(y_u), sum(w_u), sum(y_v), sum(w_v), all(0.0), all(0.0)};
    const Point at = turned<wheel>(section, u, fields);
    const V4 a_u = on_axis(section.across, at.by_u), a_v = on_axis(section.across, at.by_v);
    const V4 s_u = on_axis(section.along, at.by_u), s_v = on_axis(section.along, at.by_v);
    const V4 n_u = on_axis(section.normal, at.by_u), n_v = on_axis(section.normal, at.by_v);
    const V4 inverse_area = 1.0 / (a_u * s_v - s_u * a_v);
    const V4 along = (a_u * n_v - n_u * a_v) * inverse_area, across = (n_u * s_v - s_u * n_v) * inverse_area;
    store(slopes.along + i, along);
    store(slopes.across + i, across);
  }
}

void slopes(SectionArrays& section, const HitArrays& hits, int count, const SlopeArrays& out) {
  if (section.net.straight)
    section.wheel ? slopes_at<true, true>(section, hits, count, out)
                  : slopes_at<false, true>(section, hits, count, out);
  else
    section.wheel ? slopes_at<true, false>(section, hits, count, out)
                  : slopes_at<false, false>(section, hits, count, out);
}

}  // namespace

TREADMARK_KERNEL(SliceKernel, cut, hit, slopes);

}  // namespace treadmark::spline
