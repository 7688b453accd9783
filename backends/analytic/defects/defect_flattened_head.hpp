// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/analytic/arc_graph.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/defects.hpp"

namespace treadmark::analytic {

/// The plane to which a rail head is worn: z = y tan(roll) + level(x), level = touching + depth t^2 (3 - 2 t) on the
/// ramps.
struct HeadPlane {
  double tan_roll = 0.0, touching = 0.0;
  double x_start = 0.0, x_end = 0.0, ramp = 0.0, depth = 0.0;
  double steepest_x = 0.0,
         steepest_y = 0.0;  ///< slopes of the base against the plane where it is cut, over a fine grid
  /// Edges are round where the plane lies less than this share of its own depth above or below the base; 0: sharp.
  double edge = 0.0;

  /// Touching the base where it is highest over the plane's inclination, between x_start and x_end.
  /// Errors: Error(configuration) if the base is nowhere below that stretch, or its edges cannot have their radius.
  HeadPlane(const FlattenedHead& head, const Surface& base);

  /// The level at x in [x_start, x_end].
  Jet level(double x) const;
  /// How far above or below the base the plane lies where its edges begin to be round, for a level.
  Jet rounding(const Jet& level) const { return {edge * (level.h - touching), edge * level.dh, edge * level.ddh}; }
};

}  // namespace treadmark::analytic
