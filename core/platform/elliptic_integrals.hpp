// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <version>

#include "treadmark/core/constants.hpp"

namespace treadmark::platform {

/// Complete elliptic integrals of the first and second kind by arithmetic and geometric means (Gauss; Abramowitz and
/// Stegun 1964, 17.6). k: modulus, at most 1.
struct EllipticIntegrals {
  double first, second;
  explicit EllipticIntegrals(double k) {
    double a = 1.0, b = std::sqrt((1.0 - k) * (1.0 + k)), c = k, weight = 0.5, sum = weight * k * k;
    // Below this the next c, about c^2 / 4, adds nothing.
    while (std::abs(c) > 1e-9 && b > 0.0) {
      c = 0.5 * (a - b);
      b = std::sqrt(a * b);
      a -= c;
      weight *= 2.0;
      sum += weight * c * c;
    }
    first = b > 0.0 ? kPi / (2.0 * a) : kNaN;
    second = b > 0.0 ? first * (1.0 - sum) : std::abs(k) == 1.0 ? 1.0 : kNaN;
  }
};
inline double comp_ellint_1(double k) { return EllipticIntegrals(k).first; }
inline double comp_ellint_2(double k) { return EllipticIntegrals(k).second; }

}  // namespace treadmark::platform

namespace treadmark {
#if defined(__cpp_lib_math_special_functions)
using std::comp_ellint_1;
using std::comp_ellint_2;
#else
using platform::comp_ellint_1;
using platform::comp_ellint_2;
#endif
}  // namespace treadmark
