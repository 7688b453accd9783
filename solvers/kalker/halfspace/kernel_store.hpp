// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <list>
#include <memory>
#include <optional>
#include <vector>

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"
#include "treadmark/solvers/kalker/halfspace/row_inclination.hpp"

namespace treadmark::kalker {

/// The kernel that a problem asks for.
struct KernelChoice {
  std::shared_ptr<const InfluenceKernel> kernel;
  bool standard = true;  ///< constant elements on half-spaces, whatever K: products within normal and tangential
                         ///< problem are the usual ones
  bool coupled = false;
  /// Angle-corrected coefficients row by row: by what those of the kernel, the half-space's, are turned between rows;
  /// else none.
  std::shared_ptr<const InclinationTable> inclination;

  /// Of `count` rows of a grid from row `first` on; none where coefficients are not turned.
  std::optional<RowInclination> rows(const Grid2& grid, int first, int count) const {
    return inclination ? std::optional(inclination->rows(grid, first, count)) : std::nullopt;
  }

  /// For solvers that know the usual coefficients themselves.
  std::shared_ptr<const InfluenceKernel> unusual() const { return standard ? nullptr : kernel; }
};

/// Kernels made before, so that what is asked for again is the same object. Not thread-safe.
class KernelStore {
 public:
  KernelChoice get(const ContactProblem& problem);

 private:
  struct Entry {
    std::vector<double> numbers;  ///< all that the kernel depends on
    std::shared_ptr<const NumericalInfluence> table;
    KernelChoice choice;
  };
  KernelChoice kernel_of(const ContactProblem& problem, const InfluenceSettings& settings);

  std::list<Entry> entries_;
  InfluenceSettings last_;  ///< inclinations row by row asked for last, and what was made of them
  std::shared_ptr<const InclinationTable> inclination_;
};

}  // namespace treadmark::kalker
