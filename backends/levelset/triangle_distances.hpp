// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/backends/levelset/distance_field.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/solid_shape.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::levelset {

struct TriangleDistances {
  DistanceGrid grid;
  RimBlocks rim;  ///< empty: the triangles are closed
  bool closed = true;
};

/// Distances from triangles in a band of half width kHalfWidth. OpenVDB finds the nearest triangle of each node (Museth
/// 2013); the distance from it is taken in double precision, its sign by the mean normal of the face, edge or corner
/// that is nearest (Baerentzen and Aanaes 2005). Where neighbouring triangles turn by less than the crease angle they
/// stand for a smooth surface: its height over the triangle follows from the normals at the corners, so the distances
/// are of order 3 in the size of the triangles. Beyond a rim the surface goes on straight, and the rim's own distance
/// says that it is not there. Triangles must agree with each other; closed ones that face their inside are turned,
/// and open ones of a body that face its inside.
/// Errors: Error(input_data) for an empty mesh, corners that are not finite or out of range, edges of more than two
/// triangles, triangles that do not agree, and a mesh of more than 2^24 voxels along an axis; Error(configuration) for
/// one that is too large for voxels so small.
TriangleDistances distances_of(const TriangleMesh& mesh, double voxel, std::optional<Body> body = {});

/// Of the band about triangles [voxels]: what splines and their coefficients need about each cell with a zero.
inline constexpr double kHalfWidth = 3.5;

}  // namespace treadmark::levelset
