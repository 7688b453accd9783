// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/scans/cleaning/band_points.hpp"
#include "treadmark/scans/cleaning/local_noise.hpp"
#include "treadmark/scans/fit/spline_field.hpp"

namespace treadmark::scans {

struct FitSettings {
  double finest = 0.0;        ///< smallest distance of knots [m]; 0 = 0.5 mm, or as far apart as the points are
  double significance = 1.0;  ///< < 1 follows the points more closely, > 1 smooths more
  bool follow = true;  ///< lowers the significance step by step while points held out are met better (cross-validation)
  double held_out = 0.02;  ///< part of the points that the fit does not see
  /// Of a part of a band: cells along the whole band, by which what is rare is judged; 0: this is all of it.
  std::size_t rows_of_whole = 0;
  std::optional<int> sweeps = {};  ///< that lower the significance, whatever points held out say; for parts alike
};

/// What a fit leaves over.
struct FitLevelReport {
  double knot_a = 0.0, knot_s = 0.0;    ///< [m]
  double significance = 1.0;            ///< at which functions were chosen
  std::size_t functions = 0, used = 0;  ///< of the level; those that stood out of the noise
  int iterations = 0;
};

struct FitResult {
  SplineField field;
  std::vector<FitLevelReport> levels;
  std::vector<float>
      residual;    ///< of every point of the band, outliers and points held out too: measured less fitted [m]
  int sweeps = 0;  ///< that lowered the significance
  std::size_t used = 0, held_out = 0;
  double residual_rms = 0.0;    ///< of the points that were fitted [m]
  double held_out_rms = 0.0;    ///< of those that were not: noise and error of the fit together [m]
  double held_out_error = 0.0;  ///< what is left of that without the noise: an estimate of the error of the fit [m]
};

/// The smoothest surface that the noise allows: tensor splines from coarse to fine, along and across the band
/// independently; a finer function is used only where the residuals of the coarser ones stand out of the noise, alone
/// or together with those around it (as wavelet coefficients are kept or dropped; Donoho and Johnstone 1994). Marks the
/// points held out in points.state: which ones depends on their numbers only. Deterministic for any number of
/// threads. Errors: Error(numerical) when stopped.
FitResult fit_field(BandPoints& points, const Band& band, const LocalNoise& noise, const FitSettings& settings,
                    const Progress& progress = {});

}  // namespace treadmark::scans
