// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>

#include "treadmark/app/assessment/assess_result.hpp"
#include "treadmark/io/histories/history_model.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// Report of a simulation in time, complete or not, with its snapshots if it has any. document: JSON text, may be
/// empty. assessed: what it says against limits, or nullptr.
report::Page simulation_page(const std::shared_ptr<const io::SimulationResult>& result, std::string document,
                             const AssessedRun* assessed = nullptr);

/// What went wrong in a simulation, and loss of contact. name: of the simulation, where a page has several.
void add_simulation_banners(const io::SimulationResult& result, report::Section& overview,
                            const std::string& name = {});

}  // namespace treadmark::app::pages
