// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <vector>

#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"

namespace treadmark::kalker {

/// Coefficients of a kernel at offsets of whole elements, all evaluated when the first one is asked for; offsets that
/// follow from others by symmetry are not evaluated. Not thread-safe.
class BlockTable {
 public:
  /// Offsets |dix| < nx, |diy| < ny of elements dx by dy [m]. shift: added to all of them [m]. Errors:
  /// Error(configuration) without a kernel, or for distances not positive.
  BlockTable(int nx, int ny, double dx, double dy, std::shared_ptr<const InfluenceKernel> kernel, double shift_x = 0.0,
             double shift_y = 0.0);

  /// Coefficients for an element that lies (dix, diy) elements from the loaded one [m].
  /// Errors: Error(configuration) for offsets outside the table.
  InfluenceBlock at(int dix, int diy);
  const InfluenceKernel& kernel() const { return *kernel_; }

 private:
  void fill();

  int nx_, ny_;
  double dx_, dy_, shift_x_, shift_y_;
  std::shared_ptr<const InfluenceKernel> kernel_;
  bool fold_x_, fold_y_;  ///< offsets of both signs follow from the ones >= 0
  std::vector<InfluenceBlock> blocks_;
};

}  // namespace treadmark::kalker
