// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/backends/create.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::app {

/// A line on a surface along which one of its parameters stays as it is.
struct TraceRequest {
  bool section = true;  ///< constant u, running across with growing y; false: constant v, with growing u
  double at = 0.0;      ///< section: its u [m] or [rad]; else y where the line begins [m]
  /// section: y [m], default: from end to end of the section; else u [m] or [rad], which a line needs
  std::optional<std::pair<double, double>> range;
  double step = 1e-3;  ///< arc length between points, the last step may be shorter [m]
};

struct TracedPoint {
  double s = 0.0;  ///< arc length from the beginning [m]
  double u = 0.0, v = 0.0;
  Vec3 position, normal;                        ///< surface frame [m]; unit, out of the material
  double curvature_1 = 0.0, curvature_2 = 0.0;  ///< principal curvatures [1/m], positive: convex
  double curvature_along = 0.0;                 ///< of the normal section along the line [1/m]
};

struct TracedLine {
  Body body = Body::rail;
  std::string backend;
  bool exact_derivatives = false;  ///< of the representation itself, not differences
  std::vector<TracedPoint> points;
};

/// Arc lengths are integrals of the speed by Gauss's formula of three points a step. Errors: Error(configuration) for a
/// step that is not positive, a range that runs backwards or lacks an end, more than kMostTraced points;
/// Error(input_data) where the line leaves the surface.
TracedLine trace_line(const Surface& surface, Body body, const TraceRequest& request);

inline constexpr double kMostTraced = 1e7;

/// CSV: a line of names with units, mm and degrees where a wheel has angles.
std::string traced_csv(const TracedLine& line);

}  // namespace treadmark::app
