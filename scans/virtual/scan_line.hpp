// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "treadmark/scans/virtual/first_look.hpp"
#include "treadmark/scans/virtual/holes.hpp"
#include "treadmark/scans/virtual/scan_pass.hpp"

namespace treadmark::scans::scanner {

/// Where points go that do not lie on the surface.
struct Surroundings {
  Vec3 low_S = Vec3::Zero(), high_S = Vec3::Zero();  ///< box that stray points may be anywhere in
  std::vector<Vec3> blobs_S;                         ///< middles of the dense ones
};
Surroundings surroundings(const FirstLook& part, std::uint64_t seed);

/// What all lines of a pass share.
struct LineJob {
  const Surface& surface;
  const ScannerSettings& settings;
  const Holes& holes;
  const Surroundings& around;
  const Pass& pass;
  std::size_t pass_number = 0;
  Pose X_CS;                        ///< with the error of the pass
  double step = 0.0;                ///< between points along a line [m]
  std::span<const double> raster;   ///< where every station is looked at first
  double longest = 0.0;             ///< piece in which the length of a line is measured
  const Station* common = nullptr;  ///< the station of every line, if they are all the same
};

struct Line {
  std::vector<Vec3> points_C;
  std::size_t on_surface = 0, outliers = 0, lost_holes = 0, lost_drop_outs = 0, lost_occlusion = 0, lost_shadow = 0;
};

/// Where a place of the straight surface lies along the line of the settings.
Vec3 along_line(const ScannerSettings& settings, const Vec3& position_S);

/// The points of one line across the surface at u.
Line scan_line(const LineJob& job, std::size_t line, double u);

}  // namespace treadmark::scans::scanner
