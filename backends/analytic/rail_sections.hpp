// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark::analytic {

/// One arc or line of an outline up to its end point (y, z) [mm]; radius > 0 bends as the crown, < 0 as the fillet of
/// the web, 0 is straight.
struct OutlineElement {
  double y, z, radius;
};

/// A rail of EN 13674, symmetric about y = 0 with the crown at the origin.
struct RailSection {
  std::string_view name, legacy_name;              ///< legacy: of a railway; may be empty
  std::string_view standard;                       ///< "EN 13674-1"
  double height = 0.0, foot_width = 0.0;           ///< [m]
  double area = 0.0, mass = 0.0;                   ///< [m^2], [kg/m], as published
  std::span<const OutlineElement> half_outline{};  ///< from the crown to the middle of the base, y >= 0
};

/// All of them, by increasing mass in their names. Thread-safe.
const std::vector<RailSection>& rail_sections();

/// The head from side to side, down to where the fillets to its lower faces begin.
ArcChain head_chain(const RailSection& section);

/// Area of the whole section from its outline, arcs exactly [m^2].
double outline_area(const RailSection& section);

/// The whole outline, from the middle of the base up the left side, over the head and down the right [m]; points on
/// arcs are at most step [m] apart, on lines ten times that.
std::vector<Vec2> outline_points(const RailSection& section, double step);

}  // namespace treadmark::analytic
