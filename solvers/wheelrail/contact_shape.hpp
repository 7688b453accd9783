// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/core/surface.hpp"

namespace treadmark::wheelrail {

/// Curvatures of one body where it is touched.
struct ContactShape {
  double curvature_1 = 0.0, curvature_2 = 0.0;  ///< greater and lesser principal curvature [1/m], > 0: convex
  double angle =
      0.0;  ///< of the direction of curvature_1 against x, towards s, in (-pi/2, pi/2]; 0 where both are equal
};

/// X_SC: the contact axes, with the origin at the contact reference, in the surface's frame. Curvatures are those that
/// the surface tells; their directions come from central differences of its slopes over +-10 um. Nothing where the
/// surface ends.
std::optional<ContactShape> contact_shape(const Surface& surface, const Pose& X_SC);

}  // namespace treadmark::wheelrail
