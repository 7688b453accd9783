// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// For kernel files only: everything here has internal linkage (see core/cpu.hpp).
#pragma once

#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

// everything here is inlined, nothing is passed
#pragma GCC diagnostic ignored "-Wpsabi"

namespace treadmark::analytic {
namespace {

using Lanes = double __attribute__((vector_size(32)));
using Mask = long long __attribute__((vector_size(32)));
#define TREADMARK_LANES __attribute__((always_inline)) inline

TREADMARK_LANES Lanes load(const double* p) { return Lanes{p[0], p[1], p[2], p[3]}; }
TREADMARK_LANES void store(const Lanes& v, double* p) {
  for (int i = 0; i < 4; ++i) p[i] = v[i];
}
TREADMARK_LANES Lanes all(double v) { return Lanes{v, v, v, v}; }
TREADMARK_LANES Lanes magnitude(const Lanes& v) { return v < 0.0 ? -v : v; }
TREADMARK_LANES Lanes root(const Lanes& v) {
#if defined(__AVX2__)
  return (Lanes)_mm256_sqrt_pd((__m256d)v);
#elif defined(__SSE2__)
  const __m128d low = _mm_sqrt_pd(__m128d{v[0], v[1]}), high = _mm_sqrt_pd(__m128d{v[2], v[3]});
  return Lanes{low[0], low[1], high[0], high[1]};
#else
  return Lanes{__builtin_sqrt(v[0]), __builtin_sqrt(v[1]), __builtin_sqrt(v[2]), __builtin_sqrt(v[3])};
#endif
}
TREADMARK_LANES unsigned bits(const Mask& m) {
#if defined(__AVX2__)
  return static_cast<unsigned>(_mm256_movemask_pd((__m256d)m));
#else
  return static_cast<unsigned>((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
#endif
}

}  // namespace
}  // namespace treadmark::analytic
