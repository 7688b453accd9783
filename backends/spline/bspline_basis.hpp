// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <span>
#include <vector>

namespace treadmark::spline {

/// powers[b][k]: coefficient of t^k, t = x - knots[span], of the b-th of the four cubic B-splines that do not vanish on
/// [knots[span], knots[span + 1]); these are the B-splines span - 3 .. span (de Boor 1978).
using BasisPowers = std::array<std::array<double, 4>, 4>;

/// knots: non-decreasing, knots[span] < knots[span + 1], three knots on both sides of the span.
BasisPowers basis_powers(std::span<const double> knots, int span);

/// Index of the span that holds x, clamped to [first, last].
int find_span(std::span<const double> knots, double x, int first, int last);

/// The positions as single knots, continued at both ends by three knots with the spacing of the first and last
/// interval.
std::vector<double> extended_knots(std::span<const double> positions);

/// Value of a polynomial basis row at t.
double power_value(const std::array<double, 4>& powers, double t);

}  // namespace treadmark::spline
