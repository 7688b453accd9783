// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/backends/analytic/cutter.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::analytic {

/// Conservative height bounds of what cutters leave of a base, from those of the base over the same rectangle. A line
/// that leaves the volume of a cutter does so through its section or a wall above an end of it, which are looked at
/// along the normal; how the path moves and rolls over the rectangle is taken as a thickness.
HeightBounds cut_bounds(std::span<const Cutter> cutters, const Pose& X_SP, const Rectangle& rectangle_P,
                        const HeightBounds& base);

}  // namespace treadmark::analytic
