// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string_view>
#include <vector>

#include "treadmark/solvers/vehicle/track_path.hpp"

namespace treadmark::vehicle {

/// A vehicle as a whole, for what curves do to it when it runs steadily: one mass over two rails, whose body leans
/// outwards on its springs.
struct CurvingVehicle {
  double mass = 0.0;                ///< [kg]; > 0
  double centre_height = 0.0;       ///< of the centre of mass above the rail tops [m]; > 0
  double roll_flexibility = 0.0;    ///< s: lean of the mass over the angle of the cant on which it stands [-]; >= 0
  double roll_centre_height = 0.0;  ///< about which it leans, above the rail tops [m]
  double base = 1.5;                ///< distance of the running circles [m]; > 0
};

/// Where a vehicle is on its line and how fast.
struct CurvingState {
  double speed = 0.0;     ///< V [m/s]; >= 0
  double gravity = 9.81;  ///< g [m/s2]
  Along curvature, cant;  ///< of the line there, signs as in PathPoint [1/m], [m]
};

/// Steady curving in closed form. Lateral quantities are along y of the path frame, positive to the right; cant
/// deficiency has the sign of the curvature where cant is too small. docs/layout.md has the formulas.
struct Curving {
  double equilibrium_cant = 0.0;             ///< base V^2 k / g [m]
  double cant_deficiency = 0.0;              ///< equilibrium cant - cant [m]; negative in a right-hand curve: excess
  double lateral_acceleration = 0.0;         ///< a_q = V^2 k cos(phi) - g sin(phi), in the track plane [m/s2]
  double normal_acceleration = 0.0;          ///< g cos(phi) + V^2 k sin(phi) [m/s2]
  double body_lateral_acceleration = 0.0;    ///< a_q in the plane of the leaning floor [m/s2]
  double body_roll = 0.0;                    ///< of the mass against the track [rad]
  double guiding_force = 0.0;                ///< sum of all lateral forces of the rails on the vehicle [N]
  double left_load = 0.0, right_load = 0.0;  ///< vertical forces of one rail on all its wheels [N]; negative: tilts
  double load_shift = 0.0;                   ///< (left - right) / (left + right) [-]
  double cant_rate = 0.0;                    ///< V dD/ds [m/s]
  double deficiency_rate = 0.0;              ///< V dI/ds [m/s]
};

/// Errors: Error(configuration) for a vehicle, a speed or a gravity that makes no sense.
Curving curving(const CurvingVehicle& vehicle, const CurvingState& state);
/// On a line.
Curving curving(const CurvingVehicle& vehicle, const PathPoint& point, double speed, double gravity = 9.81);

/// Speed at which the inner rail of a curve carries nothing any more [m/s]; infinite on straights and where no speed
/// does it. Errors: as above.
double overturning_speed(const CurvingVehicle& vehicle, double curvature, double cant, double gravity = 9.81);

/// One quantity with its name, whose ending is its unit.
struct NamedNumber {
  std::string_view name;
  double value = 0.0;  ///< in that unit
  std::string_view meaning;
};
/// All of them, in the order of Curving.
std::vector<NamedNumber> named_numbers(const Curving& curving);

}  // namespace treadmark::vehicle
