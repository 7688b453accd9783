// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/backends/levelset/triangle_distances.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/solid_shape.hpp"

namespace treadmark::levelset {

/// Distances of what bodies make together, on one lattice: that of the first level set, unless another voxel is asked
/// for. Joined is the lesser of two distances, common the greater one, cut the greater one of the first and the other
/// turned inside out (Ricci 1973); edges where bodies meet come out rounded over a voxel. A single body is taken as it
/// is: open triangles of a `body` may face its inside. default_voxel [m]: where neither the shape nor a level set says
/// one. Errors: those of triangles; Error(configuration) for no solids, a first one that is not joined, triangles that
/// are open beside others, a voxel that is not positive, or much smaller than those of a level set; Error(input_data)
/// where the band of a level set is too narrow to be taken over to greater voxels, or lies too far off, or nothing is
/// left.
TriangleDistances distances_of(const SolidShape& shape, double default_voxel, std::optional<Body> body = {});

}  // namespace treadmark::levelset
