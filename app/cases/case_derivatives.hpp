// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app {

/// Adds derivatives to the cases of a result of this file, by keys of the case file that are numbers, also of list
/// elements ("wheel.flats.0.depth_mm"), and by all parameters of a surface ("rail.shape", "wheel.shape"). No keys:
/// placement, motion, load and friction, as far as a case gives them. The store is that of the run. Every case is
/// solved again, more exactly; what has no derivatives says why, and so does a case that has none. After a stop request
/// the other cases have none and the run is not complete. Errors: Error(configuration) for what is no key or no number,
/// and a key that no case has.
void add_derivatives(io::RunResult& result, const io::CaseFile& file, SurfaceStore& store,
                     const std::vector<std::string>& keys, const Progress& progress = {});

/// The errors that it has, before anything is solved.
void check_derivative_keys(const io::CaseFile& file, const std::vector<std::string>& keys);

}  // namespace treadmark::app
