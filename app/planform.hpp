// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::app {

/// Takes elements out of the gap (NaN) where the planform forbids contact; divides it into coupled sub-patches.
void restrict_contact(const io::PlanformInput& input, const Grid2& grid, std::vector<double>& gap,
                      kalker::SubPatches& sub_patches);

}  // namespace treadmark::app
