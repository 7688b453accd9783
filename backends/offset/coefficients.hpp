// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/offset/sparse_offsets.hpp"

namespace treadmark::offset {

/// Coefficients of the interpolating tensor B-spline of degree 2 or 3 through the offsets, 0 outside them: the inverse
/// of the sampled B-spline is a symmetric exponential z^|k| (Unser, Aldroubi, Eden 1993), cut off where it falls below
/// single precision. They spread kSpread voxels beyond the offsets; blocks whose coefficients are all below `smallest`
/// [m] are dropped.
SheetGrid spline_coefficients(const SparseOffsets& offsets, int degree, float smallest);
constexpr int kSpread = 14;
/// Below which they do not count beside the tolerance of the offsets [m].
float smallest_coefficient(const SparseOffsets& offsets);

}  // namespace treadmark::offset
