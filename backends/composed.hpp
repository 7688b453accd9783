// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/create.hpp"

namespace treadmark {

/// What create.hpp promises for surfaces that are made of others: rollers, which are wheels turned over, and bodies of several
/// surfaces. natural is such a surface.

NaturalSurface create_roller(SurfaceSpec spec);
RepresentedSurface represent_roller(const NaturalSurface& natural, const Representation& wanted);
RepresentedSurface represent_parts(const NaturalSurface& natural, const Representation& wanted);
SurfaceDifference roller_fit_error(const NaturalSurface& natural, const RepresentedSurface& represented);
TriangleMesh roller_triangles(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled);
SliceSet roller_slices(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled);

}  // namespace treadmark
