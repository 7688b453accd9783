// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/core/surface.hpp"
#include "treadmark/detection/gap_field.hpp"

namespace treadmark::detection {

/// Heights of a variable rail [m] over the elements of a potential contact area as CONTACT has them: in the section at
/// every x natural cubics through the points at which the slices' data lie. NaN beyond the outermost of these. Returns
/// false, with heights that mean nothing, for a rail whose data are not known.
bool section_heights(const BodyPair& bodies, const Pose& X_TC, const Grid2& grid_C, std::span<double> rail_n);

/// Heights of the rail [m] in such sections, where the bodies ask for them and there are some; else of its surface.
void rail_heights(const BodyPair& bodies, const Pose& X_TC, const Grid2& grid_C, std::span<double> rail_n);

/// Angle in the wheel's own frame [rad] of the line of a round wheel that is lowest in T, yaw and roll being small:
/// pitch taken back.
double lowest_angle(const Pose& X_TW);

/// Lateral range [m].
struct LateralInterval {
  double low = 0.0, high = 0.0;
};

/// Lateral positions in the wheel's frame, increasing, at which CONTACT puts the corners of its meshes [m]: where the
/// data of the wheel's surface lie if it tells, in equal steps of at most 0.5 mm otherwise. angle: of the section
/// that tells y over v [rad].
std::vector<double> mesh_lines(const Surface& wheel, double angle);
/// Those over a part of the wheel, with at least as many more on either side as there are, up to `beside`.
std::vector<double> mesh_lines(const Surface& wheel, double angle, const LateralInterval& y, int beside);

/// Radii of a wheel over its mesh_lines(), and their slopes; NaN where it has none. Immutable.
struct ProfileLines {
  std::vector<double> y, radius, slope;
};
/// Of the section at an angle [rad].
ProfileLines profile_lines(const Surface& wheel, double angle);

/// Radius over lateral positions of the section at an angle [m]; NaN where the wheel is missing.
std::vector<double> section_radius(const Surface& wheel, double angle, std::span<const double> y);

/// Lateral positions [m] at which the data of a surface lie on the line x of a plane P, increasing; where the surface
/// can be seen. Empty if the surface was not made from data, or does not tell.
std::vector<double> lateral_nodes(const Surface& surface, const Pose& X_SP, double x_P, const LateralInterval& y_P);

}  // namespace treadmark::detection
