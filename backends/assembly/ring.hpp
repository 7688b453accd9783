// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/slices.hpp"
#include "treadmark/model/shape/surface_spec.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::assembly {

/// A ring that a wheel runs in: a roller of negative nominal radius R [m]. The profile z(y) is turned about an axle
/// parallel to y at z = R, material outside: z(x, y) = R + sqrt((|R| + z(y))^2 - x^2) below the axle. Of it the part is
/// there that lies within kRingReach of the least radius to either side of the bottom, far more than a wheel can touch.
inline constexpr double kRingReach = 0.6;

/// Half length of that part [m]. least_z: of the profile [m].
/// Errors: Error(configuration) for a radius that is not negative and finite, or a profile that reaches the axle.
double ring_half_length(double radius, double least_z);

/// The ring of a chain of arcs, exact up to rounding: the straight rail with an offset added to its z. backend() is
/// "analytic". Thread-safe as every Surface. Errors: as above; Error(configuration) for a chain that is vertical or
/// turns back somewhere.
std::shared_ptr<const Surface> make_ring_surface(const ArcChain& chain, double radius);

/// Sections x = const of the ring of a profile, so close that splines through them keep to the circles within 1e-8 of
/// the radius. Errors: as above.
SliceSet ring_slices(const Profile& profile, double radius);

/// Triangles of a whole ring without those that lie above the axle, which would hide the others.
/// Errors: Error(configuration) if nothing is left.
TriangleMesh lower_part(const TriangleMesh& ring, double radius);

}  // namespace treadmark::assembly
