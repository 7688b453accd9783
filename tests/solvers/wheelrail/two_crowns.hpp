// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::wheelrail::testing {

inline constexpr double kRadius = 0.46, kStep = 0.5e-3, kLayer = 1e-10;  ///< [m], [m], [m/Pa]

/// Two crowns 30 mm apart under a cylinder: two contacts.
inline Geometry two_crowns() {
  constexpr double kCrown = 0.1, kHollow = 0.05, kAngle = 0.1;
  const double width = 2.0 * std::sin(kAngle) * (2.0 * kCrown + kHollow);
  ArcChain rail{-0.5 * width, kCrown * (1.0 - std::cos(kAngle)), -kAngle, {}};
  rail.segments = {{2.0 * kAngle * kCrown, 1.0 / kCrown},
                   {2.0 * kAngle * kHollow, -1.0 / kHollow},
                   {2.0 * kAngle * kCrown, 1.0 / kCrown}};
  return {analytic::make_prismatic_surface(rail),
          analytic::make_revolved_surface(analytic::straight_chain(0.04), kRadius), true, true};
}

inline Problem crowns_problem() {
  Problem p;
  p.track.gauge_based = false;
  p.track.rail_y0 = 0.75;
  p.wheelset = {1.360, -0.070, kRadius, std::nullopt};
  p.discretisation.dx = p.discretisation.ds = kStep;
  p.material.layer_flexibility = kLayer;
  p.friction.kinetic = 10.0;
  p.vertical_force = 8e4;
  p.solver.eps = 1e-8;
  return p;
}

/// How near patches are taken together.
enum class Grouping { apart, parts_of_one, together };

inline void group(Problem& p, Grouping g) {
  p.discretisation.separation = g == Grouping::apart ? 2e-3 : 60e-3;
  p.discretisation.combination = g == Grouping::together ? 60e-3 : 2e-3;
}

}  // namespace treadmark::wheelrail::testing
