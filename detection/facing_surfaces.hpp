// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/detection/curved_reference.hpp"
#include "treadmark/detection/undeformed_distance.hpp"

namespace treadmark::detection {

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

/// The distance as the reference program (CONTACT) has it: in the contact plane at the places of the rows, on its mesh
/// of the wheel (BodyPair::distance_mesh), times the cosine of the row's inclination. Only for agreement with that
/// program's results.
UndeformedDistance projected_distance(const BodyPair& bodies, const Pose& X_TC, const Grid2& grid,
                                      const ReferenceRows& reference);

}  // namespace treadmark::detection
