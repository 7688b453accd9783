// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <map>
#include <memory>
#include <utility>

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/halfspace/influence_table.hpp"
#include "treadmark/solvers/kalker/halfspace/kernel_store.hpp"
#include "treadmark/solvers/kalker/halfspace/toeplitz_operator.hpp"

namespace treadmark::kalker {

/// Normal displacement by pressure on a box of elements, u = (1/G) C p, and an approximate inverse of it.
struct NormalOperator {
  ToeplitzTransform transform;
  Spectrum influence;   ///< C/G [m/Pa]
  Spectrum preconditioner;

  void displacement(std::span<const double> pressure, std::span<double> u) const {
    transform.convolve(influence, pressure, u);
  }
  void precondition(std::span<const double> residual, std::span<double> z) const {
    transform.convolve(preconditioner, residual, z);
  }
};

/// Operators of the boxes met so far for one element size and material; starts anew when these change.
class NormalOperatorCache {
 public:
  /// Sizes of boxes are rounded up to few values, so that operators are met again.
  static int rounded_up(int n) { return n <= 1 ? 1 : good_fft_size(2 * n - 1) / 2; }

  /// For a box of elements of the problem: its coefficients of influence, bodies and thin sheet.
  const NormalOperator& get(int nx, int ny, const ContactProblem& problem);

 private:
  std::optional<InfluenceTable> table_;
  double shear_modulus_ = 0.0, sheet_ = 0.0;
  KernelStore kernels_;
  std::shared_ptr<const InfluenceKernel> kernel_;
  std::map<std::pair<int, int>, std::unique_ptr<NormalOperator>> operators_;
};

}  // namespace treadmark::kalker
