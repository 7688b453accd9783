// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/backends/displacement/offset_field.hpp"
#include "treadmark/backends/offset/sparse_offsets.hpp"

namespace treadmark::offset {

/// The tensor B-spline that interpolates sparse offsets: degree 1 (bilinear), 2 or 3; 0 away from them.
/// Errors of smooth offsets fall with the power degree + 1 of the voxel; degree d has d - 1 continuous derivatives.
/// Parameters are the coefficients of all voxels of stored blocks, node_i_j (node_m3_12: i = -3): of degree 1 the
/// offsets themselves.
std::shared_ptr<const displacement::OffsetField> make_sheet_field(std::shared_ptr<const SparseOffsets> offsets,
                                                                  Interpolation interpolation);

}  // namespace treadmark::offset
