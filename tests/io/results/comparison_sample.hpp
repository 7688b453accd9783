// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::testing {

/// Four cases through five candidates: the truth as given; "mesh" at 1 and 0.5 mm, the second with a note, a case that
/// did not converge and one without contact; "spline" as given with an error of zero; and "vdb" that failed. The truth
/// has no contact in case 4. Pressures of mesh: those of the truth (1, 1.2, 1.4 GPa) times 1 + error.
io::Comparison sample_comparison();

/// A row of a comparable case with this error of the largest pressure.
io::ComparisonRow sample_row(int case_number, double pmax_error);

}  // namespace treadmark::testing
