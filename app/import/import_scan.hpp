// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/io/imports/import_settings.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::app {

struct ImportRequest {
  std::vector<std::filesystem::path> scans;  ///< several files are several passes; or one gridded map of deviations
  std::vector<std::filesystem::path>
      outputs;  ///< .slcs .slcw (spline), .ply .stl .obj .off (mesh), .vdb .nvdb (offset)
  io::ImportSettings settings;
  std::filesystem::path truth;  ///< what `treadmark scan --truth` wrote, or the true surface; empty: not known
};

/// From the points of a scanner to surfaces: reads, removes what does not belong to the wheel or rail, places, aligns
/// passes, cleans, fits, writes, and keeps account of all of it. The same input and settings give the same files for
/// any number of threads. Errors: those of the readers, of placement and fit, naming the file; Error(configuration) for
/// outputs that cannot hold the surface; Error(numerical) when stopped between steps, Cancelled (core/cancellation.hpp)
/// within one. Nothing is written then. The surface is compared with a reference that is given; one that does not
/// fit is refused before the work. Of both rails of a track (scan.rails) the report is that of the right one, with the
/// track and the left one's report; outputs are NAME-left and NAME-right.
io::ImportReport import_scan(const ImportRequest& request, const Progress& progress = {});

/// Refuses settings that would be ignored because they belong to the other body or to another choice.
/// Errors: Error(configuration) that names the setting.
void check_settings(const io::ImportSettings& settings, Body body);

}  // namespace treadmark::app
