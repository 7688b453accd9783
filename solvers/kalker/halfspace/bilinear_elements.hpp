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

}  // namespace treadmark::kalker
