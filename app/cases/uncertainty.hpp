// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app {

/// Adds to the cases of a result of this file that say how well they are known (case.uncertainty), or whose surfaces do
/// (case.error_bars), how well their numbers are; what noise left uncertain of measured profiles, and all that imports
/// of scans tell, are sources, too. The store is that of
/// the run. To first order, by derivatives, which some whole solutions with errors drawn at random are held to; of the
/// numbers that miss them, and of all where there are no derivatives, from a sample of such solutions. The same in
/// every run. A case of which nothing is known says why. After a stop request the other cases have none and the run is
/// not complete.
void add_uncertainty(io::RunResult& result, const io::CaseFile& file, SurfaceStore& store,
                     const Progress& progress = {});

}  // namespace treadmark::app
