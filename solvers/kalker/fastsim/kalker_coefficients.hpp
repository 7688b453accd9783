// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::kalker {

/// Coefficients of the linear theory of rolling contact (Kalker 1967): for vanishing creepage
/// F_x = -G c^2 C11 xi, F_y = -G c^2 C22 eta - G c^3 C23 phi with c^2 = a b.
struct KalkerCoefficients {
  double c11 = 0.0, c22 = 0.0, c23 = 0.0;
};

/// Interpolated in Kalker's table (1990, app. E): linear in the ratio of the semi-axes, 1/C quadratic in Poisson's
/// ratio; asymptotic formulas for ratios below 0.101. a is the semi-axis in the rolling direction. Errors:
/// Error(configuration) unless a, b > 0 and 0 <= poisson <= 0.5.
KalkerCoefficients kalker_coefficients(double a, double b, double poisson);

}  // namespace treadmark::kalker
