// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::app {

/// Undeformed distance [m] of a formula at the element centres of a grid.
/// Errors: Error(configuration) if the number of coefficients does not fit the formula or the grid.
std::vector<double> gap_of_formula(const io::GapInput& input, const Grid2& grid);

}  // namespace treadmark::app
