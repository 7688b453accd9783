// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::spline {

/// The points of a profile joined by straight lines: a rail of constant cross-section, or a round wheel with r =
/// nominal_radius [m] + z. Normals are constant across each chord and turn at the points. Errors: Error(input_data) for
/// unusable points, Error(configuration) for a radius that is not positive.
std::shared_ptr<const Surface> make_chord_surface(const Profile& profile, double nominal_radius);

/// The same for sections that change: straight between neighbouring lateral nodes of the grid, cubic splines along. v
/// is the number of the node, from 1. Where one of two neighbours is missing there is no chord; a node that fewer than
/// 4 successive stations have is left out there. Errors: Error(input_data) if nothing is left, or for fewer than 4
/// stations.
std::shared_ptr<const Surface> make_chord_surface(const sampling::PointGrid& points, double nominal_radius);

}  // namespace treadmark::spline
