// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/app/report/pages/overlay_parts.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app::report {

/// Report of runs laid over each other, cases matched by their numbers as compare_results does. Errors:
/// Error(configuration) for less than two.
Page run_overlay_page(std::vector<Overlaid<io::RunResult>>&& runs);

}  // namespace treadmark::app::report
