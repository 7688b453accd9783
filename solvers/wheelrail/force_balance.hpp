// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <vector>

#include "treadmark/solvers/wheelrail/root_search.hpp"

namespace treadmark::wheelrail {

/// Finds the position z at which a contact force that grows about as penetration^1.5 reaches its target.
/// Works on phi = force^(2/3), which is nearly linear in z, continued below touching by the gap; steps along the slope
/// of the parabola through the last three positions, touching the first of them, to where it meets the target, inside a
/// bracket that only shrinks; bisection when they leave it. A balance is found where the force is that of this meeting:
/// on a spring that is far stiffer than the contact any other force may belong to the same height.
class ForceBalance {
 public:
  enum class State { search, found, no_balance };

  /// What the force has to be: level - spring * z, as of a rail on springs.
  struct Target {
    double level = 0.0;   ///< [N]
    double spring = 0.0;  ///< >= 0 [N/m]
    double at(double z) const { return level - spring * z; }
    /// Where a contact that begins at a height [m] has it, whose force is stiffness * penetration^1.5 [N/m^1.5]: not
    /// below the height where it is no force any more.
    double met(double begins, double stiffness) const;
  };

  /// tolerance relative to the target; stiffness: guess of force / penetration^1.5 [N/m^1.5]; end_slope: of phi near
  /// the target over that from touching on, 0 = unknown. Errors: Error(numerical) for a stiffness that is not positive.
  ForceBalance(Target target, double tolerance, double stiffness, double end_slope = 0.0);

  /// First position to try [m], given where the bodies touch.
  double first(double z_touch);

  /// Takes force [N] (0 without contact) and least gap [m] found at z; next() is then the position to try, or the one
  /// that was found: where contact and target meet, of which z is as near as the tolerance of forces tells.
  State add(double z, double force, double least_gap);
  double next() const { return next_; }
  /// The force [N] where contact and target meet, as far as the last position tells.
  double wanted() const { return target_.at(met_); }
  /// What to begin the next balance with, found at a depth [m] below touching: end_slope as the positions told it, or
  /// as it was given.
  double end_slope(double depth) const;
  /// Forces on both sides of a jump [N].
  double force_below() const { return bracket_.value_below(); }
  double force_above() const { return bracket_.value_above(); }
  /// The side of a jump whose force is nearer to the target; not that without contact.
  double nearer_side() const {
    const auto off = [&](double force) { return std::abs(force - wanted()); };
    return force_below() > 0.0 && off(force_below()) < off(force_above()) ? bracket_.below() : bracket_.above();
  }

  /// The force law changed a little (new tangential forces): keep the slope, forget the bracket.
  void restart();

 private:
  /// About linear in z.
  double phi(double force, double least_gap) const;

  Target target_;
  double tolerance_, stiffness_, end_slope_;
  double next_ = 0.0, met_ = 0.0;
  double reference_ = 0.0;       ///< about the phi of the target
  double slope_ = 0.0;           ///< of phi
  double measured_slope_ = 0.0;  ///< between two positions in contact
  bool from_touching_ = false;   ///< the first of before_ is touching
  struct Point {
    double z, residual;  ///< residual: phi less the reference
  };
  double slope_at(const Point& point) const;

  std::vector<Point> before_;  ///< of this force law, touching included; the last two
  Bracket bracket_;
};

}  // namespace treadmark::wheelrail
