// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#if defined(__AVX2__)
#include <immintrin.h>
#endif

// Four doubles at a time, for kernels that are compiled twice (core/cpu.hpp). Everything here belongs to its source
// file alone. 32-byte vectors are never passed across a call where they would not fit a register: all is inlined.
#define TREADMARK_LANES [[gnu::always_inline, maybe_unused]] static inline

namespace treadmark::mesh {
namespace {

constexpr int kLanes = 4;
using V4 = double __attribute__((vector_size(32)));
using M4 = std::int64_t __attribute__((vector_size(32)));

TREADMARK_LANES V4 all(double a) { return V4{a, a, a, a}; }
TREADMARK_LANES M4 each(std::int64_t a) { return M4{a, a, a, a}; }
TREADMARK_LANES V4 load(const double* p) {
  V4 v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
TREADMARK_LANES M4 load(const std::int64_t* p) {
  M4 v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
TREADMARK_LANES void store(double* p, V4 v) { __builtin_memcpy(p, &v, sizeof v); }
TREADMARK_LANES void store(std::int64_t* p, M4 v) { __builtin_memcpy(p, &v, sizeof v); }

TREADMARK_LANES V4 select(M4 mask, V4 yes, V4 no) { return (V4)(((M4)yes & mask) | ((M4)no & ~mask)); }
TREADMARK_LANES M4 select(M4 mask, M4 yes, M4 no) { return (yes & mask) | (no & ~mask); }
TREADMARK_LANES V4 magnitude(V4 a) { return (V4)((M4)a & each(INT64_MAX)); }

#if defined(__AVX2__)
TREADMARK_LANES V4 least(V4 a, V4 b) { return (V4)_mm256_min_pd((__m256d)a, (__m256d)b); }
TREADMARK_LANES V4 most(V4 a, V4 b) { return (V4)_mm256_max_pd((__m256d)a, (__m256d)b); }
/// Bit k: lane k is set.
TREADMARK_LANES int bits(M4 mask) { return _mm256_movemask_pd((__m256d)mask); }
TREADMARK_LANES V4 floor(V4 a) { return (V4)_mm256_floor_pd((__m256d)a); }
/// Whole numbers.
TREADMARK_LANES void store(int* p, V4 a) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm256_cvttpd_epi32((__m256d)a));
}
/// a b + c, rounded once where the processor can.
TREADMARK_LANES V4 fma(V4 a, V4 b, V4 c) { return (V4)_mm256_fmadd_pd((__m256d)a, (__m256d)b, (__m256d)c); }
#else
TREADMARK_LANES V4 least(V4 a, V4 b) { return select(a < b, a, b); }
TREADMARK_LANES V4 most(V4 a, V4 b) { return select(a > b, a, b); }
TREADMARK_LANES int bits(M4 mask) {
  return static_cast<int>((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
}
TREADMARK_LANES V4 floor(V4 a) {
  constexpr double kWhole = 6755399441055744.0;  // 1.5 * 2^52: sums are whole; for numbers below 2^51
  const V4 near = (a + all(kWhole)) - all(kWhole);
  return select(near > a, near - all(1.0), near);
}
TREADMARK_LANES void store(int* p, V4 a) {
  for (int k = 0; k < 4; ++k) p[k] = static_cast<int>(a[k]);
}
TREADMARK_LANES V4 fma(V4 a, V4 b, V4 c) { return a * b + c; }
#endif

}  // namespace
}  // namespace treadmark::mesh
