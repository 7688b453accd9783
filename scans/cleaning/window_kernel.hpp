// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/kernel.hpp"
#include "treadmark/core/lanes4.hpp"
#include "treadmark/scans/cleaning/window.hpp"

namespace treadmark::scans {
namespace {

using namespace lanes;

TREADMARK_LANES V4 residual(const V4 (&c)[6], V4 x, V4 y, V4 d) {
  return d - (c[0] + x * (c[1] + x * c[3] + y * c[4]) + y * (c[2] + y * c[5]));
}

template <WindowWeights kWeights>
TREADMARK_LANES void window_sums(const Window& window, const double* c, double scale, double* moments,
                                 double* products) {
  const V4 zero = all(0.0), one = all(1.0), limit = all(scale), per = all(1.0 / scale);
  V4 coefficients[Window::kTerms], m[Window::kMoments], p[Window::kTerms];
  for (int k = 0; k < Window::kTerms; ++k) coefficients[k] = all(kWeights == WindowWeights::even ? 0.0 : c[k]);
  for (V4& sum : m) sum = zero;
  for (V4& sum : p) sum = zero;
  for (int i = 0; i < window.count; i += 4) {
    const V4 x = load(window.x + i), y = load(window.y + i), d = load(window.d + i);
    V4 w = one;
    if (kWeights != WindowWeights::even) {
      const V4 r = residual(coefficients, x, y, d);
      if (kWeights == WindowWeights::absolute) {
        const V4 size = magnitude(r);
        w = limit / select(size > limit, size, limit);
      } else {
        const V4 q = r * per, left = one - q * q;
        w = select(left > zero, left * left, zero);
      }
    }
    const int present = window.count - i;
    if (present < 4) w = select(M4{-1, -(present > 1), -(present > 2), 0}, w, zero);
    const V4 xx = x * x, yy = y * y, wx = w * x, wy = w * y, wxx = w * xx, wxy = wx * y, wyy = w * yy;
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
TREADMARK_LANES float of_rank(const float* values, int count, int rank, float greatest) {
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
  V4 coefficients[Window::kTerms];
  for (int k = 0; k < Window::kTerms; ++k) coefficients[k] = all(c[k]);
  for (int i = 0; i < window.count; i += 4) {
    const V4 r = residual(coefficients, load(window.x + i), load(window.y + i), load(window.d + i));
    store(window.size + i, __builtin_convertvector(magnitude(r), F4));
  }
  float most = 0.0f;
  for (int i = 0; i < window.count; ++i) most = window.size[i] > most ? window.size[i] : most;
  for (int i = window.count; i % Window::kLanes != 0; ++i) window.size[i] = __builtin_inff();
  *greatest = most;
  *middle = of_rank(window.size, window.count, window.count / 2, most);
}

}  // namespace

TREADMARK_KERNEL(WindowKernel, sums_of_window, sizes_of_window);

}  // namespace treadmark::scans
