// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/wheelrail/configuration.hpp"

namespace treadmark::wheelrail {

class RailMemory;

/// Frames of a right-hand pair (left-hand problems are mirrored first): track T, rail R, rail surface S (R moved back
/// by the wheelset's position along the track, so that a variable rail passes below it), wheelset Ws, wheel profile W,
/// wheel surface A (origin on the axle, pitched).
struct Placement {
  Pose X_TR, X_TS, X_TWs, X_TW, X_TA;
  bool gauge_seen = true;  ///< false: the rail's section ends before it reaches down to where the gauge is measured
};

/// Places rail and wheelset by gauge, cant, flange-back distance and state. The gauge is taken at x = 0 of the rail,
/// and at the wheelset's place where the rail has no section there.
/// memory: of this rail, where many instants follow each other; the placement is the same without. Errors:
/// Error(configuration) if the gauge point cannot be found (profile too low, or gauge height too large).
Placement place(const Geometry& geometry, const Problem& right_hand_problem, RailMemory* memory = nullptr);

/// Where a rail is held by the gauge: lateral position of the gauge point, height of the rail top.
struct GaugePoint {
  double y = 0.0, z_top = 0.0;  ///< [m]
  bool seen = true;             ///< false: the section ends before it reaches so deep, y is that of its end
  double near_top = 0.0;        ///< lateral position of the top, to the nearest point of a section [m]
};
/// Of the section at x [m], in the rail frame turned to the track's orientation. Errors: as place.
GaugePoint gauge_point(const Surface& rail, double cant, const Track& track, double x = 0.0);

/// From where to where a surface goes across the track.
struct LateralRange {
  double y_min = 0.0, y_max = 0.0;  ///< [m]
};
/// Over which the surface is visible along z of frame T, at x_T [m].
LateralRange visible_range(const Surface& surface, const Pose& X_ST, double x_T);

}  // namespace treadmark::wheelrail
