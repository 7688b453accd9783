// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/scans/virtual/station.hpp"
#include "treadmark/scans/virtual/virtual_scanner.hpp"

namespace treadmark::scans::scanner {

/// A small piece of the scanned surface.
struct Patch {
  double u = 0.0, y = 0.0;
  double length = 0.0;  ///< along the station [m]
  double area = 0.0;    ///< [m^2]
  double nominal_area =
      0.0;  ///< arc length times distance of the lines, which for a wheel is that at the nominal radius [m^2]
  Vec3 position_S = Vec3::Zero(), normal_S = Vec3::Zero();
};

/// What is known before the scan: the part that is scanned, its area, and evenly spread patches of it.
struct FirstLook {
  double u_min = 0.0, u_max = 0.0, y_min = 0.0, y_max = 0.0;
  bool closed = false;         ///< a whole wheel
  double metres_per_u = 1.0;   ///< at the nominal radius
  double area = 0.0;           ///< [m^2]
  std::vector<Patch> patches;  ///< station after station
  Station reference;           ///< a station in the middle that has a surface
  std::vector<double> spread;  ///< stations all over the part, to find steep places
};

/// Errors: Error(configuration) for a rail or a width without ends, a range that makes no sense or has no surface.
FirstLook look(const Surface& surface, const ScannerSettings& settings, const Progress& progress);

}  // namespace treadmark::scans::scanner
