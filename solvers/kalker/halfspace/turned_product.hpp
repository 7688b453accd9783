// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <functional>
#include <span>

#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"
#include "treadmark/solvers/kalker/halfspace/row_inclination.hpp"
#include "treadmark/solvers/kalker/halfspace/toeplitz_operator.hpp"

namespace treadmark::kalker {

/// Fields of a box [Pa], [m]; empty ones are zero or not wanted.
struct TractionFields {
  std::span<const double> x, y, n;
};
struct DisplacementFields {
  std::span<double> x, y, n;
};

/// Displacements of the elements of a box by tractions on all of its elements, with coefficients that are turned by the
/// difference of inclination between rows (Vollebregt 2018, the table row by row). The coefficients then depend on both
/// rows, but every one is a sum of half-space coefficients times the cosine or sine of a difference of angles, which
/// separates: cos(a - b) = cos a cos b + sin a sin b. So a product is a number of convolutions of tractions multiplied
/// row by row, multiplied row by row again: exact. Spectra are made when first needed: not thread-safe.
class TurnedProduct {
 public:
  /// Coefficients of the half-space [m/Pa] at an offset "observation minus source", |dix| < nx, |diy| < ny. They must
  /// be opposite in pairs, ny = -yn, as those of all elastic half-spaces; coupled: whether these and xn, nx differ from
  /// zero.
  using HalfSpace = std::function<InfluenceBlock(int dix, int diy)>;
  TurnedProduct(ToeplitzTransform transform, HalfSpace half_space, bool coupled);

  /// Input and output may be the same fields. along_rows: factors of the spectrum along x, padded_nx/2+1 values, or
  /// none. Errors: Error(configuration) for sizes that do not fit.
  void apply(const RowInclination& rows, const TractionFields& p, const DisplacementFields& u,
             std::span<const std::complex<double>> along_rows = {});

 private:
  static constexpr std::size_t kCombinations = 12;

  const Spectrum& kernel(std::size_t combination);
  void load(const TractionFields& p, std::span<const std::complex<double>> along_rows);

  ToeplitzTransform transform_;
  HalfSpace half_space_;
  bool coupled_;
  std::array<Spectrum, kCombinations> kernels_;             ///< empty until needed
  std::array<Spectrum, 3> rows_;                            ///< tractions in x, y, n, transformed along x
  std::array<std::array<Spectrum, kRowFactors>, 3> loads_;  ///< the same times a factor, transformed
  Spectrum sum_, result_;
};

}  // namespace treadmark::kalker
