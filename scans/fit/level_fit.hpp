// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/scans/cleaning/band_points.hpp"
#include "treadmark/scans/fit/spline_field.hpp"

namespace treadmark::scans {

/// What a level's functions see of the residuals: sums over the points of w B r (r cut off at four standard
/// deviations), w B^2, and B.
struct FunctionSums {
  std::vector<double> wbr, wbb, points;
};

/// residual: one a point; weight: 1/variance of a point of cell row, column (0 = not used). The level's intervals must
/// be whole numbers of the points' cells. Parallel, the same for any number of threads.
FunctionSums sum_functions(const BandPoints& points, std::span<const float> residual, std::span<const float> weight,
                           const SplineLevel& level);

struct LevelSolution {
  int iterations = 0;
  double reduction = 0.0;  ///< of the residual of the normal equations
};

/// Weighted least squares for the active functions of a level: normal equations by conjugate gradients. ridge: added to
/// the diagonal, one value a function, or empty for a very small one. Sets the coefficients and takes the level's
/// values off the residuals.
LevelSolution fit_level(const BandPoints& points, std::span<float> residual, std::span<const float> weight,
                        std::span<const float> ridge, SplineLevel& level);

}  // namespace treadmark::scans
