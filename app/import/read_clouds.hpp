// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "treadmark/app/import/import_scan.hpp"
#include "treadmark/model/length_unit.hpp"
#include "treadmark/model/point_cloud.hpp"

namespace treadmark::app {

struct Clouds {
  PointCloud cloud;                ///< of all files, in their unit; passes filled where there are several
  std::optional<LengthUnit> unit;  ///< if the files say it, all the same
};

/// Reads all files into one cloud. Fills inputs, points_read and what was not finite into the report.
/// Errors: those of the readers; Error(input_data) for files in different units.
Clouds read_clouds(const ImportRequest& request, io::ImportReport& report, const Progress& progress);

}  // namespace treadmark::app
