// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::sampling {

/// As often as the last bits of a number far from 0 allow.
inline constexpr int kMostHalvings = 100;

/// The arc length of sections over y: of several at a time the greatest one, piece by piece.
struct LateralArc {
  std::vector<double> y;         ///< from the first to the last at which a section has a surface [m]
  std::vector<double> arc;       ///< from the first one up to each [m]
  double longest_section = 0.0;  ///< arc length of the longest section by itself [m]

  /// Whether there is room for nodes.
  bool has_room() const { return y.size() > 1; }
  /// Errors: Error(configuration) if there is none.
  void require_room() const;
  /// Lateral positions that part it into so many equal steps.
  std::vector<double> nodes(int steps) const;
};

/// Error(configuration): nothing to be sampled.
[[noreturn]] void refuse_empty_range();

/// That of the sections at the given stations from the first to the last y in [y_min, y_max] at which one has a surface
/// (common: all of them), fine enough for steps of the given length [m]. Errors: Error(configuration) if the spacing is
/// not positive, or if nothing limits y.
LateralArc lateral_arc(const Surface& surface, Body body, std::span<const double> stations, double spacing,
                       double y_min, double y_max, bool common = false);

/// Steps of at most the given spacing that a length takes [m].
int steps_along(double length, double spacing);

/// Lateral positions y [m] so that no step along any of the sections at the given stations is longer than spacing [m].
/// Errors: those of lateral_arc, and if no section has a surface.
std::vector<double> lateral_nodes(const Surface& surface, Body body, std::span<const double> stations, double spacing,
                                  double y_min, double y_max, bool common = false);

}  // namespace treadmark::sampling
