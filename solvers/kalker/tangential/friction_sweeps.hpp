// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>

#include "treadmark/solvers/kalker/tangential/friction_state.hpp"

namespace treadmark::kalker {

/// Block Gauss-Seidel sweeps over the elements: slow, but hard to stop. In rolling the unknowns are increments along
/// the row: an element in adhesion takes those behind it along, up to the next slip element (Vollebregt 2010). Each
/// element's 2x2 friction problem is solved exactly. Cost of a sweep: the square of the number of elements.
class FrictionSweeps {
 public:
  explicit FrictionSweeps(const PatchOperator& matrix);

  /// Sweeps until the rms change is at most eps times the rms traction, or `count` sweeps are done.
  /// Returns the number of sweeps; traction must respect the bound.
  int run(const FrictionProblem& problem, std::span<double> traction, double eps, int count);

 private:
  void turn_row(int observed);
  /// Coefficients for sources from column 0 of row jy on, seen from an element.
  const Compliance::Entry* coefficients(int ix, int iy, int jy) const;

  Compliance& compliance_;
  const Patch& patch_;
  const RowInclination* rows_;  ///< none unless coefficients are turned row by row
  bool rolling_;
  int width_;  ///< columns of the node array: the box and one column on either side
  std::vector<double> nodes_x_, nodes_y_;
  /// Offsets "observation minus source" in reverse order of x, so that a row of sources is read forwards; for every
  /// difference of rows or, where coefficients are turned, from every row of sources to the row observed at present.
  std::vector<Compliance::Entry> table_;
  int turned_row_ = -1;  ///< the row observed at present
};

/// Argument of the minimum of q.K q/2 + c.q over |q| <= bound, K = diag(k): a traction with slip K q + c.
std::array<double, 2> element_traction(std::array<double, 2> k, std::array<double, 2> c, double bound);

}  // namespace treadmark::kalker
