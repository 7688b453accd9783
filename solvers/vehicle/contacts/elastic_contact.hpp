// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/solvers/vehicle/contacts/contact_table.hpp"

namespace treadmark::vehicle {

/// The wheel's profile origin against the rail, rail axes of a right-hand pair turned back by the rail's inclination at
/// rest, from where it stands in the table's central position: displacements [m], relative roll and the wheelset's yaw
/// [rad].
struct RelativePlace {
  double y = 0.0, z = 0.0, roll = 0.0, yaw = 0.0;
};

/// Elastic part of a Hertzian contact from a table. Not in contact: penetration <= 0 and forces 0.
struct ElasticContact {
  double penetration = 0.0;         ///< along the normal [m]
  double slope = 0.0;               ///< tangent of the contact angle against the rail's axes
  double normal_force = 0.0;        ///< [N]
  double energy = 0.0;              ///< [J]
  double stiffness = 0.0;           ///< d(normal force)/d(penetration) [N/m]
  double arm_y = 0.0, arm_z = 0.0;  ///< contact place on the wheel, from its profile origin [m]
  double a = 0.0, b = 0.0;          ///< semi-axes of the ellipse [m]
  bool in_table = true;             ///< false: the table does not reach so far, nothing else is known
};

/// The elastic energy U(y, z, roll) is a function of the place, and the force with its line of action is minus its
/// gradient: whatever path the wheel takes, no work is gained. The lateral force is therefore not read from a table of
/// angles, but follows from the heights as they are interpolated. Between two loads of the table the height is linear
/// in F^(2/3): U is Hertz's 2/5 K p^(5/2) up to the first one. Relative roll moves the contact place sideways and
/// vertically, to first order from the sheets of the nearest rolls; that it inclines the wheel's profile comes out as
/// the gradient of these displacements. All of it runs with continuous slopes. Thread-safe.
ElasticContact elastic_contact(const ContactTable& table, const RelativePlace& place);

/// Where the wheel has this vertical load > 0 [N] without friction: its place z [m]; place.z does not count. Nothing
/// where the table does not reach so far. Thread-safe.
std::optional<double> height_under_load(const ContactTable& table, const RelativePlace& place, double load);

}  // namespace treadmark::vehicle
