// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::app {

kalker::SolverSettings to_solver_settings(const io::SolverInput& input);
kalker::Regime to_regime(io::RegimeInput input);
kalker::HistoryUse to_history(io::HistoryInput input);
kalker::NormalModel to_normal_model(io::NormalModelInput model);
kalker::TangentialModel to_tangential_model(io::TangentialModelInput model);
/// Reads the file of numerical coefficients. Errors: those of the reader.
kalker::InfluenceSettings to_influence(const io::InfluenceInput& input);

/// What every contact patch reports: forces, counts and fields. Reference point and kinematics are left to the caller.
io::PatchResult patch_result(const kalker::ContactSolution& solution, const Grid2& grid, const std::vector<double>& gap,
                             const Material& material, const FrictionLaw& friction);

}  // namespace treadmark::app
