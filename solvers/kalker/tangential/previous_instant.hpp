// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <list>
#include <span>

#include "treadmark/solvers/kalker/halfspace/influence_operator.hpp"
#include "treadmark/solvers/kalker/halfspace/kernel_store.hpp"
#include "treadmark/solvers/kalker/history/contact_history.hpp"
#include "treadmark/solvers/kalker/tangential/patch_solver.hpp"

namespace treadmark::kalker {

/// Operators on boxes of a grid, kept for the next step. Not thread-safe.
class OperatorStore {
 public:
  InfluenceOperator& get(int nx, int ny, const Grid2& grid, double shear_modulus,
                         const std::shared_ptr<const InfluenceKernel>& kernel, double shift_x, double shift_y);

 private:
  struct Entry {
    int nx, ny;
    double dx, dy, shear_modulus, shift_x, shift_y;
    std::shared_ptr<const InfluenceKernel> kernel;
    InfluenceOperator product;
  };
  std::list<Entry> entries_;
};

/// What the previous instant and the pressures of this one mean for the tangential problem of a patch: known slip
/// (rolling and shift: minus the displacements of the material a step ago; dissimilar bodies: displacements by
/// pressures), friction and yield stress of the material. previous: on the problem's grid, or empty. pressure: of the
/// grid [Pa].
PatchConditions patch_conditions(const ContactProblem& problem, const Patch& patch, const RollingStep& step,
                                 const KernelChoice& kernel, std::span<const double> pressure,
                                 const ContactHistory& previous, OperatorStore& operators);

/// Tangential displacement of all elements by pressures of dissimilar bodies, added to ux, uy [m].
void add_displacement_by_pressure(const ContactProblem& problem, const KernelChoice& kernel,
                                  std::span<const double> pressure, OperatorStore& operators, std::span<double> ux,
                                  std::span<double> uy);

/// Normal displacement of all elements by tangential tractions of dissimilar bodies [m].
std::vector<double> displacement_by_traction(const ContactProblem& problem, const KernelChoice& kernel,
                                             std::span<const double> px, std::span<const double> py,
                                             OperatorStore& operators);

}  // namespace treadmark::kalker
