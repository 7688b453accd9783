// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"

namespace treadmark::kalker {

/// Tractions on elastic half-spaces that fall bilinearly from 1 at an element's centre to 0 at the centres of its
/// neighbours, dx and dy [m] away (tents of 2 dx by 2 dy), so that the traction between centres is interpolated. Their
/// sum times dx dy is the force as for constant elements, whose coefficients they approach with the square of the
/// distance. Accurate to about 1e-13 relative to the largest coefficient at the point, at any point and for any dx /
/// dy.
class BilinearElements final : public InfluenceKernel {
 public:
  /// poisson and difference: combined constants nu and K of treadmark::combine. Errors: Error(configuration) for dx or
  /// dy <= 0.
  BilinearElements(double dx, double dy, double poisson, double difference);

  InfluenceBlock at(double X, double Y) const override;
  bool symmetric() const override { return true; }
  bool coupled() const override { return difference_ != 0.0; }

 private:
  double dx_, dy_, poisson_, difference_;
};

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
