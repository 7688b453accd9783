// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::app {

/// Stresses below the surface at the points asked for, into the patch's result. Points under elements that the grid
/// does not have are left out; origin: of free points, in the axes of the grid [m].
void add_subsurface(const io::SubsurfaceInput& input, const Material& material, const Grid2& grid,
                    const kalker::ContactSolution& solution, io::PatchResult& result,
                    const Vec2& origin = Vec2::Zero());

/// The field of dissipation from tractions and slip, after the patch has got its velocity; zero outside contact. None
/// without tractions, and none of a plastic layer, whose shear dissipates too.
void add_dissipation(io::PatchResult& result);

}  // namespace treadmark::app
