// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"

namespace treadmark::kalker {

/// K of treadmark::combine where it is large enough to couple normal and tangential displacements (|K| >= 1e-6), else
/// 0.
double significant_difference(double difference);

/// Errors: Error(configuration) unless both sizes [m] are positive and finite.
void check_element_size(double dx, double dy);

/// Elements dx by dy [m] under uniform traction on elastic half-spaces (Boussinesq-Cerruti, Kalker 1990), at any point:
/// influence() together with the coefficients of dissimilar bodies, C_xn = -C_nx and C_yn = -C_ny, proportional to K =
/// difference. The latter are accurate to about 1e-14 relative to the coefficient at any distance.
class ConstantElements final : public InfluenceKernel {
 public:
  /// poisson and difference: combined constants nu and K of treadmark::combine. Errors: Error(configuration) for dx or
  /// dy <= 0.
  ConstantElements(double dx, double dy, double poisson, double difference);

  InfluenceBlock at(double X, double Y) const override;
  bool symmetric() const override { return true; }
  bool coupled() const override { return difference_ != 0.0; }

 private:
  double dx_, dy_, poisson_, difference_;
};

/// Integral of x / r^2 over the rectangle dx by dy about (X, Y) [m]: odd in X, even in Y. The one of y / r^2 follows by
/// exchanging the axes.
double coupling_integral(double X, double Y, double dx, double dy);

}  // namespace treadmark::kalker
