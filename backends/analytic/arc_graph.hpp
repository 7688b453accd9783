// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>

namespace treadmark::analytic {

/// Value and derivatives of a curve h(x).
struct Jet {
  double h = 0.0, dh = 0.0, ddh = 0.0;
};

/// A circular arc (or, with k = 0, a line) as the graph h(x) over [x_min, x_max]. It starts from any of its points
/// (x0, h0) with direction (c0, s0) and turns with curvature k; c0 < 0 where it is traversed towards -x.
/// Since the sine of the direction is linear in x, s = s0 + k (x - x0), the height is
/// h = h0 + (x - x0) (s + s0)/(c + c0): free of cancellation for any radius, and exact for lines.
struct ArcGraph {
  double x_min = 0.0, x_max = 0.0;
  double x0 = 0.0, h0 = 0.0;
  double s0 = 0.0, c0 = 1.0;
  double k = 0.0;

  double sine(double x) const { return s0 + k * (x - x0); }
  double cosine(double s) const { return std::copysign(std::sqrt(std::max(0.0, (1.0 - s) * (1.0 + s))), c0); }

  double height(double x) const {
    const double s = sine(x), c = cosine(s);
    return h0 + (x - x0) * (s + s0) / (c + c0);
  }
  double height_and_slope(double x, double& slope) const {
    const double s = sine(x), c = cosine(s);
    slope = s / c;
    return h0 + (x - x0) * (s + s0) / (c + c0);
  }
  Jet jet(double x) const {
    const double s = sine(x), c = cosine(s);
    return {h0 + (x - x0) * (s + s0) / (c + c0), s / c, k / (c * c * c)};
  }

  /// Least and greatest height over [a, b], which must lie in [x_min, x_max].
  void range(double a, double b, double& low, double& high) const {
    const double ha = height(a), hb = height(b);
    low = std::min(ha, hb);
    high = std::max(ha, hb);
    if (k == 0.0) return;
    const double apex = x0 - s0 / k;
    if (apex <= a || apex >= b) return;
    const double h = height(apex);
    low = std::min(low, h);
    high = std::max(high, h);
  }
};

}  // namespace treadmark::analytic
