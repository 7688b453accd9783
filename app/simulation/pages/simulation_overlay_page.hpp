// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/app/pages/overlay_parts.hpp"
#include "treadmark/io/histories/history_model.hpp"

namespace treadmark::app::pages {

/// Report of simulations laid over each other: columns matched by their names, snapshots by their numbers. Errors:
/// Error(configuration) for less than two.
report::Page simulation_overlay_page(std::vector<Overlaid<io::SimulationResult>>&& simulations);

}  // namespace treadmark::app::pages
