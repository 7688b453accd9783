// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <list>
#include <memory>
#include <vector>

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"

namespace treadmark::kalker {

/// The kernel that a problem asks for.
struct KernelChoice {
  std::shared_ptr<const InfluenceKernel> kernel;
  bool standard = true;    ///< constant elements on half-spaces, whatever K: products within normal and tangential problem are the usual ones
  bool coupled = false;

  /// For solvers that know the usual coefficients themselves.
  std::shared_ptr<const InfluenceKernel> unusual() const { return standard ? nullptr : kernel; }
};

/// Kernels made before, so that what is asked for again is the same object. Not thread-safe.
class KernelStore {
 public:
  KernelChoice get(const ContactProblem& problem);

 private:
  struct Entry {
    std::vector<double> numbers;                    ///< all that the kernel depends on
    std::shared_ptr<const NumericalInfluence> table;
    KernelChoice choice;
  };
  std::list<Entry> entries_;
};

}  // namespace treadmark::kalker
