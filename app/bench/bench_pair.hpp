// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/app/bench/bench_scene.hpp"

namespace treadmark::app {

/// Wheel and rail of a scene in one representation.
struct BenchPair {
  std::string backend;
  double resolution = 0.0;  ///< of the samples [m]; 0 = as given
  std::shared_ptr<const Surface> rail, wheel;
  double rail_build_seconds = 0.0, wheel_build_seconds = 0.0;
  bool over_base = false;  ///< see Backend
};

/// Told before every step of the work; false = stop now.
using BenchStep = std::function<bool(const std::string& what)>;
inline constexpr std::size_t kStepsOfPair = 13;  ///< at most

/// Checks both bodies, by check_surface and the short form of conformance, then the search and the undeformed distance;
/// measures what agrees. A row for the rail and one for the wheel; nothing if it was stopped.
std::optional<std::array<BenchRow, 2>> measure_pair(const BenchScene& scene, const BenchPair& pair,
                                                    double seconds_per_measure, const BenchStep& step);

}  // namespace treadmark::app
