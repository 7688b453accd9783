// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/create.hpp"

namespace treadmark {

/// A surface as one tensor B-spline.
struct TensorFit {
  SplineSurface spline;
  double deviation = 0.0;    ///< greatest distance found between its points, normal to the surface [m]
  bool one_section = false;  ///< a rail or wheel of one section: only the coefficients of least u say something
  Sampled sampled;
};

/// Bicubic through points of the surface, as far apart as wanted (without a resolution 1 mm across, 4 mm along) and
/// closer where the spline would lie off by more than the tolerance [m], down to 10 um and up to kMostFitPoints points:
/// what is left says the deviation. given_splines that are no hierarchy stay what they are. wanted: its backend is not
/// looked at. Errors: those
/// of sampling, and Error(input_data) for a surface with gaps.
TensorFit to_tensor_spline(const NaturalSurface& natural, const Representation& wanted, double tolerance);
inline constexpr double kMostFitPoints = 1e6;

}  // namespace treadmark
