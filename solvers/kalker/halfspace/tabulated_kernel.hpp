// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <vector>

#include "treadmark/model/contact/numerical_influence.hpp"
#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"

namespace treadmark::kalker {

/// Coefficients computed elsewhere: bilinear between the offsets of a table, beyond its last ones those of another
/// kernel.
class TabulatedKernel final : public InfluenceKernel {
 public:
  /// dx, dy: of the elements that the coefficients are for [m]; outside: usually the half-space.
  /// Errors: Error(configuration) if the table is missing, empty, even-sized or incomplete, holds numbers that are not
  /// finite, was made for elements that differ by more than 1e-6 relative, or if outside is missing.
  TabulatedKernel(std::shared_ptr<const NumericalInfluence> table, std::shared_ptr<const InfluenceKernel> outside,
                  double dx, double dy);

  InfluenceBlock at(double X, double Y) const override;
  bool symmetric() const override { return symmetric_; }
  bool coupled() const override { return coupled_; }

 private:
  int nx_, ny_;
  double dx_, dy_;
  std::vector<InfluenceBlock> blocks_;
  std::shared_ptr<const InfluenceKernel> outside_;
  bool symmetric_, coupled_;
};

}  // namespace treadmark::kalker
