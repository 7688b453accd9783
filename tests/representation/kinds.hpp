// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "treadmark/backends/create.hpp"

namespace treadmark::testing {

constexpr double kWheelRadius = 0.46;  ///< [m]

/// One way of giving a wheel or rail, with or without damage: standard profile, arcs, points, slices or triangles.
struct Kind {
  std::string name;  ///< for example "wheel_slices_flat"
  SurfaceSpec spec;
  std::string natural;  ///< the backend it is natural to
  SurfaceSpec formula;  ///< the same shape as a formula with the same defects
  Region region;        ///< what the tests sample: it holds the defect, and lies inside of slices and triangles
};

/// All of them. Slices and triangles are made from the formula and reach a little beyond the region.
std::vector<Kind> kinds();
std::ostream& operator<<(std::ostream& out, const Kind& kind);

SurfaceSpec s1002(Defects defects = {});
SurfaceSpec rail_60e1(Defects defects = {});
Defects one_flat();
Defects one_polygonization();
Defects one_squat();

/// Greatest and rms distance along the reference's normals at n points spread evenly (not on any grid) over a region,
/// and the greatest angle between the normals; points within `margin` [m] of the lateral ends of the reference are left
/// out. Seen along z (rail), along the radius or along lines that pass the axle at the distance `aside` [m] (wheel).
struct Distance {
  int points = 0, missing = 0;
  double max = 0.0, rms = 0.0, slope = 0.0;
};
Distance distance(const Surface& reference, const Surface& candidate, Body body, const Region& region, int n,
                  double margin = 1e-3, double aside = 0.0);

}  // namespace treadmark::testing
