// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>

namespace treadmark::kalker {

/// One length n of complex transforms as the passes that they are made of, one a factor of n (4 rather than 2 times 2).
struct FftPasses {
  static constexpr int kMost = 31;  ///< of an int
  int n = 1, count = 0;
  int radix[kMost] = {};
  /// Of each pass, for which `left` of n is left: exp(-2 pi i q c / left), c = 1 ... radix - 1 for each q < left /
  /// radix.
  const double* turns[kMost] = {};
  const double* roots[kMost] = {};  ///< exp(-2 pi i k / radix), k = 0 ... radix - 1
};

/// Transforms of four lines at a time, each in its lane (Stockham's order, so that no bits are reversed). Complex
/// numbers are pairs of doubles. Of `count` lines, 1 to 4, each from from[i] to to[i], which may be the same;
/// unnormalised. work: kWork (n + 1) doubles at a cache line.
struct FftLines {
  static constexpr std::size_t kWork = 16;

  /// Lines of n numbers that lie one after the other.
  void (*lines)(const FftPasses& passes, int count, const double* const* from, double* const* to, bool inverse,
                double* work);
  /// The same, in place, for neighbouring columns: `at` is the first number, stride [doubles] leads to the next one.
  void (*columns)(const FftPasses& passes, int count, double* at, std::ptrdiff_t stride, bool inverse, double* work);
  /// Lines of 2 n real numbers to n + 1 complex ones, and back; turns: exp(-2 pi i k / (2 n)), k = 0 ... n.
  void (*real_forward)(const FftPasses& passes, const double* turns, int count, const double* const* from,
                       double* const* to, double* work);
  void (*real_inverse)(const FftPasses& passes, const double* turns, int count, const double* const* from,
                       double* const* to, double* work);

  static const FftLines generic;
  static const FftLines* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::kalker
