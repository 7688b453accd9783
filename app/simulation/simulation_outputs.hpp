// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/app/assessment/assess_result.hpp"
#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/report/pictures/histories/patches_svg.hpp"

namespace treadmark::app {

/// Columns and values of a history, and nothing else: those asked for, or all without the motions of the bodies.
io::SimulationResult wheel_columns(const io::SimulationResult& result);

/// Panels of the snapshots of the watched wheel, with the contact at the start as that of a round wheel. They point
/// into the result.
std::vector<pictures::PatchesPanel> patches_panels(const io::SimulationResult& result);

/// simulation.h5 (everything), history.csv (wheel_columns), events.csv, modes.csv, history.svg, and with
/// snapshots fields as pressure.svg, those of the watched wheel with the depth of its defect as patches.svg and
/// patches.csv. Files appear only when complete. Not to be called from two threads at once.
void write_simulation_folder(const std::filesystem::path& folder, const io::SimulationResult& result);

/// Result of a simulation as JSON, without history: what was run, static values, modes, events, summary, times, and
/// what it says against limits, where it was assessed.
std::string to_json(const io::SimulationResult& result, const SimulationTimes& times,
                    const AssessedRun* assessed = nullptr);

/// The same for people.
std::string summary_text(const io::SimulationResult& result);
/// Where the time went, with the share of geometry, normal and tangential problem.
std::string times_text(const SimulationTimes& times);
/// Forces and displacements in static equilibrium.
std::string statics_text(const io::SimulationResult& result);
/// Eigenfrequencies, damping and what moves.
std::string modes_text(const io::SimulationResult& result);

}  // namespace treadmark::app
