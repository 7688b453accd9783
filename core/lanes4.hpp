// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

// Several numbers in one register (GCC and clang), four doubles above all, for kernels (core/kernel.hpp). Functions
// belong to their source file alone. 32-byte vectors are never passed across a call where they would not fit a
// register: all is inlined.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"
#define TREADMARK_LANES [[gnu::always_inline, maybe_unused]] static inline

namespace treadmark::lanes {

constexpr int kLanes = 4;
using V4 = double __attribute__((vector_size(32)));
using M4 = std::int64_t __attribute__((vector_size(32)));  ///< of comparisons: all bits of a lane or none
using F4 = float __attribute__((vector_size(16)));
using I4 = std::int32_t __attribute__((vector_size(16)));
using I8 = std::int32_t __attribute__((vector_size(32)));
using F2 = float __attribute__((vector_size(8)));
using Pair = double __attribute__((vector_size(16)));
/// The same in memory, at any place.
using V4Anywhere = double __attribute__((vector_size(32), aligned(8), may_alias));
using M4Anywhere = std::int64_t __attribute__((vector_size(32), aligned(8), may_alias));
using F4Anywhere = float __attribute__((vector_size(16), aligned(4), may_alias));
using I4Anywhere = std::int32_t __attribute__((vector_size(16), aligned(4), may_alias));
using F2Anywhere = float __attribute__((vector_size(8), aligned(4), may_alias));

TREADMARK_LANES V4 all(double a) { return V4{a, a, a, a}; }
TREADMARK_LANES M4 each(std::int64_t a) { return M4{a, a, a, a}; }
TREADMARK_LANES V4 load(const double* p) { return *reinterpret_cast<const V4Anywhere*>(p); }
TREADMARK_LANES M4 load(const std::int64_t* p) { return *reinterpret_cast<const M4Anywhere*>(p); }
TREADMARK_LANES V4 load(const float* p) {
  return __builtin_convertvector(F4(*reinterpret_cast<const F4Anywhere*>(p)), V4);
}
TREADMARK_LANES void store(double* p, V4 v) { *reinterpret_cast<V4Anywhere*>(p) = v; }
TREADMARK_LANES void store(std::int64_t* p, M4 v) { *reinterpret_cast<M4Anywhere*>(p) = v; }
TREADMARK_LANES void store(float* p, F4 v) { *reinterpret_cast<F4Anywhere*>(p) = v; }
TREADMARK_LANES void store(std::int32_t* p, I4 v) { *reinterpret_cast<I4Anywhere*>(p) = v; }
/// Whole numbers.
TREADMARK_LANES void store(std::int32_t* p, V4 v) { store(p, __builtin_convertvector(v, I4)); }

TREADMARK_LANES V4 select(M4 mask, V4 yes, V4 no) { return (V4)(((M4)yes & mask) | ((M4)no & ~mask)); }
TREADMARK_LANES M4 select(M4 mask, M4 yes, M4 no) { return (yes & mask) | (no & ~mask); }
TREADMARK_LANES V4 magnitude(V4 a) { return (V4)((M4)a & each(INT64_MAX)); }
/// a < b ? a : b, so that b is told where one is not a number.
TREADMARK_LANES V4 least(V4 a, V4 b) {
#if defined(__AVX2__)
  return (V4)_mm256_min_pd((__m256d)a, (__m256d)b);
#else
  return select(a < b, a, b);
#endif
}
/// a > b ? a : b.
TREADMARK_LANES V4 most(V4 a, V4 b) {
#if defined(__AVX2__)
  return (V4)_mm256_max_pd((__m256d)a, (__m256d)b);
#else
  return select(a > b, a, b);
#endif
}
/// Bit k: lane k is set.
TREADMARK_LANES int bits(M4 mask) {
#if defined(__AVX2__)
  return _mm256_movemask_pd((__m256d)mask);
#else
  return static_cast<int>((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}
TREADMARK_LANES V4 floor(V4 a) {
#if defined(__AVX2__)
  return (V4)_mm256_floor_pd((__m256d)a);
#else
  constexpr double kWhole = 6755399441055744.0;  // 1.5 * 2^52: sums are whole; for numbers below 2^51
  const V4 near = (a + all(kWhole)) - all(kWhole);
  return select(near > a, near - all(1.0), near);
#endif
}
/// a b + c, rounded once where the processor can.
TREADMARK_LANES V4 fma(V4 a, V4 b, V4 c) {
#if defined(__FMA__)
  return (V4)_mm256_fmadd_pd((__m256d)a, (__m256d)b, (__m256d)c);
#else
  return a * b + c;
#endif
}
TREADMARK_LANES V4 root(V4 a) {
#if defined(__AVX2__)
  return (V4)_mm256_sqrt_pd((__m256d)a);
#elif defined(__SSE2__)
  const __m128d low = _mm_sqrt_pd(__m128d{a[0], a[1]}), high = _mm_sqrt_pd(__m128d{a[2], a[3]});
  return V4{low[0], low[1], high[0], high[1]};
#else
  return V4{__builtin_sqrt(a[0]), __builtin_sqrt(a[1]), __builtin_sqrt(a[2]), __builtin_sqrt(a[3])};
#endif
}
TREADMARK_LANES void transpose(V4 (&r)[4]) {
  const V4 a = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6), b = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
  const V4 c = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6), d = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
  r[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  r[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  r[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  r[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}
TREADMARK_LANES double sum(V4 a) { return (a[0] + a[1]) + (a[2] + a[3]); }

}  // namespace treadmark::lanes

#pragma GCC diagnostic pop
