// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/app/import/find_place.hpp"
#include "treadmark/model/shape/surface_errors.hpp"
#include "treadmark/scans/cleaning/band_points.hpp"
#include "treadmark/scans/fit/damage.hpp"
#include "treadmark/scans/fit/fit_field.hpp"

namespace treadmark::app {

/// Steps of an import of all points at once that one by tiles has, too.

/// A scan on the section that its points tell.
struct OnSection {
  scans::Projection projection;
  std::optional<std::array<scans::Section, 2>>
      halves;  ///< that halves of the points call for; none where it is nominal
};
/// Sets the section of the placement. finest: of its knots; cells: as ProjectSettings::finest [m].
OnSection on_its_section(PlacedScan& scan, const io::ImportSettings& settings, double finest, double cells,
                         bool halves);

/// Smallest distance of knots [m] for points so far apart [m].
double finest_of(const io::ImportSettings& settings, double spacing);
scans::FitSettings fit_settings(const io::ImportSettings& settings);
/// Depth from which damage is listed [m].
double damage_threshold(const io::ImportSettings& settings, double noise);

/// The station of the band that becomes u = 0, with words for it in the report. Errors: Error(configuration) for
/// settings that say none.
double zero_of(const PlacedScan& scan, const scans::Band& band, const std::vector<scans::Damage>& damage,
               const io::ImportSettings& settings, io::ImportReport& report);
/// Moves the surface's own frame there.
void lay_zero(PlacedScan& scan, double u_zero);

/// Adds to what is known of a surface's errors how it may lie, how well passes agree and what is said of the scanner,
/// and all of it to the report.
std::shared_ptr<const SurfaceErrors> with_sources(SurfaceErrors errors, const PlacedScan& scan,
                                                  const io::ImportSettings& settings, io::ImportReport& report);

/// Lines about the import that the surface file itself carries.
std::vector<std::string> summary_lines(const io::ImportReport& report);

}  // namespace treadmark::app
