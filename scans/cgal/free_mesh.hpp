// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>

#include "treadmark/core/pose.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::scans {

struct FreeMeshSettings {
  double spacing = 0.0;         ///< points are thinned to this [unit of the points]; 0 = twice the median spacing
  int smoothing_rounds = 1;     ///< of edge-preserving bilateral smoothing (Huang et al. 2013); 0 = none
  double sharpness_deg = 25.0;  ///< of that smoothing
  /// Holes up to this diameter are filled, larger ones stay; 0 = none is filled. What is less wide than 3.5 spacings is
  /// no hole but a gap between points, and always filled.
  double hole_limit = 0.0;
};

/// Holes are the borders other than outer rims. Of every connected part the longest border is an outer rim, and so are
/// others at least half as wide (a tube has two); they are never filled.
struct FreeMeshReport {
  std::size_t thinned = 0;  ///< points used
  std::size_t holes = 0, filled = 0;
  double largest_hole = 0.0;  ///< diameter of the largest one that stays
};

/// A mesh of points that are no graph over anything: advancing front (Cohen-Steiner and Da 2004) over thinned points,
/// after bilateral smoothing, holes filled with refined and faired triangles. outward: a vector per point that points
/// out of the material (within 90 degrees of the normal; it turns the triangles). Manifold, oriented; edges of more
/// than 3.5 spacings occur in filled holes only. Deterministic, and independent of the order of the points. Errors:
/// Error(input_data) for fewer than 100 points, ones that are not finite, or when no surface comes out (points on a
/// line); Error(configuration) for settings that mean nothing, and without CGAL.
TriangleMesh mesh_points(std::span<const Vec3> points, std::span<const Vec3> outward, const FreeMeshSettings& settings,
                         FreeMeshReport* report = nullptr);

}  // namespace treadmark::scans
