// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/app/bench/bench_scene.hpp"
#include "treadmark/core/progress.hpp"

namespace treadmark::app {

/// What is measured, and for how long.
struct BenchSettings {
  std::vector<std::string> backends;              ///< empty = all that the shapes allow
  std::vector<double> resolutions{1e-3, 0.5e-3};  ///< [m]
  double seconds_per_measure = 0.2;               ///< [s]; each time is the median of calls for so long
  BenchGrid grid;
};

/// Wheel and rail of the first case of a file in every backend at every resolution: agreement first, then costs.
/// Formulas and data as given need no samples: their backend appears once without a resolution. What cannot be built,
/// or does not agree, is a row that says why and has no times. Measures on the threads that are allowed when it is
/// called. Errors: those of make_bench_scene; Error(configuration) for unknown backends, bad resolutions or times.
BenchReport bench_surfaces(const io::CaseFile& file, const BenchSettings& settings, const Progress& progress = {});

}  // namespace treadmark::app
