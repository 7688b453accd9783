// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"

namespace treadmark::app {

/// Solves every case of a file on the threads of the pool. Cases that go on from the one before them in their sequence
/// are solved in order, all others do not influence each other, so that results are the same for any number of threads.
/// A case that fails numerically gets Status::failed and its message; the others go on. A stop request
/// is heard within cases too (core/cancellation.hpp): the result holds the finished ones, in order, and complete =
/// false. Errors: Error for input that cannot be solved at all (configuration, input data).
io::RunResult run_cases(const io::CaseFile& file, const Progress& progress = {});

/// The same with surfaces that were read and built before; the store learns the new ones.
io::RunResult run_cases(const io::CaseFile& file, SurfaceStore& store, const Progress& progress = {});

/// The same cases without error bars, for results of which nobody sees them.
io::CaseFile without_error_bars(io::CaseFile file);

/// A wheel-rail case with its surfaces.
struct CaseGeometry {
  const io::Case* given;  ///< of the file
  wheelrail::Geometry geometry;
};

/// Reads all geometry of a file and builds its surfaces, without solving. Errors as run_cases.
std::vector<CaseGeometry> check_geometry(const io::CaseFile& file);

/// The warnings that runs would give about numbers of the cases (unusual_value), without solving: each text once, with
/// the first case that has it.
std::vector<std::string> value_doubts(const io::CaseFile& file);

}  // namespace treadmark::app
