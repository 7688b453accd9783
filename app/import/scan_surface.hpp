// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/model/shape/length_unit.hpp"
#include "treadmark/scans/virtual/virtual_scanner.hpp"

namespace treadmark::app {

struct ScanRequest {
  NamedSurface surface;
  scans::ScannerSettings scanner;  ///< body, nominal radius and range of u come from the surface and from below
  Range range_x, range_theta;      ///< part that is scanned: along the track [m], round the wheel [rad]
  std::filesystem::path line;      ///< file with the [layout] along which a rail lies; empty: straight
  LengthUnit unit = LengthUnit::millimetre;
};

struct Scanned {
  std::filesystem::path surface, cloud;  ///< files
  NamedSurface named;                    ///< as it was asked for
  scans::ScannerSettings settings;       ///< as used
  LengthUnit unit = LengthUnit::millimetre;
  std::filesystem::path line;  ///< file
  scans::VirtualScan scan;
};

/// Scans a wheel or rail (whatever named_surface reads) virtually and writes the points by the extension of the file.
/// Errors: those of named_surface, the scanner and the writer; Error(configuration) for an extension that means nothing
/// and a rail without a range that is needed, before any work.
Scanned scan_surface(const std::filesystem::path& surface, const std::filesystem::path& cloud,
                     const ScanRequest& request, const Progress& progress = {});

/// A few lines for people: how many points, what was lost, where the surface lies in the cloud.
std::string summary(const Scanned& scanned);

/// Everything that is known about the scan, for programs that test what others make of the cloud: docs/scans.md.
std::string truth_json(const Scanned& scanned);

}  // namespace treadmark::app
