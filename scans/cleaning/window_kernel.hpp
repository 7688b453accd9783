// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>

#include "treadmark/scans/cleaning/window.hpp"

namespace treadmark::scans {
namespace {

using F4 = float __attribute__((vector_size(16)));
using D4 = double __attribute__((vector_size(32)));
using L4 = std::int64_t __attribute__((vector_size(32)));
using I8 = std::int32_t __attribute__((vector_size(32)));

#define TREADMARK_WINDOW [[gnu::always_inline, maybe_unused]] static inline

TREADMARK_WINDOW D4 four(double a) { return D4{a, a, a, a}; }
TREADMARK_WINDOW D4 load(const float* p) {
  F4 v;
  __builtin_memcpy(&v, p, sizeof v);
  return __builtin_convertvector(v, D4);
}
TREADMARK_WINDOW D4 magnitude(D4 a) { return (D4)((L4)a & L4{INT64_MAX, INT64_MAX, INT64_MAX, INT64_MAX}); }
TREADMARK_WINDOW D4 pick(L4 mask, D4 yes, D4 no) { return (D4)(((L4)yes & mask) | ((L4)no & ~mask)); }
TREADMARK_WINDOW D4 residual(const D4 (&c)[6], D4 x, D4 y, D4 d) {
  return d - (c[0] + x * (c[1] + x * c[3] + y * c[4]) + y * (c[2] + y * c[5]));
}

template <WindowWeights kWeights>
TREADMARK_WINDOW void window_sums(const Window& window, const double* c, double scale, double* moments,
                                  double* products) {
  const D4 zero = four(0.0), one = four(1.0), limit = four(scale), per = four(1.0 / scale);
  D4 coefficients[Window::kTerms], m[Window::kMoments], p[Window::kTerms];
  for (int k = 0; k < Window::kTerms; ++k) coefficients[k] = four(kWeights == WindowWeights::even ? 0.0 : c[k]);
  for (D4& sum : m) sum = zero;
  for (D4& sum : p) sum = zero;
  for (int i = 0; i < window.count; i += 4) {
    const D4 x = load(window.x + i), y = load(window.y + i), d = load(window.d + i);
    D4 w = one;
    if (kWeights != WindowWeights::even) {
      const D4 r = residual(coefficients, x, y, d);
      if (kWeights == WindowWeights::absolute) {
        const D4 size = magnitude(r);
        w = limit / pick(size > limit, size, limit);
      } else {
        const D4 q = r * per, left = one - q * q;
        w = pick(left > zero, left * left, zero);
      }
    }
    const int present = window.count - i;
    if (present < 4) w = pick(L4{-1, -(present > 1), -(present > 2), 0}, w, zero);
    const D4 xx = x * x, yy = y * y, wx = w * x, wy = w * y, wxx = w * xx, wxy = wx * y, wyy = w * yy;
    m[0] += w;
    m[1] += wx;
    m[2] += wxx;
    m[3] += wxx * x;
    m[4] += wxx * xx;
    m[5] += wy;
    m[6] += wxy;
    m[7] += wxx * y;
    m[8] += wxy * xx;
    m[9] += wyy;
    m[10] += wx * yy;
    m[11] += wxx * yy;
    m[12] += wyy * y;
    m[13] += wxy * yy;
    m[14] += wyy * yy;
    p[0] += w * d;
    p[1] += wx * d;
    p[2] += wy * d;
    p[3] += wxx * d;
    p[4] += wxy * d;
    p[5] += wyy * d;
  }
  for (int k = 0; k < Window::kMoments; ++k) moments[k] = (m[k][0] + m[k][1]) + (m[k][2] + m[k][3]);
  for (int k = 0; k < Window::kTerms; ++k) products[k] = (p[k][0] + p[k][1]) + (p[k][2] + p[k][3]);
}

static void sums_of_window(const Window& window, const double* c, WindowWeights weights, double scale, double* moments,
                           double* products) {
  if (weights == WindowWeights::even)
    window_sums<WindowWeights::even>(window, c, scale, moments, products);
  else if (weights == WindowWeights::absolute)
    window_sums<WindowWeights::absolute>(window, c, scale, moments, products);
  else
    window_sums<WindowWeights::biweight>(window, c, scale, moments, products);
}

/// The value of a rank by halving. Floats that are not negative are ordered as the whole numbers of their bits.
TREADMARK_WINDOW float of_rank(const float* values, int count, int rank, float greatest) {
  const auto bits = [](float a) {
    std::int32_t b;
    __builtin_memcpy(&b, &a, sizeof b);
    return b;
  };
  const auto value = [](std::int32_t b) {
    float a;
    __builtin_memcpy(&a, &b, sizeof a);
    return a;
  };
  std::int32_t low = 0, high = bits(greatest);  // it lies within
  int below = 0, up_to = count;
  while (low < high && up_to - below > 1) {
    std::int32_t middle = bits(value(low) + 0.5f * (value(high) - value(low)));
    if (middle >= high) middle = high - 1;
    I8 sum = {};
    for (int i = 0; i < count; i += Window::kLanes) {
      I8 v;
      __builtin_memcpy(&v, values + i, sizeof v);
      sum -= (I8)(v <= middle);
    }
    int found = 0;
    for (int k = 0; k < Window::kLanes; ++k) found += sum[k];
    if (found > rank)
      high = middle, up_to = found;
    else
      low = middle + 1, below = found;
  }
  if (low == high) return value(low);
  float least = value(high);
  for (int i = 0; i < count; ++i)
    if (bits(values[i]) >= low && values[i] < least) least = values[i];
  return least;
}

static void sizes_of_window(Window& window, const double* c, float* middle, float* greatest) {
  D4 coefficients[Window::kTerms];
  for (int k = 0; k < Window::kTerms; ++k) coefficients[k] = four(c[k]);
  for (int i = 0; i < window.count; i += 4) {
    const D4 r = residual(coefficients, load(window.x + i), load(window.y + i), load(window.d + i));
    const F4 size = __builtin_convertvector(magnitude(r), F4);
    __builtin_memcpy(window.size + i, &size, sizeof size);
  }
  float most = 0.0f;
  for (int i = 0; i < window.count; ++i) most = window.size[i] > most ? window.size[i] : most;
  for (int i = window.count; i % Window::kLanes != 0; ++i) window.size[i] = __builtin_inff();
  *greatest = most;
  *middle = of_rank(window.size, window.count, window.count / 2, most);
}

}  // namespace
}  // namespace treadmark::scans
