// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/model/shape/surface_errors.hpp"
#include "treadmark/scans/cleaning/coverage.hpp"
#include "treadmark/scans/fit/band_surface.hpp"
#include "treadmark/scans/fit/damage.hpp"
#include "treadmark/scans/fit/fit_field.hpp"

namespace treadmark::scans {

/// A fit with what it was made of.
struct FitFindings {
  const FittedBand& fitted;
  const BandPoints& points;
  const LocalNoise& noise;
  const FitResult& fit;
  const Coverage& coverage;
  std::span<const Damage> damage;
};

/// Errors that points next to each other share, as the residuals show them.
struct SharedScatter {
  double ratio = 1.0;   ///< of the variance of means of many points to what scatter of each by itself would leave
  double length = 0.0;  ///< over which they are shared [m]; 0: they are not
};
/// By means over blocks of cells, of which the median counts, so that damage does not pull. A ratio that chance may
/// make is 1.
SharedScatter shared_scatter(const BandPoints& points, const LocalNoise& noise, std::span<const float> residual);

/// Adds to draws of halves (half_fit_errors at these stations [m]) what halves of the points have in common: draws grow
/// by what points share; fields say what residuals show that smoothing left out, outside of damage and in each of the
/// largest ones, and how little is known of filled holes: as much as the surface around is off what its surroundings
/// make of places as far apart.
void add_error_sources(const FitFindings& found, const SharedScatter& shared, std::span<const double> stations,
                       SurfaceErrors& errors);

}  // namespace treadmark::scans
