// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::app {

/// What was read of one file: points of one section, or a surface.
struct ReadMeasured {
  std::string kind;
  std::optional<Profile> points;
  std::shared_ptr<const Surface> surface;
  double nominal_radius = 0.0;        ///< [m] 0: unknown
  bool placed = false;                ///< it lies in the axes of its nominal section
  std::optional<double> flange_back;  ///< y in the points of a wheel, where they show it [m]
  bool doubtful = false;              ///< among the notes are doubts about what the points mean
  std::optional<double> error;        ///< of a fitted surface [m]; NaN: unknown; nothing: its points tell
  double point_noise = 0.0;           ///< of a scan's points [m]
  double point_distance = 0.0;        ///< between them [m]
  double x_min = 0.0, x_max = 0.0;    ///< of a rail's surface [m]
  std::vector<std::pair<std::string, std::string>> said;
  std::vector<std::string> notes;
};

/// Reads whatever can be measured. Errors: see measure_file.
ReadMeasured read_measured(const std::string& name, const MeasureRequest& request);

/// The profile of a wheel of the other side, mirrored. Errors: those of the reader.
measures::Section mirrored_section(const std::string& name, const MeasureRequest& request);

/// Whether the file holds points of a scanner, by its extension (.ply and others that may hold triangles do not count).
bool is_only_scan(const std::string& name);
/// Imports a scan with the settings of `treadmark import`. Errors: those of the import; Error(configuration) in a build
/// without scans.
ReadMeasured read_scanned(const std::string& name, const MeasureRequest& request);

/// A nominal section by its name in the profile library, or of a file. Errors: those of the readers.
measures::Section nominal_section(const std::string& name, Body body);

}  // namespace treadmark::app
