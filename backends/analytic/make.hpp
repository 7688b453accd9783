// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark::analytic {

/// Names of the standard profiles with a published formula: "S1002" (wheel), "60E1" (rail).
std::span<const std::string_view> standard_profile_names();

/// Surface of a standard profile: "60E1" prismatic along x, "S1002" revolved about the axle.
/// nominal_radius [m] is the radius at profile z = 0 and must be positive for a wheel; a rail ignores it and takes no
/// flats. Errors: Error(configuration) for an unknown name, the wrong body, a radius or flat that makes no sense.
std::shared_ptr<const Surface> make_standard_surface(const StandardProfile& profile, Body body, double nominal_radius,
                                                     const std::vector<WheelFlat>& flats = {});

/// Rail: the chain extruded along x, seen from -z; it may be steep or undercut, but must not cross itself.
/// Errors: Error(configuration) for an empty chain or a segment without length.
std::shared_ptr<const Surface> make_prismatic_surface(const ArcChain& chain);

/// Wheel: the chain revolved about the axle. It must be a graph z(y): inclination within +-90 degrees everywhere.
/// Errors: Error(configuration) as above, or if the chain reaches the axle.
std::shared_ptr<const Surface> make_revolved_surface(const ArcChain& chain, double nominal_radius,
                                                     const std::vector<WheelFlat>& flats = {});

/// The unbounded plane z = 0 of the surface frame, facing -z (up) or +z (down).
std::shared_ptr<const Surface> make_plane_surface(Facing facing);

/// Chain of the upper side of a cylinder along x: a circle of the given radius [m] with its crown at the origin,
/// up to inclinations of +-half_angle [rad]. As a rail: make_prismatic_surface(cylinder_chain(R, 1.2)).
ArcChain cylinder_chain(double radius, double half_angle);

/// Chain of a wheel profile that is straight (a cylindrical wheel) for |y| <= half_width [m].
ArcChain straight_chain(double half_width);

/// Chain of a wheel profile that is round with the given meridian radius [m], its lowest point at the origin, up to
/// inclinations of +-half_angle [rad]. With nominal_radius = radius the wheel is a ball.
ArcChain barrel_chain(double meridian_radius, double half_angle);

}  // namespace treadmark::analytic
