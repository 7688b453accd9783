// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <vector>

#include "treadmark/backends/analytic/defects/offset_shape.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/defects.hpp"

namespace treadmark::analytic {

/// Shapes that check_defects has found good; see docs/defects.md for their formulas.

using ShapePtr = std::unique_ptr<const OffsetShape>;

using Shapes = std::vector<ShapePtr>;

/// One shape or more of every defect that displaces the surface; flattened heads and milling cut it instead.
Shapes make_shapes(const Defects& defects, double nominal_radius);
/// max(0, plane - base), round at its edges if they have a radius; asks the base for every value. The plane touches the
/// sound rail.
ShapePtr make_flattened_head_shape(const FlattenedHead& head, const Surface& sound,
                                   std::shared_ptr<const Surface> base);

}  // namespace treadmark::analytic
