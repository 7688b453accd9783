// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/length_unit.hpp"
#include "treadmark/model/shape/point_cloud.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::scans {

/// What the virtual scanner does to the truth. Lengths in m, angles in rad.
struct ScannerSettings {
  Body body = Body::rail;
  double nominal_radius = 0.0;  ///< wheel: sets how far apart lines are along the circumference
  /// Scanned part: u is x of a rail, theta of a wheel; the whole wheel by default, a rail without ends needs a range.
  double u_min = -std::numeric_limits<double>::infinity(), u_max = std::numeric_limits<double>::infinity();
  double y_min = -std::numeric_limits<double>::infinity(), y_max = std::numeric_limits<double>::infinity();
  std::size_t points = 1'000'000;  ///< wanted on the surface by all passes together, before anything is lost; evenly
                                   ///< spread over its area
  double spacing = 0.0;            ///< between points of a pass, instead of their number
  double noise = 0.0;              ///< standard deviation along the beam
  double noise_lateral = 0.0;      ///< standard deviation across the beam, each direction
  double outliers = 0.0;    ///< part of all points that is spoilt: half of them up to +-5 mm off along the beam, a
                            ///< quarter anywhere in the surroundings, a quarter in a few dense blobs beside the surface
  double holes = 0.0;       ///< part of the area without points: elliptic holes of hole_size
  double hole_size = 4e-3;  ///< mean diameter of the holes
  double drop_outs = 0.0;   ///< part of the points lost one by one and in short runs of a line
  double most_incidence = 0.0;  ///< beams at a greater angle to the surface's normal see nothing; without stands they
                                ///< count as along +z (rail) or towards the axle (wheel); 0 = everything is seen
  int passes = 1;  ///< overlapping by a quarter; a rail's lie beside each other, a wheel's behind each other; with
                   ///< stands 1
  double registration = 0.0;  ///< standard deviation of each pass's position error in each axis; its angular error
                              ///< moves the ends of the pass by as much
  bool random_frame = false;  ///< any position within 1 m and any orientation, from the seed
  Pose X_CS;                  ///< pose of the surface in the frame of the cloud, where random_frame is false
  /// Where the scanner stands, in the frame of the surface [m]: a pass over all of the part from each place, without
  /// what lies in its shadow. Empty: beams meet the surface along its normal, and nothing hides anything.
  std::vector<Vec3> stands;
  /// Rail: the line along which it lies, as the pose, in the frame of the surface, of the section at a place along it
  /// [m]; empty: straight, x along it. Must be smooth and have the slope 1; called from several threads.
  std::function<Pose(double)> line;
  std::uint64_t seed = 1;
};

/// The part of the surface that one pass covered: u as in the settings (that of a closed wheel may go on beyond the end
/// of the range).
struct ScannerPass {
  double u_min = 0.0, u_max = 0.0, y_min = 0.0, y_max = 0.0;
  Vec3 middle_C = Vec3::Zero();       ///< about which its registration error turns, frame of the cloud [m]
  std::size_t lines = 0, points = 0;  ///< points: in the cloud
};

/// What is known about a virtual scan. Points seen on the surface = on_surface + outliers + all that were lost; each is
/// lost for one reason, the first of: occlusion (too steep), shadow, hole, drop-out.
struct ScannerTruth {
  Pose X_CS;                 ///< pose of the surface frame in the cloud's; along a line that of the line's frame
  std::vector<Pose> X_pass;  ///< registration error of each pass: p = X_pass.apply(where p should be), both in the
                             ///< frame of the cloud; a rotation about the middle of the pass and a shift
  std::vector<ScannerPass> passes;
  double spacing = 0.0;                      ///< [m]
  std::size_t on_surface = 0, outliers = 0;  ///< in the cloud; on_surface: but for noise and registration
  std::size_t lost_holes = 0, lost_drop_outs = 0, lost_occlusion = 0, lost_shadow = 0;
  double area = 0.0;  ///< scanned, overlaps counted once [m^2]
};

struct VirtualScan {
  PointCloud cloud;  ///< [m] in the cloud's frame, line after line, pass after pass; passes filled if > 1
  ScannerTruth truth;
};

/// Scans any surface in lines across it. The same settings give the same points for any number of threads.
/// Errors: Error(configuration) for settings that make no sense, a rail without a range along the track, more than 2e8
/// points, a scanner that stands in a hollow of the surface, or nothing to scan; Error(numerical) when stopped.
VirtualScan scan_surface(const Surface& surface, const ScannerSettings& settings, const Progress& progress = {});

}  // namespace treadmark::scans
