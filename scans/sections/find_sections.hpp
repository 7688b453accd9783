// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/model/shape/slices.hpp"

namespace treadmark::scans {

/// Points of a cloud that lie in cross-sections of a wheel or rail, as profile gauges on a turntable or a trolley
/// measure them.
struct MeasuredSections {
  std::vector<double> u;  ///< increasing: (-pi, pi] round a wheel, [m] along a rail; as X_CS counts
  std::vector<std::vector<std::uint32_t>> points;  ///< of each section, from one end to the other as a profile runs
  double spread = 0.0;                             ///< farthest that a point lies from its section, along the band [m]
  double least_gap = 0.0,
         widest_gap = 0.0;  ///< between sections [m]; a wheel's opening is none if it is closed by one gap
  bool regular = false;     ///< all sections have points at the same places across: somebody resampled them
};

/// Finds cross-sections whatever the order of the points is: their stations fall into groups that are at least 20 times
/// as far apart as their points are; at least 4 groups of at least 8 points, that run through from one end to the
/// other. None: the points are not (all) in sections. points: [m] in the cloud's frame; keep: flags or empty; radius:
/// nominal, of a wheel.
std::optional<MeasuredSections> find_sections(std::span<const Vec3> points, std::span<const std::uint8_t> keep,
                                              const Pose& X_CS, Body body, double radius);

/// The sections as slices with their own points. u and X_CS count from the same zero. nominal_radius: of a wheel [m].
SliceSet sections_to_slices(const MeasuredSections& sections, std::span<const Vec3> points, const Pose& X_CS, Body body,
                            double nominal_radius, bool approximate_u, const std::string& name);

}  // namespace treadmark::scans
