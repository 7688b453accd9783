// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/app/design/design_cases.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/simulations/design_model.hpp"
#include "treadmark/model/origin.hpp"

namespace treadmark::app {

struct DesignOptions {
  std::filesystem::path folder;
  std::vector<std::string> settings;  ///< echo of overrides
};

/// A design that was tried.
struct DesignStep {
  int design = 0;             ///< from 1
  std::size_t solutions = 0;  ///< of cases up to here
  double objective = kNaN;    ///< the weighted sum of the goals; NaN: there was no solution
  double violation = kNaN;    ///< of limits, the largest over its size; 0: all are kept
  bool best = false;          ///< better than all before it
  std::string failed;         ///< why there was no solution
};

/// A number of positions or places.
struct DesignedNumber {
  std::string quantity, where;
  double before = kNaN;   ///< of the base
  double after = kNaN;    ///< of the design, as the search knows it
  double written = kNaN;  ///< of a run of designed.toml, which reads the surface that was written
  /// Along the way from the design that was found to where the search started, over the ranges of all that is sought:
  /// by derivatives, and by solutions beside the design.
  double derivative = kNaN, difference = kNaN;
  double disagreement = kNaN;  ///< of both, as a share of the larger one
};

/// What came out.
struct DesignResult : Origin {
  std::string status;  ///< "converged", "stalled", "limit", "infeasible" or "interrupted"
  std::string message;
  std::string method;
  std::size_t cases = 0;             ///< positions
  std::size_t solutions = 0;         ///< of them for the search
  std::size_t check_solutions = 0;   ///< after it: to hold derivatives to
  double start = kNaN, best = kNaN;  ///< of the sum
  double violation = kNaN;           ///< of the best
  bool conicity_differenced = false;
  std::vector<DesignVariable> variables;
  std::vector<double> depth_y, depth;  ///< at the places [m]
  std::vector<DesignStep> history;
  std::vector<DesignedNumber> numbers;
  double disagreement = kNaN;  ///< the largest of the numbers
  std::vector<std::string> warnings, notes;
  std::vector<std::string> files;  ///< that hold the design
};

/// What a design replaces in its folder: no inputs of it.
std::vector<std::string> designed_files(const std::filesystem::path& folder);

/// Seeks the design of a file that makes the sum of its goals least, by gradients, or goes on where the folder says it
/// was stopped: every design that was tried is kept there, and results are the same for any number of interruptions and
/// threads. Then holds its derivatives to solutions and runs the base and what was written. The folder gets the design
/// (DesignCases::written, designed.toml), the best so far after a stop request, and the runs
/// before/ and after/. Errors: those of DesignCases; Error(configuration) where the folder holds another design, or
/// another process is at work in it; Error where the base itself has no solution.
DesignResult run_design(const io::DesignFile& file, const DesignOptions& options, const Progress& progress = {});

// What is written. All of them thread-safe.
std::string design_table(const DesignResult& result);  ///< for a terminal
std::string design_json(const DesignResult& result);
/// history.csv, numbers.csv, design.svg and, last, design.json into the folder.
void write_design_folder(const std::filesystem::path& folder, const DesignResult& result);

}  // namespace treadmark::app
