// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <vector>

#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"

namespace treadmark::kalker {

/// A body's share in the coefficients of a pair of viscoelastic half-spaces (standard linear solid).
struct ViscoelasticBody {
  std::shared_ptr<const InfluenceKernel> elastic;  ///< immediate coefficients; symmetric and not coupled
  double weight = 1.0;                             ///< of this body in the pair's coefficients
  double creep_ratio = 0.0;                        ///< delayed to immediate compliance
  double relaxation_distance = 0.0;                ///< L = rolling velocity * relaxation time [m]
};

/// Lines x and y [m] that border the loaded area or fold the traction on it: there coefficients are not smooth.
struct KernelBorders {
  std::vector<double> x, y;
};

/// Steady rolling of viscoelastic half-spaces: the sum over bodies of
///   weight (C(X, Y) + creep_ratio integral_0^inf exp(-q) C(X + ahead L q, Y) dq),
/// because a particle was ahead by L q when it was loaded q relaxation times ago.
/// The integral is accurate to about 1e-10 relative to the coefficient. Along a row it fades and grows from point to
/// point (Taylor, Pister, Goudreau 1970): that from X on is the one over the step to X + ahead dx, plus exp(-dx / L)
/// times the one from there on.
class ViscoelasticKernel final : public InfluenceKernel {
 public:
  /// ahead: 1 for rolling in the direction of +x, -1 for -x. Errors: Error(configuration) without elastic kernels, for
  /// coupled ones, for negative distances or ratios, or without borders.
  ViscoelasticKernel(std::vector<ViscoelasticBody> bodies, KernelBorders borders, double ahead);

  InfluenceBlock at(double X, double Y) const override;
  void row(int first, double step, double shift, double Y, std::span<InfluenceBlock> blocks) const override;
  bool symmetric() const override { return false; }
  bool symmetric_in_y() const override { return true; }
  bool coupled() const override { return false; }

 private:
  std::vector<ViscoelasticBody> bodies_;
  KernelBorders borders_;
  double ahead_;
};

}  // namespace treadmark::kalker
