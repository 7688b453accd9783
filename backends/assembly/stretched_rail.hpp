// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "treadmark/core/surface.hpp"

namespace treadmark::assembly {

/// A rail of which only some stretches are in the memory at a time.
struct RailStretches {
  std::string backend;       ///< that all have
  std::vector<double> ends;  ///< x [m], increasing: one more than stretches; the outer two may be infinite
  double y_min = 0.0, y_max = 0.0, z_min = 0.0, z_max = 0.0;  ///< that hold all of it [m]
  /// The surface of a stretch, and some more to both sides: where two meet they must be the same. From any thread; the
  /// same surface each time.
  std::function<std::shared_ptr<const Surface>(std::size_t)> open;
  std::size_t most_open = 16;
};

/// Opens stretches as they are asked for, and drops those that were not asked for longest. Thread-safe as every
/// Surface. Errors: Error(configuration) for ends that do not increase; queries also have those of open().
std::shared_ptr<const Surface> join_stretches(RailStretches stretches);

}  // namespace treadmark::assembly
