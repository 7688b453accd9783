// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "treadmark/core/platform/bit_cast.hpp"

namespace treadmark::analytic {

/// Angles [rad] for which fast_sin_cos is as good as the standard functions, to about 1e-16.
inline constexpr double kFastTrigRange = 1e5;

/// Sine and cosine without branches, so that loops over it are vectorised: reduction to |r| <= pi/4 by pi/2 in three
/// parts (Cody and Waite 1980), then Taylor's series, whose next terms are below 5e-17.
inline void fast_sin_cos(double x, double& sine, double& cosine) {
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it leaves the nearest integer in the low bits
  constexpr double kTwoOverPi = 0.63661977236758134308;
  constexpr double kHalfPi1 = 1.57079632673412561417, kHalfPi2 = 6.07710050630396597660e-11,
                   kHalfPi3 = 2.02226624879595063154e-21;
  const double shifted = x * kTwoOverPi + kRound, n = shifted - kRound;
  const auto quadrant = bit_cast<std::uint64_t>(shifted);
  const double r = ((x - n * kHalfPi1) - n * kHalfPi2) - n * kHalfPi3, w = r * r;
  const double s =
      r + r * w *
              (-1.0 / 6.0 +
               w * (1.0 / 120.0 +
                    w * (-1.0 / 5040.0 +
                         w * (1.0 / 362880.0 +
                              w * (-1.0 / 39916800.0 + w * (1.0 / 6227020800.0 - w * (1.0 / 1307674368000.0)))))));
  const double c =
      1.0 +
      w * (-0.5 + w * (1.0 / 24.0 +
                       w * (-1.0 / 720.0 +
                            w * (1.0 / 40320.0 + w * (-1.0 / 3628800.0 +
                                                      w * (1.0 / 479001600.0 + w * (-1.0 / 87178291200.0 +
                                                                                    w * (1.0 / 20922789888000.0))))))));
  const auto s_bits = bit_cast<std::uint64_t>(s), c_bits = bit_cast<std::uint64_t>(c);
  const std::uint64_t swap = (s_bits ^ c_bits) & (0 - (quadrant & 1));
  sine = bit_cast<double>((s_bits ^ swap) ^ ((quadrant & 2) << 62));
  cosine = bit_cast<double>((c_bits ^ swap) ^ (((quadrant + 1) & 2) << 62));
}

/// The same for n angles, which must not overlap the results. Any angles will do.
inline void sin_cos_many(const double* angle, std::size_t n, double* __restrict sine, double* __restrict cosine) {
  bool all = true;
  for (std::size_t i = 0; i < n; ++i) all &= std::fabs(angle[i]) <= kFastTrigRange;
  if (all) {
    for (std::size_t i = 0; i < n; ++i) {
      double s, c;
      fast_sin_cos(angle[i], s, c);
      sine[i] = s, cosine[i] = c;
    }
  } else {
    for (std::size_t i = 0; i < n; ++i) sine[i] = std::sin(angle[i]), cosine[i] = std::cos(angle[i]);
  }
}

}  // namespace treadmark::analytic
