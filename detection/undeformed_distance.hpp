// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/detection/contact_frame.hpp"
#include "treadmark/detection/curved_reference.hpp"

namespace treadmark::detection {

/// Distance of the undeformed bodies over the elements of a potential contact area, measured along n.
struct UndeformedDistance {
  std::vector<double> distance;  ///< h >= 0 [m], least value 0; NaN where a surface is missing; size grid.size()
  double approach = 0.0;         ///< rigid penetration = - least n_rail - n_wheel [m]; <= 0: the bodies do not touch
};

/// Exact evaluation of both surfaces in the tangent plane (Figure 3 i-l of the same paper), unless BodyPair asks for a
/// mesh of the wheel.
UndeformedDistance undeformed_distance(const BodyPair& bodies, const Pose& X_TC, const Grid2& grid_C);

/// The same from heights of rail and wheel along n [m], which are known already; both of one size.
UndeformedDistance undeformed_distance(std::vector<double> rail_n, std::span<const double> wheel_n);

/// Where both surfaces lie over the elements: heights from the element centres along the local normal n [m], NaN where
/// a surface is missing; size grid.size().
struct FacingSurfaces {
  std::vector<double> rail, wheel;
};

/// Exact evaluation along the normal of each row. Errors: Error(configuration) for another number of rows than the
/// grid's.
FacingSurfaces facing_surfaces(const BodyPair& bodies, const Pose& X_TC, const Grid2& grid,
                               const ReferenceRows& reference);

/// Their distance along the local normals.
UndeformedDistance undeformed_distance(const FacingSurfaces& surfaces);

}  // namespace treadmark::detection
