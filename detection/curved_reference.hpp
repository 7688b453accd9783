// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/detection/contact_frame.hpp"

namespace treadmark::detection {

/// A row of elements on a surface between rail and wheel, in the contact frame C.
struct ReferenceRow {
  double y = 0.0, n = 0.0;  ///< its point in the plane x = 0 of C [m]
  double angle = 0.0;       ///< inclination of the surface against the contact plane [rad]
};

/// The surface on which elements lie: the tangent plane, or a cylinder along x over a curve across the rail. The
/// coordinates of the grid are x and the arc length along the curve.
struct ReferenceRows {
  Vec2 reference_C = Vec2::Zero();  ///< where the contact reference lies in the grid's axes [m]
  std::vector<ReferenceRow> rows;   ///< grid.ny of them

  /// Local frame L of a row in C: x along the grid's rows with the grid's own x, y along the curve, n into the rail.
  Pose X_CL(int iy) const;
  std::vector<double> angles() const;
};

/// Rows in the contact plane.
ReferenceRows plane_reference(const Grid2& grid, const Vec2& reference_C = Vec2::Zero());

/// Rows on the curve half-way between rail and wheel in the plane x = 0 of C (conformal contact; Vollebregt 2021). The
/// arc length is zero beside the contact reference. The curve is followed in its own directions and may turn by any
/// angle. Where rail or wheel is missing, or their directions differ by more than 51 degrees, it goes straight on.
/// Needs heights with slopes of the surfaces only. Thread-safe.
ReferenceRows curved_reference(const BodyPair& bodies, const ContactFrame& frame, const Grid2& grid,
                               const Vec2& reference_C = Vec2::Zero());

}  // namespace treadmark::detection
