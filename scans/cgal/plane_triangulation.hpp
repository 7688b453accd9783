// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

using Triangle = std::array<std::uint32_t, 3>;

/// Delaunay triangulation of points in a plane, counter-clockwise, without triangles that have an edge longer than
/// longest_edge (so that holes and concave rims stay open). period > 0: the plane is a cylinder, x wraps round with
/// this period, and so do the triangles; none reaches farther than half round. Deterministic: each triangle begins with
/// its least index, triangles ascend, and another order of the points gives the same triangles, whatever points lie on
/// a circle. Of equal points the first one is used (on a cylinder they are equal within 1e-12 of the period). Errors:
/// Error(input_data) for fewer than three points, all on a line or not finite; Error(configuration) for a length that
/// is not positive, and without CGAL.
std::vector<Triangle> triangulate_plane(std::span<const Vec2> points, double longest_edge, double period = 0.0);

/// A subset of points over whose Delaunay triangulation, with linear interpolation of `heights`, no point lies farther
/// than tolerance from its height: greedy insertion of the worst point (Garland and Heckbert 1995). Indices ascending.
/// The triangulation meant is triangulate_plane(kept, infinity, period). It spans the holes of the points, and its
/// edges are as long in flat places: what is a hole has to be known from elsewhere. Of equal points the first one
/// counts. Independent of the order of the points, as above. Errors as above, and Error(configuration) for a tolerance
/// that is not positive.
std::vector<std::uint32_t> decimate_plane(std::span<const Vec2> points, std::span<const double> heights,
                                          double tolerance, double period = 0.0);

}  // namespace treadmark::scans
