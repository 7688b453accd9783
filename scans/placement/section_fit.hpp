// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <span>

#include "treadmark/scans/placement/section.hpp"

namespace treadmark::scans {

/// How steep a section may be to be seen from outside [rad].
inline constexpr double kSteepest = 1.35;

/// The outermost curve through a heap of points (y, v) of all stations, as far as it is no steeper than kSteepest and
/// without gaps: medians in strips of y. Of several pieces the one that reaches farthest out.
/// Errors: Error(input_data) if there is none.
Section outline(std::span<const Vec2> points);

struct SectionFit {
  Section section;
  double scale = 0.0;   ///< robust standard deviation of the distances of the points from it [m]
  double spread = 0.0;  ///< of all points near it, damage included: rms [m]
  std::size_t used = 0;
};

/// Draws the section to where most of the points lie: robust splines of the distances along the normals (Tukey's
/// weights, knots about knot_spacing apart), repeated in rounds. farthest: points beyond do not count [m].
SectionFit fit_section(const Section& start, std::span<const Vec2> points, double farthest, double knot_spacing,
                       int rounds = 4);

/// Values of the four uniform cubic B-splines that are not zero at t in [0, 1) of an interval.
inline std::array<double, 4> cubic_basis(double t) {
  const double o = 1.0 - t;
  return {o * o * o / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0, (4.0 - 6.0 * o * o + 3.0 * o * o * o) / 6.0,
          t * t * t / 6.0};
}

}  // namespace treadmark::scans
