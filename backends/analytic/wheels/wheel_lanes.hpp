// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::analytic {

/// Plain data for the kernels that find hits of four lines at a time (see core/kernel.hpp); no headers, no functions.

inline constexpr int kWheelLanes = 4;

/// One flat as FlatDepth::Flat has it.
struct FlatLanes {
  bool fresh;
  double sin_center, cos_center, cos_half_angle;
  double depth, chord_radius, wave_number;
  double y_center, half_width, y_wave_number;
};
/// Flats beyond this half angle [rad] are left to the other path.
inline constexpr double kWidestFlatLane = 0.5;

/// One piece of the profile: an arc (see ArcGraph) or a polynomial in (y - x0)/half.
struct PieceLanes {
  static constexpr int kTerms = 9;
  bool arc;
  double y_low, y_high;
  double x0, h0, s0, c0, k;
  double half, c[kTerms];
};

/// What four lines o + t n of one direction share.
struct WheelLanesInput {
  double n_x, n_y, n_z, a;  ///< a = n_x^2 + n_z^2
  double radius, r_max;
  double near;  ///< WheelRay::kNear
  bool exact;   ///< everything at exactly t, else within `near` of it
  PieceLanes piece;
  const FlatLanes* flats;
  int flat_count;
  /// See WheelRay::is_outermost: steepest chords by cell of y, towards where the lines go (null: they do not lean), and
  /// the Lipschitz constants of the flats.
  const double* chords;
  double chords_begin, chords_per_length;
  int chord_cells;
  double max_d_theta, max_d_y;
};

struct WheelLanesHits {
  double o_x[kWheelLanes], o_y[kWheelLanes], o_z[kWheelLanes];
  double t[kWheelLanes];  ///< in: guess, NaN: none; out: height
  double x[kWheelLanes], y[kWheelLanes], z[kWheelLanes], r[kWheelLanes];
  double f_theta[kWheelLanes], f_y[kWheelLanes], depth[kWheelLanes];
};

struct WheelLanesKernel {
  /// Newton's method for all lanes. Returns the lanes, one bit each, that settled on the piece and on the half facing
  /// +n, at what is proven the outermost hit.
  unsigned (*hits)(const WheelLanesInput&, WheelLanesHits&);

  static const WheelLanesKernel generic;
  static const WheelLanesKernel* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::analytic
