// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "treadmark/app/import/find_place.hpp"
#include "treadmark/model/shape/surface_errors.hpp"
#include "treadmark/scans/cleaning/coverage.hpp"
#include "treadmark/scans/fit/band_surface.hpp"

namespace treadmark::app {

/// Everything that a surface file is made from.
struct FittedScan {
  const PlacedScan& scan;
  const scans::FittedBand& fitted;
  const scans::BandPoints& points;
  const scans::Coverage& coverage;
  double noise = 0.0;                                ///< [m]
  const SliceSet* sections = nullptr;                ///< measured ones that are the surface
  std::shared_ptr<const SurfaceErrors> errors = {};  ///< not known where null
};

/// Refuses outputs that mean nothing or cannot hold the surface, before any work. Errors: Error(configuration).
void check_outputs(const ImportRequest& request);

/// Refuses slices and offsets of a surface with holes that stay open. Errors: Error(configuration).
void check_holes(const std::filesystem::path& file, const FittedScan& fit);

/// Writes one surface to `place` that shall become `file`, reads it back and compares it with the fitted one. summary:
/// lines that go into the file. Errors: those of check_holes, writers and CGAL; Error(input_data) for a surface that
/// would not be read again, or lie farther than fit.written_um from the fitted one; Error(configuration) for slices of
/// angles that they cannot hold.
io::ImportReport::Output write_output(const std::filesystem::path& file, const std::filesystem::path& place,
                                      const FittedScan& fit, const io::ImportSettings& settings,
                                      const std::vector<std::string>& summary);

}  // namespace treadmark::app
