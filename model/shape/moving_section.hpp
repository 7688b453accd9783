// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark {

/// A rail whose section moves along the track, without changing its shape, on two straight lines through (x, y, z) that
/// are joined by a rounding: the nose of a crossing that rises and levels off, or its wing rail that moves aside. The
/// section stands perpendicular to x everywhere. Within the rounding slopes change by a triangle of second derivatives:
/// with t the distance from x, r the rounding, B = 2 (t + r/2)^3/(3 r^2) up to t = 0, symmetric about the bisector
/// after it. Beyond both ends the section stays where it is.
struct MovingSection {
  double x = 0.0, y = 0.0, z = 0.0;                   ///< where the lines meet; offsets of the section's origin [m]
  double slope_y_before = 0.0, slope_z_before = 0.0;  ///< dy/dx and dz/dx (down) for less x [-]
  double slope_y_after = 0.0, slope_z_after = 0.0;    ///< for greater x
  double length_before = 0.5, length_after = 0.5;     ///< of the lines, > rounding/2 [m]
  double rounding = 0.1;                              ///< along the track, > 0 [m]
  friend bool operator==(const MovingSection&, const MovingSection&) = default;
};

}  // namespace treadmark
