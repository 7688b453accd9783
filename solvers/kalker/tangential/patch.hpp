// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/tangential/compliance.hpp"

namespace treadmark::kalker {

/// Two values an element: all x components, then all y components.
using Field2 = std::vector<double>;

/// The elements in contact, in the order in which material passes them: row by row, from the leading to the trailing
/// edge.
struct Patch {
  Grid2 grid;  ///< of the problem
  Transport transport = Transport::none;
  int box_x = 0, box_y = 0;       ///< grid indices of the box's first element
  int box_nx = 0, box_ny = 0;     ///< size of the box; at least one column is free of contact
  std::vector<int> column, row;   ///< grid indices
  std::vector<std::size_t> cell;  ///< index in the box
  std::vector<int> ahead;         ///< element next to it towards the leading edge, -1 if not in contact

  int size() const { return static_cast<int>(cell.size()); }
  std::size_t grid_index(int i) const {
    const auto k = static_cast<std::size_t>(i);
    return grid.index(column[k], row[k]);
  }
};

Patch make_patch(const Grid2& grid, Transport transport, const std::vector<ElementState>& state);

/// Products of a patch's tractions with its coefficients. Not thread-safe.
class PatchOperator {
 public:
  /// Both must outlive the operator. rows: inclinations of the rows of the patch's box by which coefficients are
  /// turned, or none.
  PatchOperator(const Patch& patch, Compliance& compliance, std::optional<RowInclination> rows = {});

  const Patch& patch() const { return patch_; }
  Compliance& compliance() const { return compliance_; }
  const RowInclination* rows() const { return rows_ ? &*rows_ : nullptr; }

  /// Part of the slip distance that is due to tractions: S = W + A p [m].
  void slip(std::span<const double> p, std::span<double> s) { apply(patch_.transport, p, s); }
  /// u = B p [m].
  void displacement(std::span<const double> p, std::span<double> u) { apply(Transport::none, p, u); }
  /// u = B p in every element of the box [m].
  void displacement_of_box(std::span<const double> p, std::span<double> ux, std::span<double> uy);
  /// Approximate inverse of B, restricted to the patch.
  void inverse_displacement(std::span<const double> u, std::span<double> p);

  /// Diagonal of A [m/Pa], mean of both directions.
  double diagonal() const { return diagonal_; }

 private:
  void apply(Transport transport, std::span<const double> p, std::span<double> s);
  /// The product over the box, in out.
  void multiply(Transport transport, std::span<const double> p);
  void scatter(std::span<const double> field);
  void gather(std::span<const double> x, std::span<const double> y, std::span<double> field) const;

  const Patch& patch_;
  Compliance& compliance_;
  std::optional<RowInclination> rows_;
  double diagonal_ = 0.0;
  AlignedVector<double> in_x_, in_y_, out_x_, out_y_, inverse_x_, inverse_y_;
  Field2 last_;  ///< tractions of out; empty = none
  Transport last_transport_ = Transport::none;
};

}  // namespace treadmark::kalker
