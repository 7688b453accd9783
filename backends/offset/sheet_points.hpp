// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/offset/sheet_kernel.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/lanes4.hpp"

namespace treadmark::offset {

namespace {

using namespace lanes;

/// Integers up to 2^30, rounded down, without a call.
inline int down(double x) {
  const int i = static_cast<int>(x);
  return i - (x < i);
}

inline const float* block_of(const SheetView& v, int bi, int bj) {
  if (v.blocks == nullptr) return v.find(v.owner, bi, bj);
  const unsigned i = static_cast<unsigned>(bi) - static_cast<unsigned>(v.bi_first),
                 j = static_cast<unsigned>(bj) - static_cast<unsigned>(v.bj_first);
  if (i >= static_cast<unsigned>(v.bi_count) || j >= static_cast<unsigned>(v.bj_count)) return nullptr;
  return v.blocks[static_cast<std::size_t>(i) * static_cast<std::size_t>(v.bj_count) + j];
}

inline float coefficient(const SheetView& v, int i, int j) {
  if (v.turn != 0) {
    i %= v.turn;
    i += i < 0 ? v.turn : 0;
  }
  const float* b = block_of(v, i >> 3, j >> 6);
  return b == nullptr ? 0.0f : b[((i & 7) << 6) | (j & 63)];
}

/// The coefficients that the points between neighbouring voxels depend on; kept while points stay there.
template <int kRows>
struct Patch {
  V4 row[kRows] = {};  ///< the last is 0 where fewer than four are needed
  int i = INT32_MIN, j = INT32_MIN;
  bool zero = true;

  void move(const SheetView& v, int i_new, int j_new) {
    i = i_new, j = j_new;
    const int in_i = i & 7, in_j = j & 63;
    if (in_i + kRows <= 8 && in_j + 4 <= 64 && (v.turn == 0 || (i >= 0 && i + kRows <= v.turn))) {
      const float* b = block_of(v, i >> 3, j >> 6);
      zero = b == nullptr;
      if (zero) return;
      b += (in_i << 6) | in_j;
      for (int k = 0; k < kRows; ++k) row[k] = load(b + 64 * k);
    } else {
      zero = false;
      for (int k = 0; k < kRows; ++k)
        for (int l = 0; l < 4; ++l) row[k][l] = l < kRows ? coefficient(v, i + k, j + l) : 0.0f;
    }
  }
};

template <int kDegree>
struct Basis;
/// Weights of the four coefficients as polynomials of the place between them: one + f (two + f (three + f four)).
template <>
struct Basis<3> {
  static constexpr double kShift = 0.0;
  static constexpr V4 kOne = {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0, 0.0}, kTwo = {-0.5, 0.0, 0.5, 0.0},
                      kThree = {0.5, -1.0, 0.5, 0.0}, kFour = {-1.0 / 6.0, 0.5, -0.5, 1.0 / 6.0};
};
template <>
struct Basis<2> {
  static constexpr double kShift = 0.5;
  static constexpr V4 kOne = {0.125, 0.75, 0.125, 0.0}, kTwo = {-0.5, 0.0, 0.5, 0.0}, kThree = {0.5, -1.0, 0.5, 0.0},
                      kFour = {0.0, 0.0, 0.0, 0.0};
};

/// Of degree 2 and 3: rows of four coefficients, weighted along u first.
template <int kDegree>
struct Smooth {
  using B = Basis<kDegree>;
  static constexpr double kShift = B::kShift;
  static constexpr int kBefore = 1;
  Patch<kDegree + 1> patch;

  void at(double f, double g, double& value, double& d_s, double& d_t) const {
    const V4 a = B::kOne + f * (B::kTwo + f * (B::kThree + f * B::kFour)),
             a1 = B::kTwo + f * (2.0 * B::kThree + f * (3.0 * B::kFour));
    const V4 b = B::kOne + g * (B::kTwo + g * (B::kThree + g * B::kFour)),
             b1 = B::kTwo + g * (2.0 * B::kThree + g * (3.0 * B::kFour));
    V4 across = a[0] * patch.row[0], across1 = a1[0] * patch.row[0];
    for (int k = 1; k <= kDegree; ++k) across += a[k] * patch.row[k], across1 += a1[k] * patch.row[k];
    value = sum(across * b);
    d_s = sum(across1 * b);
    d_t = sum(across * b1);
  }
};

[[gnu::always_inline]] inline bool every(const M4& m) { return (m[0] & m[1] & m[2] & m[3]) != 0; }

struct Straight {
  static constexpr double kShift = 0.0;
  static constexpr int kBefore = 0;
  Patch<2> patch;

  // The block looked at last.
  int block_i = INT32_MIN, block_j = INT32_MIN;
  const float* block = nullptr;

  [[gnu::always_inline]] static V4 corners(const float* b) {
    const F2Anywhere first = *reinterpret_cast<const F2Anywhere*>(b),
                     next = *reinterpret_cast<const F2Anywhere*>(b + 64);
    return __builtin_convertvector(__builtin_shufflevector(first, next, 0, 1, 2, 3), V4);
  }
  /// The values round a point: at (i, j), (i, j + 1), (i + 1, j), (i + 1, j + 1).
  [[gnu::always_inline]] V4 corners(const SheetView& v, int i, int j) {
    const int in_i = i & 7, in_j = j & 63;
    if (in_i == 7 || in_j == 63)
      return V4{coefficient(v, i, j), coefficient(v, i, j + 1), coefficient(v, i + 1, j), coefficient(v, i + 1, j + 1)};
    look(v, i >> 3, j >> 6);
    return block == nullptr ? V4{} : corners(block + ((in_i << 6) | in_j));
  }
  void look(const SheetView& v, int bi, int bj) {
    if (bi == block_i && bj == block_j) return;
    block_i = bi, block_j = bj, block = block_of(v, bi, bj);
  }

