// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/import/find_place.hpp"
#include "treadmark/scans/cleaning/coverage.hpp"
#include "treadmark/scans/cleaning/local_noise.hpp"
#include "treadmark/scans/fit/band_surface.hpp"
#include "treadmark/scans/fit/damage.hpp"
#include "treadmark/scans/fit/fit_field.hpp"
#include "treadmark/scans/sections/find_sections.hpp"

namespace treadmark::app {

/// What the steps of an import have found, put into the report: numbers, maps and points for pictures.
struct ImportFindings {
  const PlacedScan& scan;
  const scans::Projection& projection;
  const scans::LocalNoise& noise;
  const scans::Coverage& coverage;
  const scans::FitResult& fit;
  const scans::FittedBand& fitted;
  const std::vector<scans::Damage>& damage;
  const scans::MeasuredSections* sections = nullptr;  ///< that were kept
};
void fill_report(const ImportFindings& found, io::ImportReport& report);

/// How well the surface is known everywhere, by its errors.
void fill_error_map(const ImportFindings& found, const SurfaceErrors& errors, io::ImportReport& report);

/// The part of it that only the place tells.
void fill_placement(const PlacedScan& scan, io::ImportReport& report);

/// Mean, root mean square and so on of signed distances; all 0 for none.
io::ImportReport::Distances distances_of(std::vector<float> values);

}  // namespace treadmark::app
