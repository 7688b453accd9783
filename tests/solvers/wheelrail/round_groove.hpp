// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"

namespace treadmark::wheelrail::testing {

/// Chain of a circle whose lowest point is the origin.
inline ArcChain round_chain(double radius, double half_angle) {
  return {-radius * std::sin(half_angle),
          -radius * (1.0 - std::cos(half_angle)),
          half_angle,
          {{2.0 * radius * half_angle, -1.0 / radius}}};
}

constexpr double kWheelRadius = 0.42, kTreadRadius = 10e-3;

/// A wheel with a round tread in a groove that fits it nearly, after the deep-groove rolling of Li (2002).
inline Geometry round_groove(double groove_radius) {
  constexpr double kHalfAngle = 1.3;
  return {analytic::make_prismatic_surface(round_chain(groove_radius, kHalfAngle)),
          analytic::make_revolved_surface(round_chain(kTreadRadius, kHalfAngle), kWheelRadius), true, true};
}

inline Problem groove_problem(double penetration) {
  Problem p;
  p.track.gauge_based = false;
  p.wheelset = {0.0, 0.0, kWheelRadius, std::nullopt};
  p.state.position.z = penetration;
  p.state.velocity.x = 0.42;
  p.state.velocity.pitch = -1.0004;
  p.discretisation.dx = 0.15e-3;
  p.discretisation.ds = 0.25e-3;
  p.reference_surface = ReferenceSurface::curved;
  return p;
}

}  // namespace treadmark::wheelrail::testing
