// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::app {

/// A result that tells where it comes from: build, input with all its files, settings, values of the study. Nothing
/// else is in it yet. Errors: those of input_hashes. Thread-safe.
io::SimulationResult result_head(const io::SimulationFile& file, const SimulationOptions& options);
io::SimulationResult result_head(const io::CaseFile& file, const SimulationOptions& options);

}  // namespace treadmark::app
