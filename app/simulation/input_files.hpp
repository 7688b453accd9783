// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/simulations/simulation_model.hpp"

namespace treadmark::app {

using FileHashes = std::vector<std::pair<std::string, std::string>>;

/// (name without folders, SHA-256) of every file beside the input file that results depend on: shapes of rails and
/// wheels, tables, vehicle and track. Errors: Error(input_data) for files that cannot be read, with the place that
/// names a shape. Thread-safe.
FileHashes input_hashes(const io::SimulationFile& file);
FileHashes input_hashes(const io::CaseFile& file);

}  // namespace treadmark::app
