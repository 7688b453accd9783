// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace treadmark::testing {

/// What `treadmark run` says of one position of a wheelset.
struct ToldCase {
  std::string status;
  double pmax_MPa = 0.0;                  ///< largest of all patches
  double y_tr_mm = 0.0, angle_rad = 0.0;  ///< of the patch that carries most
  double noise_MPa = 0.0;                 ///< standard deviation of its pressure that is stated; 0: none
};

/// What a command tells its user.
struct Told {
  int status = -1;
  std::string out, err;
  std::vector<ToldCase> cases;  ///< of run

  bool refused() const { return status >= 2; }
  /// The exit status says that something is wrong or doubtful, and the word is in what was printed.
  bool doubted(const std::string& word = "") const;
};

/// treadmark run CASE with these keys.
Told told_by_run(const std::filesystem::path& file, const std::vector<std::string>& keys);
Told told_by(const std::vector<std::string>& arguments);

}  // namespace treadmark::testing
