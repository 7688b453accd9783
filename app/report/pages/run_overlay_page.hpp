// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/report/page.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app::report {

/// Report of runs laid over each other, cases matched by their numbers as compare_results does; each has its name on
/// the page. Errors:
/// Error(configuration) for less than two.
Page run_overlay_page(std::vector<std::pair<std::string, io::RunResult>> runs);

}  // namespace treadmark::app::report
