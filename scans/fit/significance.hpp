// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "treadmark/scans/fit/level_fit.hpp"

namespace treadmark::scans {

/// Which functions of a level the residuals call for: those whose sum stands out of the noise by itself, and those amid
/// others that do so together (windows along, across and around). factor scales the thresholds; neighbours of chosen
/// functions are chosen too, so that nothing ends abruptly. ridge: for every function the inverse of the variance that
/// coefficients around it seem to have beyond the noise (empirical Bayes), so that functions with few points follow the
/// others. of: how many functions there are among which what is rare is looked for; 0: those of the level. Returns the
/// number of chosen functions and sets level.active.
std::size_t choose_functions(const FunctionSums& sums, double factor, SplineLevel& level, std::vector<float>& ridge,
                             std::size_t of = 0);

}  // namespace treadmark::scans
