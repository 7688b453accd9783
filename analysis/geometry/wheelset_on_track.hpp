// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "treadmark/analysis/geometry/section.hpp"

namespace treadmark::geometry {

/// One side of a wheelset on its track, in coordinates of a right-hand side: a left one is given as its mirror image.
struct SideInput {
  std::shared_ptr<const Section> wheel;  ///< over its own y; z is the radius, the nominal one added
  std::shared_ptr<const Section> rail;   ///< turned to the track's axes about its origin
  double wheel_y = 0.75;                 ///< of the wheel's origin from the middle of the axle [m]
  double rail_y = 0.75;                  ///< of the rail's origin from the middle of the track [m]
  double rail_cant = 0.0;                ///< by which the section is turned [rad]; only to give back its own axes
  friend bool operator==(const SideInput&, const SideInput&) = default;
};

/// How the wheelset may move while it is shifted.
enum class Roll {
  none,  ///< each side is looked at by itself (EN 15302)
  free,  ///< it rolls until both sides touch
};

/// Which end of a profile lies where a contact would be.
enum class ProfileEnd { none, wheel_flange, wheel_field, rail_gauge, rail_field };

/// Where wheel and rail are closest on one side. Signs are those of a right-hand side, also on the left.
struct Touch {
  double wheel_y = 0.0;               ///< on the wheel's profile [m]
  double rail_y = 0.0;                ///< on the rail's profile, in its own axes [m]
  double track_y = 0.0;               ///< from the middle of the track, outwards [m]
  double track_z = 0.0;               ///< of the rail there; 0 is the rail's top [m]
  double gap = 0.0;                   ///< vertical distance of the wheelset in its position before it is lowered [m]
  double radius = 0.0;                ///< of the wheel there [m]
  double angle = 0.0;                 ///< inclination, positive where the wheel's radius grows towards the flange [rad]
  double wheel_curvature = 0.0;       ///< across the profile, positive for convex [1/m]
  double rail_curvature = 0.0;        ///< the same
  ProfileEnd end = ProfileEnd::none;  ///< none: the surfaces are tangent there
  bool climbed = false;               ///< it lies beyond where the flange is inclined by 45 degrees, towards its tip
  bool slipping = false;              ///< it lies on the steep outer edge of the wheel
};

/// A wheelset on its track.
struct Position {
  double y = 0.0;     ///< shift to the right, at rail level [m]
  double roll = 0.0;  ///< about the point at rail level, right side down [rad]
  /// Down, of the middle of the axle: 0 where the mean nominal radius touches the plane of the rail tops. Without roll
  /// the mean of what both sides would have by themselves [m]
  double z = 0.0;
  Touch right, left;
  double radius_difference() const { return right.radius - left.radius; }  ///< right minus left [m]
  /// Whether both contacts are real ones: no profile ends there, no wheel has climbed over its flange or slips off.
  bool sound() const;
};

/// Line along which a rail pushes the wheelset, seen from the point at rail level: y to the right, z down.
struct ForceLine {
  double y, z;                                         ///< where [m]
  double n_y, n_z;                                     ///< direction, a unit
  double moment() const { return y * n_z - z * n_y; }  ///< of a unit of force, right side down [m]
};
ForceLine force_line(const Position& position, bool right);

/// Forces on a wheelset over its weight.
struct Balance {
  double right, left;  ///< normal forces of the rails; negative: the side would have to be held down
  double holding;      ///< what holds it there, to the right
};

/// Rigid contact of a wheelset with two rails of constant section: where both are closest, without forces. Immutable,
/// safe to use from any number of threads.
class WheelsetOnTrack {
 public:
  /// nominal radius: mean of both sides [m]. yaw [rad]: the wheelset turned about the vertical axis; contact then lies
  /// ahead of the axle where the wheel is inclined, exactly so on rails of constant section (the outline of the turned
  /// wheel, seen along the track). Tops of both rails lie in one plane. Errors: Error(configuration) for a missing
  /// section, or one of the other body.
  WheelsetOnTrack(const SideInput& right, const SideInput& left, double nominal_radius, Roll roll, double yaw = 0.0);

  /// At a shift y [m]. start: another position, near it for less work; it changes nothing but last digits.
  /// Never fails: where nothing touches, gap and all that follows are NaN and the position is not sound().
  Position at(double y, const Position* start = nullptr) const;

  /// Where both sides come close, besides where they are closest: local least gaps at most `within` above the least one
  /// and at least 2 mm apart on the wheel. gap: above the least one [m].
  std::vector<Touch> further_touches(const Position& position, bool right, double within) const;

  bool symmetric() const { return symmetric_; }  ///< both sides are the same
  Roll roll() const { return roll_; }
  double nominal_radius() const { return nominal_radius_; }  ///< [m]
  const SideInput& side(bool right) const { return sides_[right ? 0 : 1].input; }

  /// Statics without friction: weight in the middle of the axle, normal forces of both contacts, and a force at rail
  /// level that holds the wheelset there. Not finite where no forces do so.
  Balance balance(const Position& position) const;
  double holding_force(const Position& position) const { return balance(position).holding; }

 private:
  struct Side {
    SideInput input;
    double z_top = 0.0, climb_y = 0.0;
    std::vector<double> y, z, dy, dz;  ///< the wheel's outline along its samples, from the pivot at rail level
  };
  struct Minimum {
    double s = 0.0, gap = 0.0;
    ProfileEnd end = ProfileEnd::none;
  };
  double gap_at(const Side& side, double s, double y, double sin_roll, double cos_roll, double* slope) const;
  void minima(const Side& side, double y, double roll, double within, std::vector<Minimum>& out) const;
  Minimum refined(const Side& side, std::size_t i, double y, double sin_roll, double cos_roll, double enough) const;
  Minimum least(const Side& side, double y, double roll) const;
  Touch touch(const Side& side, const Minimum& at, double y, double roll) const;
  static void outline(const Side& side, double s, std::array<double, 4>& out);

  std::array<Side, 2> sides_;  ///< right, left
  double nominal_radius_;
  Roll roll_;
  double yaw_;
  bool symmetric_;
};

}  // namespace treadmark::geometry
