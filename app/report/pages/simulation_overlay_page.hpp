// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/report/page.hpp"
#include "treadmark/io/histories/history_model.hpp"

namespace treadmark::app::report {

/// Report of simulations laid over each other, columns matched by their names; each simulation has its name on the
/// page. Snapshots stay on the pages of the single ones. Errors: Error(configuration) for less than two.
Page simulation_overlay_page(const std::vector<std::pair<std::string, io::SimulationResult>>& simulations);

}  // namespace treadmark::app::report
