// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/detection/contact_locus.hpp"
#include "treadmark/detection/gap_field.hpp"

namespace treadmark::detection {

class PrunedGap;

/// Lateral rows on which CONTACT looks for contact, and what it takes the wheel's curvature along x from.
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
/// section at x = 0 nevertheless. Between its rows roughness goes unseen. Needs a round wheel. Immutable, so at() is
/// thread-safe.
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

/// Rows between two points in T in which the locus missed contact, or found some where there is none.
struct WrongLocus {
  Vec3 low, high;     ///< deepest points of the outermost rows [m]
  bool grid_decides;  ///< false: no wheel could roll over what was missed
};

/// Compares the contact of a locus with that of a grid, for one position of the bodies. One per thread.
class LocusCheck {
 public:
  /// nominal_radius [m]: of the wheel.
  LocusCheck(const BodyPair& bodies, double nominal_radius) : bodies_(bodies), nominal_radius_(nominal_radius) {}

  /// Whether the patches that were found with the wheel moved by wheel_dz [m] are not those of the grid, which decides.
  bool is_wrong(double wheel_dz, const std::vector<ContactPatch>& found, PrunedGap& gap);
  /// The same where the bodies begin to touch.
  bool is_wrong_at_first(const ReferenceLocus& locus, PenetrationWeight weight, PrunedGap& gap);
  /// What the last question found.
  const std::optional<WrongLocus>& wrong() const { return wrong_; }

 private:
  BodyPair bodies_;
  double nominal_radius_;
  double agreed_ = -kInfinity;  ///< greatest wheel_dz at which locus and grid show the same contact
  std::optional<WrongLocus> wrong_;
};

}  // namespace treadmark::detection
