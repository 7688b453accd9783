// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/detection/contact_patch.hpp"
#include "treadmark/detection/gap_field.hpp"
#include "treadmark/detection/interpenetration.hpp"
#include "treadmark/detection/reference_change.hpp"
#include "treadmark/detection/sampled_profile.hpp"

namespace treadmark::detection {

/// Where a round wheel comes closest to a prismatic rail: on every circle of the wheel the point whose normal has no
/// part along the rail (Li 2002; Vollebregt 2022 on 3D wheel and rail surfaces). Seen along z of T these points make
/// the wheel's outline over the lateral position, so that the search is one-dimensional; along x the gap is that of the
/// wheel's curvature there. One per thread.
class ContactLocus {
 public:
  /// Whether both shapes are one profile and the rail runs along x of T.
  static bool applies(const BodyPair& bodies);
  /// Whether they are where they may touch, over the extent of grid_T: a wheel beside its flats, a rail beside its
  /// defects. Needs wheel_profile of a wheel that is not round.
  static bool applies_over(const BodyPair& bodies, const Grid2& grid_T);

  /// grid_T: only its extent and lateral step count.
  ContactLocus(const BodyPair& bodies, const Grid2& grid_T);

  /// Least gap [m]; NaN where the bodies nowhere face each other.
  double least() const { return outline_.least; }

  struct Found {
    std::vector<ContactPatch> patches, near_misses;
    double least_gap = 0.0;  ///< of the patches and near misses
    double closest = 0.0;    ///< least gap between the rows as well [m]
  };
  /// With the wheel moved by wheel_dz along z of T. Positions with a gap below look_below are looked at closely.
  Found at(double wheel_dz, double look_below, double near_miss_gap, PenetrationWeight weight,
           bool reference_at_deepest, ReferenceSum* sum = nullptr);

 private:
  /// Rows of y in T.
  struct Rows {
    double first = 0.0, step = 0.0;
    int count = 0;
    double y(int i) const { return first + i * step; }
    friend bool operator==(const Rows&, const Rows&) = default;
  };
  /// Per row: gap there, where along x, the radius of the wheel's curve along x, the rail. NaN gap: none.
  struct Outline {
    Rows rows;
    std::vector<double> gap, x, radius, wheel_z, rail_z, rail_slope;
    double least = 0.0;
    double closest = 0.0;  ///< least gap, between the rows as well [m]
  };
  /// Rows between two rows of the outline.
  struct Fine {
    int first_row, last_row;
    Outline outline;
    SampledProfile profile;
    /// The wheel's curve along x is a circle with a cubic part (a yawed wheel is askew), both measured where bodies
    /// interpenetrate: radius is then that one.
    std::vector<char> measured;  ///< 0: not yet, 1: tried, 2: it was
    std::vector<double> cubic;
  };
  Outline trace(const Rows& rows, const SampledProfile& profile);
  Fine& fine_outline(int first_row, int last_row, int count);
  void measure_curves(Fine& fine, int from, int to) const;
  void weigh_fine(Fine& looked_at, double wheel_dz, double near_miss_gap, PenetrationWeight weight, bool at_deepest,
                  Found& found, ReferenceSum* sum) const;
  void add_rows(const Fine& fine, int first, int last, double wheel_dz, PenetrationWeight weight,
                ReferenceSum& sum) const;

  BodyPair bodies_;
  double x_low_, x_high_;
  double wheel_angle_ = 0.0;  ///< where the wheel's profile is taken [rad]
  Outline outline_;
  std::vector<double> wheel_y_;  ///< y on the profile of the wheel that each row of the outline shows
  std::vector<Fine> fine_;       ///< made before
};

}  // namespace treadmark::detection
