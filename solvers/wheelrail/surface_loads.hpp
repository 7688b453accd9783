// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/detection/curved_reference.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::wheelrail {

/// What a patch does to rail and wheel, by virtual work: pressures act on each body's own surface along its own normal,
/// tractions where the rigid slip was taken. A round wheel then feels no moment of pressures about its axle and a rail
/// of one profile no force along it, so that a wheel that rolls on steadily loses to friction what it loses, at any
/// contact angle and yaw (docs/vehicle-simulation.md). With pressures along the normal of the contact plane alone it
/// would lose more or less: over a patch at a flange normals differ by half a radian, and their mean is not the normal
/// of the plane. Both bodies get the force on the rail; that by the wheel's normals differs by what elements leave
/// open. rows: on which the elements lie. heights: of the slip; none: in the contact plane and at the approach.
/// Thread-safe.
SurfaceLoads surface_loads(const Geometry& bodies, const Placement& placement, const MaterialVelocity& material,
                           const PatchSolution& patch, const detection::ReferenceRows& rows,
                           const SlipHeights& heights);

}  // namespace treadmark::wheelrail
