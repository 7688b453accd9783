// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/core/grid.hpp"

namespace treadmark::kalker {

/// How far contact goes along and across through the element of the largest pressure.
struct ContactSpan {
  int nx = 0, ny = 0;                ///< elements
  double length = 0.0, width = 0.0;  ///< [m]; where pressures fall off as in an ellipse, finer than whole elements
};

/// Of pressures [Pa] that are not all zero.
ContactSpan contact_span(const Grid2& grid, std::span<const double> pressure);

/// Index of the largest pressure, the first of several.
std::size_t largest_pressure(std::span<const double> pressure);

/// What the largest pressure stands out by above the mean of its neighbours, over itself, along x and y: (2 / n)^2 of
/// an ellipse of n elements across; more where a peak or the edge of contact is narrower than a few elements. 0 along a
/// single element.
struct PeakSharpness {
  double x = 0.0, y = 0.0;
};

PeakSharpness peak_sharpness(const Grid2& grid, std::span<const double> pressure);

}  // namespace treadmark::kalker
