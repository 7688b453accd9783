// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/model/shape/profile.hpp"

namespace treadmark::measured {

/// How well a curve through exact points is known between them.
struct BetweenPoints {
  std::vector<double> s;  ///< of each point: chord length from the first one [m]
  /// Standard deviation of the curve across itself, midway from each point but the last to the next [m]; 0: known as
  /// well as points are that count as exact, or the next point is near. Empty: everywhere so.
  std::vector<double> deviation;
};

/// Each point is compared with the cubic spline through every second point, the others: what that misses between points
/// twice as far apart, scaled by the square of the distances. Splines miss as much where arcs meet and their curvature
/// jumps (to second order); what bends evenly they know better than that (to fourth order). Where points lie within
/// 0.6 mm no contact feels it. Thread-safe.
BetweenPoints known_between(const Profile& exact);

/// The points with the spline's middles between those where it is not known, and their chord lengths. Thread-safe.
Profile with_middles(const Profile& exact, const BetweenPoints& known, std::vector<double>& s);

}  // namespace treadmark::measured
