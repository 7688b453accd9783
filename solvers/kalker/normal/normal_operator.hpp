// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/halfspace/influence.hpp"
#include "treadmark/solvers/kalker/halfspace/kernel_store.hpp"
#include "treadmark/solvers/kalker/halfspace/toeplitz_operator.hpp"
#include "treadmark/solvers/kalker/halfspace/turned_product.hpp"

namespace treadmark::kalker {

/// Coefficients of pressures on a box of elements of one size.
struct NormalInfluence {
  ToeplitzTransform transform;
  std::vector<double> symbol;  ///< C/G [m/Pa] of half-spaces
  Spectrum influence;          ///< of other kernels, then there is no symbol; turned row by row: those before
  RealFft2d ring;              ///< hardly larger than the box
  std::vector<double> inverse_symbol;
  std::optional<TurnedProduct> turned;  ///< of coefficients that are turned row by row
};

/// Normal displacement by pressure on a box of elements, u = (1/G) C p, and an approximate inverse of it. Not
/// thread-safe.
class NormalOperator {
 public:
  NormalOperator(std::shared_ptr<NormalInfluence> coefficients, std::optional<RowInclination> rows)
      : coefficients_(std::move(coefficients)), rows_(std::move(rows)) {}

  void displacement(std::span<const double> pressure, std::span<double> u) const {
    if (rows_)
      return coefficients_->turned->apply(*rows_, {.x = {}, .y = {}, .n = pressure}, {.x = {}, .y = {}, .n = u});
    if (coefficients_->influence.empty()) return coefficients_->transform.convolve(coefficients_->symbol, pressure, u);
    coefficients_->transform.convolve(coefficients_->influence, pressure, u);
  }
  void precondition(std::span<const double> residual, std::span<double> z) const {
    multiply_by_symbol(coefficients_->ring, coefficients_->inverse_symbol, coefficients_->transform.nx(), residual, z);
  }

 private:
  std::shared_ptr<NormalInfluence> coefficients_;
  std::optional<RowInclination> rows_;
};

/// Operators of the boxes met so far for one element size and material; starts anew when these change.
class NormalOperatorCache {
 public:
  /// For a box of elements of the problem, from row `first_row` of its grid on: its coefficients of influence, bodies
  /// and thin sheet.
  NormalOperator get(int nx, int ny, int first_row, const ContactProblem& problem);

  /// Whether pressure on one element moves another one as much as the other way round.
  bool symmetric(const ContactProblem& problem) {
    const KernelChoice choice = kernels_.get(problem);
    return !choice.inclination && choice.kernel->symmetric();
  }

  /// C [m] of half-spaces at offsets |dix| < nx, |diy| < ny, of the problem that get() was called for last; none where
  /// its coefficients are others.
  const InfluenceTable* half_spaces(int nx, int ny);

 private:
  std::shared_ptr<NormalInfluence> make(int nx, int ny);

  std::optional<InfluenceTable> table_;
  double shear_modulus_ = 0.0, sheet_ = 0.0;
  KernelStore kernels_;
  std::shared_ptr<const InfluenceKernel> kernel_;
  bool turned_ = false;
  std::map<std::pair<int, int>, std::shared_ptr<NormalInfluence>> operators_;
};

}  // namespace treadmark::kalker
