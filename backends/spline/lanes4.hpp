// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

// For kernel files only: everything here has internal linkage (see core/cpu.hpp).
#pragma GCC diagnostic ignored "-Wpsabi"

namespace treadmark::spline {
namespace {

typedef double V __attribute__((vector_size(32)));
typedef long long VMask __attribute__((vector_size(32)));
typedef int VInt __attribute__((vector_size(16)));
typedef float VFloat __attribute__((vector_size(16)));
typedef double UnalignedV __attribute__((vector_size(32), aligned(8), may_alias));
typedef float UnalignedF __attribute__((vector_size(16), aligned(4), may_alias));
typedef int UnalignedInt __attribute__((vector_size(16), aligned(4), may_alias));

#define TREADMARK_LANES static inline __attribute__((always_inline))

TREADMARK_LANES V load(const double* p) { return *reinterpret_cast<const UnalignedV*>(p); }
TREADMARK_LANES V load(const float* p) {
  return __builtin_convertvector(VFloat(*reinterpret_cast<const UnalignedF*>(p)), V);
}
TREADMARK_LANES void store(double* p, V x) { *reinterpret_cast<UnalignedV*>(p) = x; }
TREADMARK_LANES void store(int* p, VInt x) { *reinterpret_cast<UnalignedInt*>(p) = x; }
TREADMARK_LANES V all(double x) { return V{x, x, x, x}; }
TREADMARK_LANES V absolute(V x) {
  return V(VMask(x) & VMask{0x7fffffffffffffff, 0x7fffffffffffffff, 0x7fffffffffffffff, 0x7fffffffffffffff});
}
TREADMARK_LANES V least(V a, V b) { return a < b ? a : b; }
TREADMARK_LANES V greatest(V a, V b) { return a > b ? a : b; }
TREADMARK_LANES int bits(VMask m) {
#if defined(__AVX2__)
  return __builtin_ia32_movmskpd256(V(m));
#else
  return static_cast<int>((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
#endif
}
TREADMARK_LANES void transpose(V (&r)[4]) {
  const V a = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6), b = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
  const V c = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6), d = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
  r[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  r[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  r[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  r[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

}  // namespace
}  // namespace treadmark::spline
