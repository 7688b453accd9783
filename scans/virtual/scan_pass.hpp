// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/scans/virtual/first_look.hpp"
#include "treadmark/scans/virtual/virtual_scanner.hpp"

namespace treadmark::scans::scanner {

/// One pass over a part of the surface.
struct Pass {
  double u_min = 0.0, u_max = 0.0, y_min = 0.0, y_max = 0.0;
  Vec3 middle_S = Vec3::Zero();
  Pose error_S;                           ///< takes points to where the pass puts them, in the frame of the surface
  double area = 0.0, nominal_area = 0.0;  ///< [m^2] as those of patches
  std::optional<Vec3> stand_S{};          ///< from where it is scanned
};

/// The passes of a scan, from a place each or with their overlap of a quarter, and their errors of position.
std::vector<Pass> plan_passes(const FirstLook& part, const ScannerSettings& settings);

}  // namespace treadmark::scans::scanner
