// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::bench {

/// Operations that do not wait for each other, as wide as the kernels of the library are, on raw numbers only (see
/// core/kernel.hpp): each of kNumbers numbers x becomes a x + b, c / x or sqrt(x), so many times.
struct Ceilings {
  static constexpr int kNumbers = 48;
  void (*multiply_add)(double* x, double a, double b, long times);
  void (*divide)(double* x, double c, long times);
  void (*root)(double* x, long times);

  static const Ceilings generic;
  static const Ceilings* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::bench
