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
  std::filesystem::path submit;  ///< gives both jobs to sbatch; beside them in the folder slurm of the results
  std::size_t tasks = 0;         ///< those with runs that are not finished; 0: there is nothing to solve
};

/// Writes the jobs for the runs that are not finished, and what submits them: the program itself starts no others.
/// Errors: Error(configuration) for names and options that cannot stand in a script.
SlurmScripts write_slurm_scripts(const io::StudyFile& study, const SlurmRequest& request);

/// Numbers of the jobs of a folder, those of the last submission; empty: there are none.
std::vector<std::string> slurm_jobs(const std::filesystem::path& folder);

}  // namespace treadmark::app
