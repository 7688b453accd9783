// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/create.hpp"
#include "treadmark/model/tensor_spline.hpp"

namespace treadmark {

/// A surface as one bicubic B-spline.
struct TensorFit {
  TensorSpline spline;
  double deviation = 0.0;    ///< greatest distance found between its points, normal to the surface [m]
  bool one_section = false;  ///< a rail or wheel of one section: only the first poles along u say something
  Sampled sampled;
};

/// Through points of the surface, as far apart as wanted (without a resolution 1 mm across, 4 mm along) and closer
/// where the spline would lie off by more than the tolerance [m], down to 10 um and up to kMostFitPoints points: what
/// is left says the deviation. A surface that is such a spline, of which all is wanted, stays what it is. Errors: those
/// of sampling, and Error(input_data) for a surface with gaps.
TensorFit to_tensor_spline(const NaturalSurface& natural, const Representation& wanted, double tolerance);
inline constexpr double kMostFitPoints = 1e6;

}  // namespace treadmark
