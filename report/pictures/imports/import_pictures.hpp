// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/io/imports/import_report.hpp"

namespace treadmark::pictures {

/// Pictures of an import, each a whole SVG file of 1000 px width without references to other files. What a report does
/// not have is said in its place. The same report gives the same bytes. Thread-safe.

/// All points in the plane of the section, the nominal and the fitted curve; density of the points over the band.
std::string import_before_svg(const io::ImportReport& report);
/// What was removed: in the plane of the section, by reason, and over the band.
std::string import_removed_svg(const io::ImportReport& report);
/// Distance of the surface from its section with holes and damage, the course through the deepest place, and the
/// section against the nominal profile.
std::string import_fitted_svg(const io::ImportReport& report);
/// Measured less fitted over the band, the noise over the band, and the distribution of the residuals.
std::string import_residual_svg(const io::ImportReport& report);

/// "scan.ply and 2 more, wheel, 1 234 567 points, unit mm (given)".
std::string import_heading(const io::ImportReport& report);

/// The folder of the left rail of a track within that of the right one.
inline constexpr const char* kLeftRail = "left-rail";

/// Writes report.json, times.json, summary.txt, settings.toml, maps.h5 and the pictures before.svg, removed.svg,
/// fitted.svg, residual.svg into a folder, report.json last; of the left rail of a track into a folder in it. Not to be
/// called from two threads at once (HDF5). Errors: Error(configuration) if a file cannot be written.
void write_import_report(const std::string& folder, const io::ImportReport& report);

}  // namespace treadmark::pictures
