// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/scans/cleaning/band_points.hpp"

namespace treadmark::scans {

/// How one pass of the scanner lies off the others.
struct PassStep {
  std::uint16_t pass = 0;
  std::size_t points = 0;
  std::size_t shared = 0;  ///< cells that it shares with other passes
  Vec3 shift_S =
      Vec3::Zero();  ///< rigid motion that brings its points to the others, about its middle [m], surface frame
  Vec3 turn_S = Vec3::Zero();  ///< small rotation vector [rad]
  Vec3 middle_S = Vec3::Zero();
};

struct PassSteps {
  std::vector<PassStep> passes;
  double before = 0.0, after = 0.0;  ///< rms distance between passes where they overlap [m]
  double unexplained = 0.0;          ///< what scatter of the points leaves of the latter: how well passes agree [m]
};

/// Rigid motions of the passes that make them agree where they overlap: least squares on medians of distances from the
/// section in cells that two passes or more have seen. Motions that the overlaps do not determine stay zero. passes:
/// one number a point of the cloud. Empty for one pass. Errors: none; passes without overlap are left as they are.
PassSteps find_pass_steps(const BandPoints& points, const Band& band, std::span<const std::uint16_t> passes);

/// Moves the points of the cloud ([m], its frame X_CS) accordingly.
void apply(const PassSteps& steps, std::span<const std::uint16_t> passes, const Pose& X_CS, std::span<Vec3> points);

}  // namespace treadmark::scans
