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

using Shapes = std::vector<ShapePtr>;

/// Append the shapes of one list of a Defects; nominal_radius: of a wheel.
void add_shapes(const std::vector<WheelFlat>& flats, double nominal_radius, Shapes& shapes);
void add_shapes(const std::vector<Polygonization>& polygonizations, double nominal_radius, Shapes& shapes);
void add_shapes(const std::vector<Squat>& squats, double nominal_radius, Shapes& shapes);
void add_shapes(const std::vector<Corrugation>& corrugations, double nominal_radius, Shapes& shapes);
void add_shapes(const std::vector<GaugeCornerCollapse>& collapses, double nominal_radius, Shapes& shapes);
void add_shapes(const std::vector<Spall>& spalls, double nominal_radius, Shapes& shapes);
/// What cuts a surface does not displace it.
inline void add_shapes(const std::vector<FlattenedHead>&, double, Shapes&) {}
inline void add_shapes(const std::vector<MillingPath>&, double, Shapes&) {}

/// max(0, plane - base); asks the base for every value.
ShapePtr make_flattened_head_shape(const FlattenedHead& head, std::shared_ptr<const Surface> base);

}  // namespace treadmark::analytic
