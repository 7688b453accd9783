// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/analysis/geometry/contact_functions.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/model/contact/material.hpp"

namespace treadmark::geometry {

/// What presses a wheelset on its track.
struct AxleLoad {
  double weight = 0.0;  ///< carried by both wheels, in the middle of the axle [N]
  Material material;    ///< elastic constants of rails and wheels
};

/// One side under load: force by statics, and the ellipse of Hertz that it makes. NaN: there is none, see the reason.
struct LoadedSide {
  double normal_force = kNaN;                     ///< negative: the wheel would have to be held down [N]
  double semi_axis_x = kNaN, semi_axis_y = kNaN;  ///< along the track, across it [m]
  double pressure = kNaN;                         ///< the largest [Pa]
  double approach = kNaN;                         ///< of wheel and rail along the normal [m]
  /// By how much the gap of the profiles at the ends of the ellipse is off the parabola that Hertz supposes, of both
  /// ends the more, over the parabola's. 0: curvatures are even; about 1: the ellipse is only a guess.
  double misfit = kNaN;
  /// The approach closes the gap of a second contact too, which carries a part: this one's pressure is less in truth,
  /// that of the second one may be more.
  bool shared = false;
  std::string reason;  ///< why there is no ellipse; else empty
};

/// A wheelset under load at one shift.
struct LoadedPosition {
  LoadedSide right, left;
  double holding_force = kNaN;  ///< to the right, at rail level [N]
  /// Of the middle of the axle by the approaches [m]; without roll the mean of what both sides do by themselves.
  double lowering = kNaN;
  double roll = kNaN;  ///< by which the approaches turn the wheelset, right side down [rad]; NaN where it may not roll
};

/// Forces of both sides by the balance of vertical force, lateral force and roll moment, without friction; places and
/// angles of contact are those without load. Ellipses from the curvatures there: across the track those of both
/// profiles, along it the wheel's (cos(angle) / radius, the rail is straight). Yaw turns the axes of the wheel's
/// curvature against the rail's; that is left out. Errors: Error(configuration) for a weight or elastic constants that
/// make no sense. Thread-safe.
LoadedPosition loaded(const WheelsetOnTrack& wheelset, const Position& position, const AxleLoad& load);

/// Contact over the shift under load.
struct LoadedFunctions {
  AxleLoad load;
  std::vector<LoadedPosition> rows;           ///< of each row of the contact functions
  std::vector<LoadedPosition> before, after;  ///< of both sides of each jump
  double middle = 0.0;                        ///< shift that is looked at closer: the equilibrium, or 0 [m]
  LoadedPosition at_middle;
  double amplitude = 0.0;     ///< of shifts about the middle among which the largest pressure is looked for [m]
  LoadedSide largest;         ///< the side that has it; NaN: none has one
  double largest_y = kNaN;    ///< its shift [m]
  bool largest_right = true;  ///< which side it is
};
LoadedFunctions loaded_functions(const WheelsetOnTrack& wheelset, const ContactFunctions& functions,
                                 const AxleLoad& load, double middle, double amplitude);

}  // namespace treadmark::geometry
