// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace treadmark::bench {

/// A path through the library, ready to be run a chosen number of times so that its instructions can be counted.
struct MeasuredPath {
  std::string unit;                    ///< what is counted: "point", "search", "element", "solve"
  std::size_t units = 1;               ///< in one run
  std::function<void()> run;           ///< once; what it needs was made before
  std::function<std::string()> check;  ///< what is wrong with its answer, or nothing
};

/// Names of all paths, in the order of the table: "heights/wheel/spline/tilted" ...
const std::vector<std::string>& path_names();

/// Makes what a path needs, which is kept for the paths that need it too. Not thread-safe. Throws std::invalid_argument
/// for a name that is not one of these.
MeasuredPath make_path(const std::string& name);

}  // namespace treadmark::bench
