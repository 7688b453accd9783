// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <vector>

#include "treadmark/backends/analytic/defects/offset_shape.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/defects.hpp"

namespace treadmark::analytic {

/// Shapes that check_defects has found good; see docs/defects.md for their formulas.

using ShapePtr = std::unique_ptr<const OffsetShape>;

/// All flats of a wheel: -D(theta, y) of FlatDepth.
ShapePtr make_flats_shape(const std::vector<WheelFlat>& flats, double nominal_radius);
ShapePtr make_polygonization_shape(const Polygonization& polygonization);
/// One shape a dip.
std::vector<ShapePtr> make_squat_shapes(const Squat& squat);
ShapePtr make_corrugation_shape(const Corrugation& corrugation);
ShapePtr make_gauge_corner_shape(const GaugeCornerCollapse& collapse);
/// max(0, plane - base); asks the base for every value.
ShapePtr make_flattened_head_shape(const FlattenedHead& head, std::shared_ptr<const Surface> base);

}  // namespace treadmark::analytic
