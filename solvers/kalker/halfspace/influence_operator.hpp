// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"
#include "treadmark/solvers/kalker/halfspace/toeplitz_operator.hpp"

namespace treadmark::kalker {

/// Displacements of the elements of a box by tractions on all of its elements: u_I = (1/G) sum_J C(x_I - x_J + shift) p_J with any
/// of the nine components of a kernel. Fields have ny rows of nx values, tractions [Pa], displacements [m].
/// Coefficients and spectra are made when first needed: not thread-safe, one object a thread.
/// Errors: Error(configuration) for sizes of fields that do not fit.
class InfluenceOperator {
 public:
  /// dx, dy: distances of elements [m]. shear_modulus: combined G [Pa]. shift: from an element's centre to where its displacement
  /// is looked at [m]. Errors: Error(configuration) without elements or kernel, or for a modulus or distances not positive.
  InfluenceOperator(int nx, int ny, double dx, double dy, double shear_modulus, std::shared_ptr<const InfluenceKernel> kernel,
                    double shift_x = 0.0, double shift_y = 0.0);

  int nx() const { return transform_.nx(); }
  int ny() const { return transform_.ny(); }
  std::size_t size() const { return transform_.size(); }
  const InfluenceKernel& kernel() const { return *kernel_; }

  /// Input and output may be the same fields.
  void tangential_by_tangential(std::span<const double> px, std::span<const double> py, std::span<double> ux, std::span<double> uy);
  void tangential_by_normal(std::span<const double> pn, std::span<double> ux, std::span<double> uy);
  void normal_by_tangential(std::span<const double> px, std::span<const double> py, std::span<double> un);
  void normal_by_normal(std::span<const double> pn, std::span<double> un);

  /// Coefficients for an element that lies (dix, diy) elements from the loaded one, |dix| < nx, |diy| < ny, not divided by G [m].
  InfluenceBlock at(int dix, int diy);

 private:
  using Coefficient = double InfluenceBlock::*;

  void make_table();
  const Spectrum& spectrum(Coefficient coefficient);
  /// result = first * field_1 + second * field_2 of the transformed fields; without second only the former.
  void invert(Coefficient first, Coefficient second, std::span<double> result);
  /// Whether there is anything to compute for fields of these sizes.
  bool coupled(std::initializer_list<std::size_t> sizes) const;

  double dx_, dy_, shear_modulus_, shift_x_, shift_y_;
  std::shared_ptr<const InfluenceKernel> kernel_;
  ToeplitzTransform transform_;
  bool fold_x_, fold_y_;               ///< offsets of both signs follow from the ones >= 0
  std::vector<InfluenceBlock> table_;  ///< empty until needed
  std::array<Spectrum, 9> spectra_;    ///< empty until needed
  Spectrum field_1_, field_2_, sum_;
};

}  // namespace treadmark::kalker
