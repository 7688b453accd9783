// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>

#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/solid_shape.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::levelset {

/// Triangles, open or closed, as a narrow band of signed distances. voxel [m]: order 3 in it; sheets nearer to each
/// other than some 3 voxels, and edges, come out rounded. backend: what Surface::backend() says. Errors:
/// Error(input_data) for triangles that cannot be used, see distances_of; Error(configuration) for a voxel that is not
/// positive.
std::shared_ptr<const Surface> make_level_set_surface(const TriangleMesh& mesh, Body body, double voxel,
                                                      std::string backend);

/// Bodies put together, or one level set as it is. nominal_radius: of a wheel [m]. Errors: those of the solids
/// (levelset/solids.hpp); Error(input_data) for coordinates that no wheel of that radius or rail has.
std::shared_ptr<const Surface> make_level_set_surface(const SolidShape& shape, Body body, double nominal_radius,
                                                      std::string backend);

}  // namespace treadmark::levelset
