// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>

#include "treadmark/core/kernel.hpp"
#include "treadmark/core/lanes4.hpp"
#include "treadmark/solvers/kalker/halfspace/fft_lines.hpp"

namespace treadmark::kalker {
namespace {

using namespace lanes;

constexpr std::ptrdiff_t kNumber = 2 * kLanes;  // doubles: the real parts of four lines, then the imaginary ones

/// A complex number of each line.
struct C4 {
  V4 re, im;
};

TREADMARK_LANES C4 at(const double* numbers, std::ptrdiff_t k) {
  return {load(numbers + kNumber * k), load(numbers + kNumber * k + kLanes)};
}
TREADMARK_LANES void put(double* numbers, std::ptrdiff_t k, C4 z) {
  store(numbers + kNumber * k, z.re);
  store(numbers + kNumber * k + kLanes, z.im);
}
TREADMARK_LANES C4 sum(C4 a, C4 b) { return {a.re + b.re, a.im + b.im}; }
TREADMARK_LANES C4 difference(C4 a, C4 b) { return {a.re - b.re, a.im - b.im}; }
/// a - i b
TREADMARK_LANES C4 turned_sum(C4 a, C4 b) { return {a.re + b.im, a.im - b.re}; }
/// a + i b
TREADMARK_LANES C4 turned_difference(C4 a, C4 b) { return {a.re - b.im, a.im + b.re}; }
TREADMARK_LANES C4 conjugate(C4 a) { return {a.re, -a.im}; }
TREADMARK_LANES C4 turned(C4 a, const double* w) {
  const V4 re = all(w[0]), im = all(w[1]);
  return {fma(a.re, re, -(a.im * im)), fma(a.re, im, a.im * re)};
}

/// One pass: m numbers of each of `radix` parts, s transforms of them side by side.
struct Pass {
  std::ptrdiff_t m, s;
  const double* turns;
  const double* x;
  double* y;
};

/// The first numbers of all parts (q = 0) are not turned.
template <bool kTurns>
TREADMARK_LANES C4 turned_if(C4 a, const double* w) {
  if constexpr (kTurns) return turned(a, w);
  return a;
}

template <bool kTurns>
TREADMARK_LANES void step_of_2(const Pass& p, std::ptrdiff_t q) {
  for (std::ptrdiff_t t = 0; t < p.s; ++t) {
    const C4 a = at(p.x, t + p.s * q), b = at(p.x, t + p.s * (q + p.m));
    put(p.y, t + p.s * 2 * q, sum(a, b));
    put(p.y, t + p.s * (2 * q + 1), turned_if<kTurns>(difference(a, b), p.turns + 2 * q));
  }
}

template <bool kTurns>
TREADMARK_LANES void step_of_4(const Pass& p, std::ptrdiff_t q) {
  const double* w = p.turns + 6 * q;
  for (std::ptrdiff_t t = 0; t < p.s; ++t) {
    const C4 a = at(p.x, t + p.s * q), b = at(p.x, t + p.s * (q + p.m)), c = at(p.x, t + p.s * (q + 2 * p.m)),
             d = at(p.x, t + p.s * (q + 3 * p.m));
    const C4 even = sum(a, c), odd = difference(a, c), even2 = sum(b, d), odd2 = difference(b, d);
    put(p.y, t + p.s * 4 * q, sum(even, even2));
    put(p.y, t + p.s * (4 * q + 1), turned_if<kTurns>(turned_sum(odd, odd2), w));
    put(p.y, t + p.s * (4 * q + 2), turned_if<kTurns>(difference(even, even2), w + 2));
    put(p.y, t + p.s * (4 * q + 3), turned_if<kTurns>(turned_difference(odd, odd2), w + 4));
  }
}

static void pass_of_2(const Pass& p) {
  step_of_2<false>(p, 0);
  for (std::ptrdiff_t q = 1; q < p.m; ++q) step_of_2<true>(p, q);
}

static void pass_of_4(const Pass& p) {
  step_of_4<false>(p, 0);
  for (std::ptrdiff_t q = 1; q < p.m; ++q) step_of_4<true>(p, q);
}

/// Odd factors, by the symmetry of their roots. kRadix 0: any other.
template <int kRadix, bool kTurns>
TREADMARK_LANES void step_of_odd(const Pass& p, std::ptrdiff_t radix, const double* roots, std::ptrdiff_t q) {
  const std::ptrdiff_t half = radix / 2;
  const double* w = p.turns + 2 * (radix - 1) * q;
  for (std::ptrdiff_t t = 0; t < p.s; ++t) {
    const auto part = [&](std::ptrdiff_t r) { return at(p.x, t + p.s * (q + p.m * r)); };
    C4 sums[kRadix > 0 ? kRadix / 2 : 1], differences[kRadix > 0 ? kRadix / 2 : 1];
    const C4 first = part(0);
    C4 total = first;
    for (std::ptrdiff_t r = 1; r <= half; ++r) {
      const C4 one = part(r), other = part(radix - r);
      if constexpr (kRadix > 0) {
        sums[r - 1] = sum(one, other);
        differences[r - 1] = difference(one, other);
      }
      total = sum(total, sum(one, other));
    }
    put(p.y, t + p.s * radix * q, total);
    for (std::ptrdiff_t c = 1; c <= half; ++c) {
      C4 even = first, odd{all(0.0), all(0.0)};
      for (std::ptrdiff_t r = 1; r <= half; ++r) {
        const std::ptrdiff_t k = 2 * (r * c % radix);
        const V4 cosine = all(roots[k]), sine = all(-roots[k + 1]);
        C4 s, d;
        if constexpr (kRadix > 0) {
          s = sums[r - 1];
          d = differences[r - 1];
        } else {
          const C4 one = part(r), other = part(radix - r);
          s = sum(one, other);
          d = difference(one, other);
        }
        even = {fma(cosine, s.re, even.re), fma(cosine, s.im, even.im)};
        odd = {fma(sine, d.re, odd.re), fma(sine, d.im, odd.im)};
      }
      put(p.y, t + p.s * (radix * q + c), turned_if<kTurns>(turned_sum(even, odd), w + 2 * (c - 1)));
      put(p.y, t + p.s * (radix * q + radix - c),
          turned_if<kTurns>(turned_difference(even, odd), w + 2 * (radix - c - 1)));
    }
  }
}

template <int kRadix>
static void pass_of_odd(const Pass& p, int any, const double* roots) {
  const std::ptrdiff_t radix = kRadix > 0 ? kRadix : any;
  step_of_odd<kRadix, false>(p, radix, roots, 0);
  for (std::ptrdiff_t q = 1; q < p.m; ++q) step_of_odd<kRadix, true>(p, radix, roots, q);
}

/// Of the numbers in work; returns where the result is.
static double* transform(const FftPasses& passes, double* work, double* other) {
  std::ptrdiff_t left = passes.n, s = 1;
  for (int i = 0; i < passes.count; ++i) {
    const int radix = passes.radix[i];
    const Pass pass{left / radix, s, passes.turns[i], work, other};
    switch (radix) {
      case 2:
        pass_of_2(pass);
        break;
      case 3:
        pass_of_odd<3>(pass, radix, passes.roots[i]);
        break;
      case 4:
        pass_of_4(pass);
        break;
      case 5:
        pass_of_odd<5>(pass, radix, passes.roots[i]);
        break;
      case 7:
        pass_of_odd<7>(pass, radix, passes.roots[i]);
        break;
      default:
        pass_of_odd<0>(pass, radix, passes.roots[i]);
    }
    left /= radix;
    s *= radix;
    double* const swap = work;
    work = other;
    other = swap;
  }
  return work;
}

/// Of an inverse transform real and imaginary parts change places before and after one forward.
TREADMARK_LANES C4 swapped(C4 z, bool inverse) { return inverse ? C4{z.im, z.re} : z; }

static void gather(const double* const* from, int count, std::ptrdiff_t n, bool inverse, double* work) {
  const double* line[kLanes];
  for (int i = 0; i < kLanes; ++i) line[i] = from[i < count ? i : 0];
  std::ptrdiff_t k = 0;
  for (; k + 1 < n; k += 2) {
    V4 r[kLanes] = {load(line[0] + 2 * k), load(line[1] + 2 * k), load(line[2] + 2 * k), load(line[3] + 2 * k)};
    transpose(r);
    put(work, k, swapped({r[0], r[1]}, inverse));
    put(work, k + 1, swapped({r[2], r[3]}, inverse));
  }
  if (k < n) {
    const double *a = line[0] + 2 * k, *b = line[1] + 2 * k, *c = line[2] + 2 * k, *d = line[3] + 2 * k;
    put(work, k, swapped({V4{a[0], b[0], c[0], d[0]}, V4{a[1], b[1], c[1], d[1]}}, inverse));
  }
}

static void scatter(const double* work, int count, std::ptrdiff_t n, bool inverse, double* const* to) {
  std::ptrdiff_t k = 0;
  for (; k + 1 < n; k += 2) {
    const C4 one = swapped(at(work, k), inverse), two = swapped(at(work, k + 1), inverse);
    V4 r[kLanes] = {one.re, one.im, two.re, two.im};
    transpose(r);
    for (int i = 0; i < count; ++i) store(to[i] + 2 * k, r[i]);
  }
  if (k < n) {
    const C4 last = swapped(at(work, k), inverse);
    for (int i = 0; i < count; ++i) {
      to[i][2 * k] = last.re[i];
      to[i][2 * k + 1] = last.im[i];
    }
  }
}

static void lines(const FftPasses& passes, int count, const double* const* from, double* const* to, bool inverse,
                  double* work) {
  gather(from, count, passes.n, inverse, work);
  scatter(transform(passes, work, work + kNumber * passes.n), count, passes.n, inverse, to);
}

static void columns(const FftPasses& passes, int count, double* first, std::ptrdiff_t stride, bool inverse,
                    double* work) {
  double* row = first;
  for (std::ptrdiff_t k = 0; k < passes.n; ++k, row += stride) {
    C4 z;
    if (count == kLanes) {
      const V4 a = load(row), b = load(row + kLanes);
      z = {__builtin_shufflevector(a, b, 0, 4, 2, 6), __builtin_shufflevector(a, b, 1, 5, 3, 7)};
    } else {
      z = {all(0.0), all(0.0)};
      for (int i = 0; i < count; ++i) {
        z.re[i] = row[2 * i];
        z.im[i] = row[2 * i + 1];
      }
    }
    put(work, k, swapped(z, inverse));
  }
  const double* done = transform(passes, work, work + kNumber * passes.n);
  row = first;
  for (std::ptrdiff_t k = 0; k < passes.n; ++k, row += stride) {
    const C4 z = swapped(at(done, k), inverse);
    if (count == kLanes) {
      store(row, __builtin_shufflevector(z.re, z.im, 0, 4, 2, 6));
      store(row + kLanes, __builtin_shufflevector(z.re, z.im, 1, 5, 3, 7));
    } else {
      for (int i = 0; i < count; ++i) {
        row[2 * i] = z.re[i];
        row[2 * i + 1] = z.im[i];
      }
    }
  }
}

/// As a complex transform of half the length: even values real, odd ones imaginary.
static void real_forward(const FftPasses& passes, const double* turns, int count, const double* const* from,
                         double* const* to, double* work) {
  const std::ptrdiff_t n = passes.n;
  double* const other = work + kNumber * (n + 1);
  gather(from, count, n, false, work);
  const double* done = transform(passes, work, other);
  double* const spectrum = done == work ? other : work;
  for (std::ptrdiff_t k = 0; k <= n; ++k) {
    const C4 z = at(done, k < n ? k : 0), mirrored = conjugate(at(done, k > 0 ? n - k : 0));
    const C4 twice_even = sum(z, mirrored), difference_of_both = difference(z, mirrored);
    const C4 twice_odd = turned({difference_of_both.im, -difference_of_both.re}, turns + 2 * k);
    const C4 twice = sum(twice_even, twice_odd);
    put(spectrum, k, {0.5 * twice.re, 0.5 * twice.im});
  }
  scatter(spectrum, count, n + 1, false, to);
}

static void real_inverse(const FftPasses& passes, const double* turns, int count, const double* const* from,
                         double* const* to, double* work) {
  const std::ptrdiff_t n = passes.n;
  double* const other = work + kNumber * (n + 1);
  gather(from, count, n + 1, false, other);
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const C4 z = at(other, k), mirrored = conjugate(at(other, n - k));
    const double back[2] = {turns[2 * k], -turns[2 * k + 1]};
    const C4 odd = turned(difference(z, mirrored), back);
    put(work, k, swapped(turned_difference(sum(z, mirrored), odd), true));
  }
  scatter(transform(passes, work, other), count, n, true, to);
}

}  // namespace

TREADMARK_KERNEL(FftLines, lines, columns, real_forward, real_inverse);

}  // namespace treadmark::kalker
