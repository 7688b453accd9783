// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/model/shape/slices.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::sampling {

/// Two triangles a cell; cells with a missing corner keep the triangle that is whole, or none.
TriangleMesh to_mesh(const PointGrid& points, std::string name);

/// One slice a station; z of a wheel's slice is the radius less nominal_radius [m]. A closed wheel gets its first slice
/// again at the end of the turn. Points must not be staggered. Errors: Error(input_data) if a section has gaps between
/// its ends or fewer than four points.
SliceSet to_slices(const PointGrid& points, double nominal_radius, std::string name);

/// The section whose heights are the medians over all stations: the undamaged shape of a mostly undamaged surface.
/// Errors: Error(input_data) if fewer than four nodes have a surface.
Profile median_section(const PointGrid& points, double nominal_radius, std::string name);

}  // namespace treadmark::sampling
