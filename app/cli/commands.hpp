// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

namespace treadmark::cli {

/// Exit statuses of the program.
enum ExitStatus : int { kOk = 0, kFailed = 1, kUsage = 2, kInputData = 3, kNotConverged = 4 };

struct CommonOptions {
  int threads = 0;     ///< 0 = all cores
  bool quiet = false;  ///< no progress
};

struct RunOptions {
  std::vector<std::string> cases;
  std::string output_folder;   ///< empty = no files
  std::string json_file;       ///< "-" = stdout, empty = none
  std::string backend, wheel_backend, rail_backend;
  std::vector<std::string> overrides;  ///< key=value
};

// Each command returns an exit status or throws treadmark::Error.
int run_command(const RunOptions& options, const CommonOptions& common);
int check_command(const RunOptions& options);
int list_command(const std::string& what);
int schema_command();

}  // namespace treadmark::cli
