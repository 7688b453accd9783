// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "treadmark/solvers/kalker/halfspace/block_table.hpp"
#include "treadmark/solvers/kalker/halfspace/toeplitz_operator.hpp"
#include "treadmark/solvers/kalker/halfspace/turned_product.hpp"

namespace treadmark::kalker {

/// Displacements of the elements of a box by tractions on all of its elements: u_I = (1/G) sum_J C(x_I - x_J + shift)
/// p_J with any of the nine components of a kernel. Fields have ny rows of nx values, tractions [Pa], displacements
/// [m]. Coefficients and spectra are made when first needed: not thread-safe, one object a thread. Errors:
/// Error(configuration) for sizes of fields that do not fit.
class InfluenceOperator {
 public:
  /// dx, dy: distances of elements [m]. shear_modulus: combined G [Pa]. shift: from an element's centre to where its
  /// displacement is looked at [m]. Errors: Error(configuration) without elements or kernel, or for a modulus or
  /// distances not positive.
  InfluenceOperator(int nx, int ny, double dx, double dy, double shear_modulus,
                    std::shared_ptr<const InfluenceKernel> kernel, double shift_x = 0.0, double shift_y = 0.0);

  int nx() const { return transform_.nx(); }
  int ny() const { return transform_.ny(); }
  std::size_t size() const { return transform_.size(); }
  const InfluenceKernel& kernel() const { return table_->kernel(); }

  /// Input and output may be the same fields. rows: inclinations by which the coefficients, then those of half-spaces,
  /// are turned (TurnedProduct), or none.
  void tangential_by_tangential(std::span<const double> px, std::span<const double> py, std::span<double> ux,
                                std::span<double> uy, const RowInclination* rows = nullptr);
  /// The same by a weighted sum of the coefficients of operators of one size, half-spaces only. The first one's memory
  /// is used. Errors: none; nodes not empty, as many weights.
  static void tangential_by_tangential(std::span<InfluenceOperator* const> nodes, std::span<const double> weights,
                                       std::span<const double> px, std::span<const double> py, std::span<double> ux,
                                       std::span<double> uy);
  void tangential_by_normal(std::span<const double> pn, std::span<double> ux, std::span<double> uy,
                            const RowInclination* rows = nullptr);
  void normal_by_tangential(std::span<const double> px, std::span<const double> py, std::span<double> un,
                            const RowInclination* rows = nullptr);
  void normal_by_normal(std::span<const double> pn, std::span<double> un, const RowInclination* rows = nullptr);

  /// Coefficients for an element that lies (dix, diy) elements from the loaded one, |dix| < nx, |diy| < ny, not divided
  /// by G [m].
  InfluenceBlock at(int dix, int diy) { return table_->at(dix, diy); }

 private:
  using Coefficient = double InfluenceBlock::*;

  const Spectrum& spectrum(Coefficient coefficient);
  /// result = first * field_1 + second * field_2 of the transformed fields; without second only the former.
  void invert(Coefficient first, Coefficient second, std::span<double> result);
  /// Whether there is anything to compute for fields of these sizes.
  bool coupled(std::initializer_list<std::size_t> sizes) const;

  TurnedProduct& turned();

  double shear_modulus_;
  ToeplitzTransform transform_;
  std::shared_ptr<BlockTable> table_;
  std::array<Spectrum, 9> spectra_;  ///< empty until needed
  std::optional<TurnedProduct> turned_;
  Spectrum field_1_, field_2_, sum_;
};

}  // namespace treadmark::kalker
