// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/detection/gap_field.hpp"
#include "treadmark/detection/undeformed_distance.hpp"

namespace treadmark::detection {

/// Heights of the wheel [m] over the elements of a potential contact area as CONTACT has them, from a mesh about as
/// fine as the elements. A round wheel: bilinear between circles and cross-sections at the element sizes. An
/// out-of-round wheel: between sections at the element size dx and the lateral nodes of its slices, bicubic with
/// differences for slopes, which rounds off edges narrower than those nodes. NaN where there is no mesh; of several
/// parts of the wheel over one another the greatest height. rows_s: the rows' positions in the contact plane [m], from
/// the grid or of one's own; rail_n: the rail's heights, near which the wheel is wanted.
void mesh_heights(const BodyPair& bodies, const Pose& X_TC, const Grid2& grid_C, std::span<const double> rows_s,
                  std::span<const double> rail_n, std::span<double> wheel_n);

/// Distance over a curved reference as that program has it: in the contact plane at the places of the rows, from that
/// mesh where the bodies ask for it, times the cosine of the row's inclination.
UndeformedDistance projected_distance(const BodyPair& bodies, const Pose& X_TC, const Grid2& grid,
                                      const ReferenceRows& reference);

}  // namespace treadmark::detection
