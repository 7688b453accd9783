// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/io/simulations/study_model.hpp"

namespace treadmark::app {

/// A study as jobs of Slurm: an array whose tasks solve shares of the runs, and one that gathers them behind it.
struct SlurmRequest {
  std::filesystem::path program, study, folder;  ///< folder: of the results
  std::vector<std::string> settings;             ///< overrides of keys
  std::vector<std::string> options;              ///< of sbatch, "--partition=short"; for both jobs
  int tasks = 1000;                              ///< at most; as many as Slurm lets an array have
  std::filesystem::path report;                  ///< of the gathered study; empty: none
};

struct SlurmScripts {
  std::filesystem::path array, merge;  ///< to be given to sbatch; in the folder slurm of the results
  std::size_t tasks = 0;               ///< those with runs that are not finished; 0: there is nothing to solve
};

/// Writes both scripts for the runs that are not finished. Errors: Error(configuration) for names and options that
/// cannot stand in a script.
SlurmScripts write_slurm_scripts(const io::StudyFile& study, const SlurmRequest& request);

/// Whether programs of Slurm are in the search path.
bool has_slurm();

/// Numbers of the jobs of a folder, those of the last submission; empty: there are none.
std::vector<std::string> slurm_jobs(const std::filesystem::path& folder);

/// Submits the array, and the other job behind it. Errors: Error(configuration) with what sbatch says, and where
/// earlier jobs of the folder still wait or run.
std::vector<std::string> submit_slurm_scripts(const SlurmRequest& request, const SlurmScripts& scripts);

/// What squeue says of these jobs, a line a job or task; empty: they are gone, or there is no squeue.
std::string slurm_queue(const std::vector<std::string>& jobs);

}  // namespace treadmark::app
