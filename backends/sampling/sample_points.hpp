// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::sampling {

struct SampleSettings {
  double spacing = 1e-3;   ///< across, along the section [m]
  double spacing_u = 0.0;  ///< along the track or circumference [m]; 0 = spacing
  Region region;
  bool common = false;     ///< only the lateral range that all sections have, unless they move aside
  bool follow = true;      ///< where sections move aside, nodes follow them: each station has its own
  bool staggered = false;  ///< for triangles: equilateral ones, no point of them farther than spacing/2 from a corner
};

/// Samples a surface in its natural view. The points lie exactly on it. Where whole stations have no surface, as on a
/// part of a wheel, the longest run of stations that have one is kept, and it is not closed. Nodes that follow lie at
/// the same shares of the arc length of each section. nominal_radius [m] turns the spacing of a wheel into angles.
/// Parallel; the result does not depend on the number of threads. Errors: Error(configuration) for settings that make
/// no sense, a rail without a range along the track, or more than kMostPoints points; those of lateral_nodes.
PointGrid sample_points(const Surface& surface, Body body, double nominal_radius, const SampleSettings& settings);

inline constexpr double kMostPoints = 5e7;

/// The stations of a region alone; closed says whether they go round the wheel.
std::vector<double> stations(const Surface& surface, Body body, double nominal_radius, const Region& region,
                             double spacing_u, bool& closed);

}  // namespace treadmark::sampling
