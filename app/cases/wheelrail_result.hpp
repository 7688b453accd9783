// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::app {

/// The result file's view of the solution of a wheel-rail case, with the stresses below the surface that the case asks
/// for.
io::CaseResult to_result(const io::WheelRailCase& input, const wheelrail::PairSolution& solution);

/// Reads the file of numerical coefficients. Errors: those of the reader.
InfluenceSettings to_influence(const io::InfluenceInput& input);

/// What every contact patch reports: forces, counts and fields. Reference point and kinematics are left to the caller.
io::PatchResult patch_result(const kalker::ContactSolution& solution, const Grid2& grid, const std::vector<double>& gap,
                             const Material& material, const FrictionLaw& friction);

/// Stresses below the surface at the points asked for, into the patch's result. Points under elements that the grid
/// does not have are left out; origin: of free points, in the axes of the grid [m].
void add_subsurface(const io::SubsurfaceInput& input, const Material& material, const Grid2& grid,
                    const kalker::ContactSolution& solution, io::PatchResult& result,
                    const Vec2& origin = Vec2::Zero());

/// The field of dissipation from tractions and slip, after the patch has got its velocity; zero outside contact. None
/// without tractions, and none of a plastic layer, whose shear dissipates too.
void add_dissipation(io::PatchResult& result);

}  // namespace treadmark::app
