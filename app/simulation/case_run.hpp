// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::app {

/// What the columns of its history and the numbers of its summary are called.
struct RunNames {
  std::vector<std::string> columns, summary;
};
RunNames case_run_names();

/// Solves the cases of a file as one run of a study: its fields as snapshots, a row of history for each case, a summary
/// of all. Errors: as run_cases.
io::SimulationResult run_case_file(const io::CaseFile& file, SurfaceStore& store, const SimulationOptions& options,
                                   const Progress& progress);

}  // namespace treadmark::app
