// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/detection/body_pair.hpp"

namespace treadmark::detection {

/// Heights of a variable rail [m] over the elements of a potential contact area as the reference program (CONTACT) has
/// them: in the section at every x natural cubics through the points at which the slices' data lie. NaN beyond the
/// outermost of these. Returns false, with heights that mean nothing, for a rail whose data are not known. Only for
/// agreement with that program's results.
bool section_heights(const BodyPair& bodies, const Pose& X_TC, const Grid2& grid_C, std::span<double> rail_n);

}  // namespace treadmark::detection
