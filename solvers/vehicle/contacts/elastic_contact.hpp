// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>

#include "treadmark/solvers/vehicle/contacts/contact_table.hpp"

namespace treadmark::vehicle {

/// The wheel's profile origin against the rail, rail axes of a right-hand pair turned back by the rail's inclination at
/// rest, from where it stands in the table's central position: displacements [m], relative roll [rad].
struct RelativePlace {
  double y = 0.0, z = 0.0, roll = 0.0;
};

/// What slides: an ellipse.
struct ElasticPart {
  double normal_force;  ///< [N]
  double angle;         ///< against the rail's axes [rad]
  double arm_y, arm_z;  ///< place on the wheel, from its profile origin [m]
  double a, b;          ///< semi-axes [m]
};

/// Elastic part of a Hertzian contact from a table. Not in contact: penetration <= 0 and forces 0.
struct ElasticContact {
  double penetration = 0.0;         ///< along the normal [m]
  double slope = 0.0;               ///< tangent of the contact angle against the rail's axes
  double normal_force = 0.0;        ///< [N]
  double energy = 0.0;              ///< [J]
  double stiffness = 0.0;           ///< d(normal force)/d(penetration) [N/m]
  double arm_y = 0.0, arm_z = 0.0;  ///< contact place on the wheel, from its profile origin [m]
  /// Between columns and loads: the first 'count' ones.
  std::array<ElasticPart, 4 * kMostParts> parts;
  std::size_t count = 0;
  bool in_table = true;  ///< false: the table does not reach so far, nothing else is known
};

/// The elastic energy U(y, z, roll) is a function of the place, and the force with its line of action is minus its
/// gradient: whatever path the wheel takes, no work is gained. The lateral force is therefore not read from a table of
/// angles, but follows from the heights as they are interpolated. Between two loads of the table the height is linear
/// in F^(2/3): U is Hertz's 2/5 K p^(5/2) up to the first one. Relative roll moves the contact place sideways and
/// vertically, to first order; that it inclines the wheel's profile comes out as the gradient of these displacements.
/// Thread-safe.
ElasticContact elastic_contact(const ContactTable& table, const RelativePlace& place);

}  // namespace treadmark::vehicle
