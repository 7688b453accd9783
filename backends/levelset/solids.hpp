// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/levelset/triangle_distances.hpp"
#include "treadmark/model/shape/solid_shape.hpp"

namespace treadmark::levelset {

/// Distances of what bodies make together, on one lattice: that of the first level set, unless another voxel is asked
/// for. Joined is the lesser of two distances, common the greater one, cut the greater one of the first and the other
/// turned inside out (Ricci 1973); edges where bodies meet come out rounded over a voxel. A single body is taken as it
/// is. default_voxel [m]: where neither the shape nor a level set says one. Errors: Error(configuration) for no solids,
/// a first one that is not joined, triangles that are open beside others, or a voxel that is not positive;
/// Error(input_data) where the band of a level set is too narrow to be taken over to greater voxels, or nothing is
/// left.
TriangleDistances distances_of(const SolidShape& shape, double default_voxel);

}  // namespace treadmark::levelset
