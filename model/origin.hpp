// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace treadmark {

/// Where a result comes from.
struct Origin {
  std::string version, git;                                          ///< of the program
  std::string title;                                                 ///< of the input file; empty: it has none
  std::string input_file, input_sha256;                              ///< empty: there is none
  std::vector<std::string> settings;                                 ///< echo of overrides (--set key=value, --backend)
  std::vector<std::pair<std::string, std::string>> geometry_sha256;  ///< (file, hash) of every other file read
  std::vector<std::pair<std::string, std::string>> inputs;  ///< what was asked for: ("track: gauge", "1435 mm")
};

}  // namespace treadmark
