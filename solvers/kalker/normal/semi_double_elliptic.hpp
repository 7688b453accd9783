// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/kalker/normal/hertz.hpp"

namespace treadmark::kalker {

/// Semi-double-elliptic contact (SDEC): two half ellipses with the same semi-axis a along x and different ones, b_minus
/// towards -y and b_plus towards +y, joined at y0 = (b_minus - b_plus)/2 [m], so that the patch fills -b .. b with
/// b = (b_minus + b_plus)/2. Pressure of each half as in a Hertzian contact; both share the greatest one,
/// 1.5 F/(pi a b).
/// Returned: semi-axes a, b, b_minus, b_plus; curvatures and approach are those of the ellipse with semi-axes a and b,
/// which stands for the unknown geometry. Errors: Error(configuration) for values that are not positive.
HertzShape hertz_semi_double_elliptic(double a, double b_minus, double b_plus, const HertzLoad& load,
                                      const CombinedMaterial& material);

bool is_semi_double_elliptic(const HertzShape& shape);

/// Pressure [Pa] at (x, y) [m]; 0 outside. With b_minus = b_plus it is Hertz' pressure.
double semi_double_elliptic_pressure(const HertzShape& shape, double x, double y);

}  // namespace treadmark::kalker
