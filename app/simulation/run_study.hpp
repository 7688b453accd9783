// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/io/files/content_cache.hpp"
#include "treadmark/io/histories/study_model.hpp"
#include "treadmark/io/simulations/study_model.hpp"

namespace treadmark::app {

struct StudyOptions {
  std::filesystem::path folder;           ///< of the results
  std::vector<std::string> settings;      ///< echo of overrides
  bool must_exist = false;                ///< there must be results to go on from
  int workers = 1;                        ///< runs at the same time in this process; 0: none is solved
  io::RunRange share;                     ///< the runs that are to be solved; others are left to others
  std::optional<io::ContentCache> cache;  ///< where tables are kept for other processes
};

struct StudyOutcome {
  io::StudyResult study;  ///< runs of the share that are finished
  std::size_t runs_total = 0, found_finished = 0;
  bool complete = false;
};

/// Solves the runs of a study that are not finished yet. Any number of processes may do so in the same folder at the
/// same time, started by hand, by mpirun or by a batch system, on machines that share it: each takes the next run that
/// nobody works on, and takes over what a process that died has left, from its last checkpoint. Returns when all runs
/// are finished, or after a stop request. A run that fails is a result of its own. Results do not depend on who solved
/// what. Errors: Error(configuration) for a folder that holds another study, and for runs that cannot be simulated at
/// all.
StudyOutcome run_study(const io::StudyFile& study, const StudyOptions& options, const Progress& progress);

/// How far the runs of a study are that other processes may be at. Errors: Error(configuration) where a lock cannot be
/// asked for.
struct StudyState {
  std::vector<int> finished, solved_now, interrupted, not_begun;  ///< numbers of runs; interrupted: with a checkpoint
  bool written = false;                                           ///< there are sweep.h5 and sweep.csv
};
StudyState study_state(const io::StudyFile& study, const std::filesystem::path& folder);

/// sweep.h5, sweep.csv and the figures of a finished study; one process writes them, and the others wait until it has.
void write_study_folder(const io::StudyFile& file, const StudyOptions& options, const io::StudyResult& study);

/// Process of several that were started together (mpirun, srun): 0 of 1 without.
struct ProcessPlace {
  int rank = 0, count = 1;
};
ProcessPlace process_place();

}  // namespace treadmark::app
