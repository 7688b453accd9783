// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/model/shape/slices.hpp"

namespace treadmark::app {

/// Two sections of a rail that follow each other and begin, or end, at places so far apart that one of them has a part
/// which the other lacks. Without features the surface between them joins what does not belong together.
struct SectionBridge {
  std::size_t first = 0;                        ///< index of the first of the two
  double u_from = 0.0, u_to = 0.0;              ///< where they lie [m]
  bool begins = false;                          ///< they begin apart, else they end apart
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< y and z there [m]
};

/// In order; none where features say what corresponds, and of a wheel. Thread-safe.
std::vector<SectionBridge> section_bridges(const SliceSet& slices);

/// "slices 7 and 8 (x = 114 and 119 mm) begin at y = 20 and -40 mm: ...", and what to do.
std::string to_text(const SectionBridge& bridge);

}  // namespace treadmark::app
