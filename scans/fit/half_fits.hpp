// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <span>

#include "treadmark/core/progress.hpp"
#include "treadmark/model/shape/surface_errors.hpp"
#include "treadmark/scans/cleaning/coverage.hpp"
#include "treadmark/scans/fit/band_surface.hpp"
#include "treadmark/scans/fit/damage.hpp"
#include "treadmark/scans/fit/fit_field.hpp"

namespace treadmark::scans {

/// The sections that one half of the points and the other half call for, as refine_section of all of them.
std::array<Section, 2> half_sections(const BandPoints& points, const Band& band, double finest);

/// Stations [m] from the band's a_min where errors of its surface are told: even ones, some in the largest damages, and
/// some in and right beside the largest holes that were filled.
std::vector<double> error_stations(const Band& band, std::span<const Damage> damage, std::span<const Hole> holes = {});

/// Errors of a fitted surface: what it is less what it would be from one half of its points or, at every second
/// station, from the other half. Where the fit is linear that has the covariance of its error (the delete-half
/// jackknife, Shao and Wu 1989), and it also shows details that half of the points would not call for. Halves are drawn
/// point by point: errors that points next to each other share are not seen (error_sources.hpp). sections: those
/// of the halves; null where the section is not from the points. points, noise and settings: those of the fit.
/// nominal_radius: of a wheel [m]. Costs about as much as the fit. Errors: those of fit_field.
SurfaceErrors half_fit_errors(const FittedBand& fitted, const BandPoints& points, const LocalNoise& noise,
                              const FitSettings& settings, const std::array<Section, 2>* sections,
                              std::span<const double> stations, double nominal_radius, const Progress& progress = {});

}  // namespace treadmark::scans
