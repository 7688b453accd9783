// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::kalker {

/// Integrals of traction times the terms of the point solutions of the half-space, x and y from the load to the
/// observation: of 1/r, x^2/r^3, xy/r^3, x/r^2 and y/r^2 (y^2/r^3 follows).
struct PointSolutionIntegrals {
  double r = 0.0, xx = 0.0, xy = 0.0, x = 0.0, y = 0.0;

  PointSolutionIntegrals& operator+=(const PointSolutionIntegrals& other) {
    r += other.r;
    xx += other.xx;
    xy += other.xy;
    x += other.x;
    y += other.y;
    return *this;
  }
};

/// One direction of a rectangle: where it lies and the traction at its ends, linear in between. The length is kept,
/// because far away it is lost in the difference of the ends.
struct LinearSide {
  double begin = 0.0, length = 0.0;
  double at_begin = 0.0, at_end = 0.0;
  double end() const { return begin + length; }
};

/// Integrals over the rectangle x by y of the product of the two sides' tractions, seen from the origin, which may lie
/// anywhere. Accurate to rounding for lengths of about one and any distance.
PointSolutionIntegrals integrate_cell(const LinearSide& x, const LinearSide& y);

}  // namespace treadmark::kalker
