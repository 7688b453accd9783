// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app {

/// Whether a case says how well it is known (case.uncertainty), or is asked what its surfaces say (case.error_bars).
bool wants_error_bars(const io::Case& c);
/// Whether none does, but the import of a surface of one that may be asked tells more of it than scatter. The store is
/// that of a run.
bool may_have_error_bars(const io::CaseFile& file, SurfaceStore& store);

/// Adds to the cases of a result of this file that want error bars how well their numbers are known; what noise left
/// uncertain of measured profiles, and all that imports of scans tell, are sources, too. The store is that of the run.
/// To first order, by derivatives, which some whole solutions with errors drawn at random are held to; of the numbers
/// that miss them, and of all where there are no derivatives, from a sample of such solutions. Costs 8 solutions and
/// two searches for each number and error that is given, of an imported surface some dozens; a sample 200 solutions, 48
/// where only surfaces say how well they are known. The same in every run. A case of which nothing is known says why.
/// After a stop request the other cases have none and the run is not complete.
void add_uncertainty(io::RunResult& result, const io::CaseFile& file, SurfaceStore& store,
                     const Progress& progress = {});

}  // namespace treadmark::app
