// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/app/import/import_scan.hpp"
#include "treadmark/model/shape/length_unit.hpp"
#include "treadmark/model/shape/point_cloud.hpp"

namespace treadmark::app {

struct Clouds {
  PointCloud cloud;                      ///< of all files, in their unit; passes filled where there are several
  std::optional<LengthUnit> unit;        ///< if the files say it, all the same
  std::optional<LengthUnit> usual_unit;  ///< usual in files of this format, if they do not
  std::string reference;                 ///< coordinate system of the Earth that a file names; empty: none
};

/// Reads all files into one cloud, without points that stand for "no data" (a value like -9999 that many share, far
/// from all others). Fills inputs, points_read and what was not finite into the report.
/// Errors: those of the readers; Error(input_data) for files in different units.
Clouds read_clouds(const ImportRequest& request, io::ImportReport& report, const Progress& progress);

}  // namespace treadmark::app
