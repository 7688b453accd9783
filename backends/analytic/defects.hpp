// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>

#include "treadmark/backends/displacement/offset_field.hpp"
#include "treadmark/core/defects.hpp"
#include "treadmark/core/profile.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::analytic {

/// All offsets of the defects but milling, added up, in closed form. base is asked for its highest point where a flattened
/// head needs it, and kept. Errors: Error(configuration) naming the shape and its number for parameters that make no sense:
/// lengths, widths or depths that are not positive, overlapping or self-intersecting shapes (a depth that reaches the axle,
/// slopes beyond 1, a flat longer than the diameter).
std::shared_ptr<const displacement::OffsetField> make_defect_field(const Defects& defects, Body body, double nominal_radius,
                                                                   std::shared_ptr<const Surface> base);

/// A base of any backend with all its defects: displaced by make_defect_field, then milled. Returns base itself without any.
/// The result's backend() is the base's. Errors: as above; wheel shapes on a rail and the reverse.
std::shared_ptr<const Surface> add_defects(std::shared_ptr<const Surface> base, const Defects& defects, Body body,
                                           double nominal_radius);

/// The part of the surface that the defects change: u (x [m] or theta [rad]) and y; nothing without defects.
std::optional<Rectangle> defect_region(const Defects& defects, double nominal_radius);

}  // namespace treadmark::analytic