  /// V4 points at once of a sheet that is not closed, if all lie on its branch.
  bool four_points(const SheetView& v, const double* u, const double* y, double* value, double* d_u, double* d_y) {
    constexpr double kFar = 1 << 30;
    const V4 s = (load(u) - v.u0) * v.per_u, t = (load(y) - v.y0) * v.per_y;
    M4 good = (s > -kFar) & (s < kFar) & (t > -kFar) & (t < kFar);
    if (v.period > 0.0) good &= (s >= v.branch) & (s < v.branch + v.period);
    if (!every(good)) return false;
    I4 i = __builtin_convertvector(s, I4), j = __builtin_convertvector(t, I4);
    i += __builtin_convertvector(s < __builtin_convertvector(i, V4), I4);
    j += __builtin_convertvector(t < __builtin_convertvector(j, V4), I4);
    const V4 f = s - __builtin_convertvector(i, V4), g = t - __builtin_convertvector(j, V4);
    const I4 in_i = i & 7, in_j = j & 63;
    look(v, i[0] >> 3, j[0] >> 6);
    const I4 inside = ((i >> 3) == block_i) & ((j >> 6) == block_j) & (in_i < 7) & (in_j < 63);
    const bool one_block = (inside[0] & inside[1] & inside[2] & inside[3]) != 0;
    if (one_block && block == nullptr) {
      double* const results[] = {value, d_u, d_y};
      for (double* out : results)
        if (out != nullptr) store(out, V4{});
      return true;
    }
    const I4 at = (in_i << 6) | in_j;
    const V4 p = one_block ? corners(block + at[0]) : corners(v, i[0], j[0]);
    const V4 q = one_block ? corners(block + at[1]) : corners(v, i[1], j[1]);
    const V4 r = one_block ? corners(block + at[2]) : corners(v, i[2], j[2]);
    const V4 w = one_block ? corners(block + at[3]) : corners(v, i[3], j[3]);
    const V4 pq0 = __builtin_shufflevector(p, q, 0, 4, 2, 6), pq1 = __builtin_shufflevector(p, q, 1, 5, 3, 7);
    const V4 rw0 = __builtin_shufflevector(r, w, 0, 4, 2, 6), rw1 = __builtin_shufflevector(r, w, 1, 5, 3, 7);
    const V4 c00 = __builtin_shufflevector(pq0, rw0, 0, 1, 4, 5), c01 = __builtin_shufflevector(pq1, rw1, 0, 1, 4, 5),
             c10 = __builtin_shufflevector(pq0, rw0, 2, 3, 6, 7), c11 = __builtin_shufflevector(pq1, rw1, 2, 3, 6, 7);
    const V4 a = c00 + g * (c01 - c00), b = c10 + g * (c11 - c10);
    store(value, a + f * (b - a));
    if (d_u != nullptr) store(d_u, (b - a) * v.per_u);
    if (d_y != nullptr) store(d_y, ((1.0 - f) * (c01 - c00) + f * (c11 - c10)) * v.per_y);
    return true;
  }

  void at(double f, double g, double& value, double& d_s, double& d_t) const {
    const V4 &first = patch.row[0], &next = patch.row[1];
    const double a = first[0] + g * (first[1] - first[0]), b = next[0] + g * (next[1] - next[0]);
    value = a + f * (b - a);
    d_s = b - a;
    d_t = (1.0 - f) * (first[1] - first[0]) + f * (next[1] - next[0]);
  }
};

template <class Spline>
void sheet_points(const SheetView& v, std::size_t n, const double* u, const double* y, double* value, double* d_u,
                  double* d_y) {
  constexpr double kFar = 1 << 30;
  Spline spline;
  for (std::size_t k = 0; k < n; ++k) {
    if constexpr (Spline::kBefore == 0) {
      // Round a wheel most points lie beside each other where nothing is, which the patch knows already.
      for (; v.turn == 0 && k + 4 <= n; k += 4)
        if (!spline.four_points(v, u + k, y + k, value + k, d_u == nullptr ? d_u : d_u + k,
                                d_y == nullptr ? d_y : d_y + k))
          break;
      if (k == n) return;
    }
    double s = (u[k] - v.u0) * v.per_u;
    const double t = (y[k] - v.y0) * v.per_y;
    if (v.period > 0.0 && !(s >= v.branch && s < v.branch + v.period) && s > -kFar && s < kFar) {  // another branch
      s -= v.period * down((s - v.branch) / v.period);
      if (!(s < v.branch + v.period)) s = v.branch;
    }
    double value_k = 0.0, d_s = 0.0, d_t = 0.0;
    if (s > -kFar && s < kFar && t > -kFar && t < kFar) {  // NaN is nowhere
      const int i = down(s + Spline::kShift), j = down(t + Spline::kShift);
      if (i - Spline::kBefore != spline.patch.i || j - Spline::kBefore != spline.patch.j)
        spline.patch.move(v, i - Spline::kBefore, j - Spline::kBefore);
      if (!spline.patch.zero) spline.at(s - i, t - j, value_k, d_s, d_t);
    }
    value[k] = value_k;
    if (d_u != nullptr) d_u[k] = d_s * v.per_u;
    if (d_y != nullptr) d_y[k] = d_t * v.per_y;
  }
}

}  // namespace

TREADMARK_KERNEL(SheetKernel, {nullptr, &sheet_points<Straight>, &sheet_points<Smooth<2>>, &sheet_points<Smooth<3>>});

}  // namespace treadmark::offset
