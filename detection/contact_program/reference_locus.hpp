// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/detection/contact_locus.hpp"
#include "treadmark/detection/gap_field.hpp"

namespace treadmark::detection {

/// Lateral rows on which the reference program (CONTACT) looks for contact, and what it takes the wheel's curvature
/// along x from.
struct LocusRows {
  double first = 0.0, step = 0.0;  ///< y in T [m]; step > 0
  int count = 0;
  double nominal_radius = 0.0;  ///< of the wheel [m]
  double roller_radius = 0.0;   ///< of a roller in place of the rail [m], negative: a ring; 0: none
  double y(int i) const { return first + i * step; }
};

/// The contact locus as that program has it: one point per lateral datum of the wheel's profile, a natural spline
/// through them, a gap on rows of one step, and along x a parabola of the nominal radius for every row (Vollebregt 2022
/// on 3D wheel and rail surfaces). On rails that change along the track, and on rollers, the inclination is that of the
/// section at x = 0 nevertheless. Between its rows roughness goes unseen. Only for agreement with its results;
/// ContactLocus is Treadmark's own. Needs a round wheel. Immutable, so at() is thread-safe.
class ReferenceLocus {
 public:
  ReferenceLocus(const BodyPair& bodies, const LocusRows& rows);

  /// Least gap [m]; NaN where the bodies nowhere face each other.
  double least() const { return least_; }

  /// With the wheel moved by wheel_dz [m] along z of T. Near misses: at most two, with a gap below near_miss_gap [m].
  ContactLocus::Found at(double wheel_dz, double near_miss_gap, PenetrationWeight weight,
                         bool reference_at_deepest) const;

 private:
  double gap(int row, double wheel_dz) const;
  bool is_minimum(int row) const;
  ContactPatch near_miss(int row, double wheel_dz) const;
  ContactPatch patch(int first, int last, int deepest, double wheel_dz, PenetrationWeight weight,
                     bool at_deepest) const;
  /// y, z of the rail where the gap changes its sign between a row and the guard row next to it.
  Vec2 crossing(int inside, int guard, double wheel_dz) const;
  /// Parabola through the gaps of a minimum and its neighbours: offset in rows, and the gap there.
  struct Vertex {
    double offset, gap;
  };
  Vertex vertex(int row) const;
  Vec3 deepest_point(int row) const;

  LocusRows rows_;
  std::vector<double> gap_, x_, rail_z_, inclination_;  ///< per row; NaN gap: none
  double least_;
};

}  // namespace treadmark::detection
