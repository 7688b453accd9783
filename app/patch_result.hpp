// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::app {

/// Reads the file of numerical coefficients. Errors: those of the reader.
InfluenceSettings to_influence(const io::InfluenceInput& input);

/// What every contact patch reports: forces, counts and fields. Reference point and kinematics are left to the caller.
io::PatchResult patch_result(const kalker::ContactSolution& solution, const Grid2& grid, const std::vector<double>& gap,
                             const Material& material, const FrictionLaw& friction);

}  // namespace treadmark::app
