// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

namespace treadmark::bench {

/// Least times of several repetitions [s].
struct LeastTime {
  double cpu, wall;
};

/// One problem on one grid.
struct SolverTime {
  std::string problem;  ///< "normal", "steady, small", "transient step"
  int n = 0;            ///< grid of n x n elements
  int elements = 0;     ///< in contact
  LeastTime time{};
  int iterations = 0;     ///< CG iterations, or Newton steps and sweeps
  double products = 0.0;  ///< time over that of a product with the matrix and one with the preconditioner; 0: normal
  double force_x = 0.0, force_y = 0.0,
         saturation = 0.0;  ///< [N], [-]; saturation: tangential force over friction bound
  bool converged = false;

  double nanoseconds_each() const {
    return 1e9 * time.cpu / (static_cast<double>(elements) * (iterations > 0 ? iterations : 1));
  }
};

/// Normal problem, steady rolling in each regime of creepage, and a step of transient rolling; all but the last from
/// nothing.
std::vector<SolverTime> time_solvers(int n, int repetitions);

/// What a number of threads brings, measured in turns with one thread.
struct ThreadGain {
  std::string problem;
  int elements = 0;                 ///< in contact
  double one = 0.0, several = 0.0;  ///< least wall clock times [s]
  bool equal = false;               ///< bit by bit the same answer, which is looked at before anything is timed
};
std::vector<ThreadGain> gain_by_threads(int n, int threads, int repetitions);

}  // namespace treadmark::bench
