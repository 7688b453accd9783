// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/simulations/simulation_model.hpp"

namespace treadmark::app {

/// A result that tells where it comes from: build, input with all its files, settings, values of the study. Nothing
/// else is in it yet. Errors: those of input_hashes. Thread-safe.
io::SimulationResult result_head(const io::SimulationFile& file, const SimulationOptions& options);
io::SimulationResult result_head(const io::CaseFile& file, const SimulationOptions& options);

using FileHashes = std::vector<std::pair<std::string, std::string>>;

/// (name without folders, SHA-256) of every file beside the input file that results depend on: shapes of rails and
/// wheels, tables, vehicle and track, plug-ins that are loaded. Errors: Error(input_data) for files that cannot be
/// read, with the place that names a shape. Thread-safe.
FileHashes input_hashes(const io::SimulationFile& file);
FileHashes input_hashes(const io::CaseFile& file);

}  // namespace treadmark::app
