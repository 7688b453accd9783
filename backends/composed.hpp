// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/create.hpp"

namespace treadmark {

/// What create.hpp promises for surfaces that are made of others: rollers, which are wheels turned over, rings, which
/// are rails bent upwards, and bodies of several surfaces. natural is such a surface.

NaturalSurface create_roller(SurfaceSpec spec);
NaturalSurface create_ring(SurfaceSpec spec);
/// Whether the wheel runs inside.
bool is_ring(const NaturalSurface& natural);
/// The ring as a rail that changes along the track, of unknown origin: sampled from its surface.
NaturalSurface rail_of_ring(const NaturalSurface& ring);
RepresentedSurface represent_ring(const NaturalSurface& natural, const Representation& wanted);
RepresentedSurface represent_roller(const NaturalSurface& natural, const Representation& wanted);
RepresentedSurface represent_parts(const NaturalSurface& natural, const Representation& wanted);
SurfaceDifference roller_fit_error(const NaturalSurface& natural, const RepresentedSurface& represented);
TriangleMesh roller_triangles(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled);
SliceSet roller_slices(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled);

}  // namespace treadmark
