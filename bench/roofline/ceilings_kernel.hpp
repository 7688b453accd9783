// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/bench/roofline/ceilings.hpp"
#include "treadmark/core/kernel.hpp"
#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace treadmark::bench {
namespace {

#if defined(__AVX2__)
constexpr int kWidth = 4;
#elif defined(__SSE2__)
constexpr int kWidth = 2;
#else
constexpr int kWidth = 1;
#endif
typedef double Wide __attribute__((vector_size(8 * kWidth)));
constexpr int kAtOnce = 12;  // registers, each a chain of its own

template <class Step>
__attribute__((always_inline)) inline void repeat(double* x, long times, const Step& step) {
  for (int first = 0; first < Ceilings::kNumbers; first += kAtOnce * kWidth) {
    Wide w[kAtOnce];
    for (int i = 0; i < kAtOnce; ++i)
      for (int k = 0; k < kWidth; ++k) w[i][k] = x[first + kWidth * i + k];
    for (long n = 0; n < times; ++n)
#pragma GCC unroll 12
      for (int i = 0; i < kAtOnce; ++i) w[i] = step(w[i]);
    for (int i = 0; i < kAtOnce; ++i)
      for (int k = 0; k < kWidth; ++k) x[first + kWidth * i + k] = w[i][k];
  }
}

void multiply_add(double* x, double a, double b, long times) {
  repeat(
      x, times, [ a, b ](Wide w) __attribute__((always_inline)) { return a * w + b; });
}
void divide(double* x, double c, long times) {
  repeat(
      x, times, [c](Wide w) __attribute__((always_inline)) { return c / w; });
}
void root(double* x, long times) {
  repeat(
      x, times, [](Wide w) __attribute__((always_inline)) {
#if defined(__AVX2__)
        return (Wide)_mm256_sqrt_pd((__m256d)w);
#elif defined(__SSE2__)
        return (Wide)_mm_sqrt_pd((__m128d)w);
#else
        return Wide{__builtin_sqrt(w[0])};
#endif
      });
}

}  // namespace

TREADMARK_KERNEL(Ceilings, multiply_add, divide, root);

}  // namespace treadmark::bench
