// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "treadmark/solvers/vehicle/contacts/contact_table.hpp"

namespace treadmark::vehicle {

/// The wheel's profile origin against the rail, rail axes of a right-hand pair turned back by the rail's inclination at
/// rest, from where it stands in the table's central position: displacements [m], relative roll and the wheelset's yaw
/// [rad].
struct RelativePlace {
  double y = 0.0, z = 0.0, roll = 0.0, yaw = 0.0;
};

/// Where a sheet of a table has no more columns.
struct SheetEnd {
  std::size_t sheet;
  double y;  ///< of the wheel at the sheet's roll [m]
};

/// What slides: an ellipse.
struct ElasticPart {
  double normal_force;  ///< [N]
  double angle;         ///< against the rail's axes [rad]
  double arm_y, arm_z;  ///< place on the wheel, from its profile origin [m]
  double a, b;          ///< semi-axes [m]
  double weight;        ///< with which its creep forces count: that of its sheet, 1 where there is one only
  bool strongest;       ///< of its sheet
};

/// Elastic part of a Hertzian contact from a table. Not in contact: penetration <= 0 and forces 0.
struct ElasticContact {
  double penetration = 0.0;         ///< along the normal [m]
  double slope = 0.0;               ///< tangent of the contact angle against the rail's axes
  double normal_force = 0.0;        ///< [N]
  double energy = 0.0;              ///< [J]
  double stiffness = 0.0;           ///< d(normal force)/d(penetration) [N/m]
  double arm_y = 0.0, arm_z = 0.0;  ///< contact place on the wheel, from its profile origin [m]
  double area = 0.0;                ///< of all ellipses [m2]
  double max_pressure = 0.0;        ///< of them [Pa]
  /// Between columns and loads, of up to four sheets: the first 'count' ones.
  std::array<ElasticPart, 16 * kMostParts> parts;
  std::size_t count = 0;
  bool in_table = true;              ///< false: the table does not reach so far or is too coarse, nothing else is known
  std::optional<SheetEnd> end = {};  ///< that is why; none: turned too far, or sheets differ too much
};

/// A table at one lateral place, roll and yaw.
/// The elastic energy U(y, z, roll) is a function of the place, and the force with its line of action is minus its
/// gradient: whatever path the wheel takes, no work is gained. The lateral force is therefore not read from a table of
/// angles, but follows from the heights as they are interpolated. Between two loads of the table the height is linear
/// in F^(2/3): U is Hertz's 2/5 K p^(5/2) up to the first one. Relative roll moves the contact place sideways and
/// vertically, to first order from the sheets of the nearest rolls; that it inclines the wheel's profile comes out as
/// the gradient of these displacements. The energy runs with continuous slopes, forces without jumps. What slides are
/// the contacts of the sheets next to the place, whose creep forces are mixed. Thread-safe.
class LocalContact {
 public:
  /// place.z does not count. The table must outlive this. Takes long where the table has to grow.
  LocalContact(const ContactTable& table, const RelativePlace& place) : LocalContact(table, place, false) {}

  /// False: the table does not reach so far, or its sheets differ too much; nothing else is known.
  bool covered() const { return covered_; }
  bool is_at(const RelativePlace& place) const {
    return place.y == place_.y && place.roll == place_.roll && place.yaw == place_.yaw;
  }
  ElasticContact at(double z) const;
  /// Where the wheel has this vertical load > 0 [N] without friction: its place z [m].
  double height_under_load(double load) const;

 private:
  /// A number with its derivatives.
  struct Mixed {
    double value = 0.0, by_y = 0.0, by_roll = 0.0;
  };
  /// Vertical force over the displacement.
  struct Compression {
    double force = 0.0, stiffness = 0.0, energy = 0.0;
    double by_y = 0.0, by_roll = 0.0;  ///< -dU/dy [N], -dU/droll [N m]
    std::size_t level = 0;             ///< the last one, of which 'share' is reached
    double share = 0.0;
  };
  /// Where the place is in a sheet next to it.
  struct Cell {
    const TableStretch* stretch;
    std::size_t column;   ///< the one before the place
    double share;         ///< of the next one
    double weight, turn;  ///< of the sheet; of all its contact angles, by the roll that it lacks [rad]
  };

  /// heavier: with the heavier loads.
  LocalContact(const ContactTable& table, const RelativePlace& place, bool heavier);
  bool mix(bool heavier);
  /// Whether the table has heavier loads, which are not here, for this one.
  bool lacks(double load) const {
    const double most = levels_->back().load;
    return load > most && table_->most_load() > most;
  }
  Compression compress(double z) const;
  void add_parts(const Compression& reached, ElasticContact& c) const;

  const ContactTable* table_;
  RelativePlace place_;
  bool covered_ = false;
  std::optional<SheetEnd> end_;
  const std::vector<LoadLevel>* levels_ = nullptr;  ///< of one sheet, all have the same loads
  Mixed touching_;                                  ///< height of first touch
  std::array<Mixed, ContactTable::kMostLevels> compression_;
  double arm_z_ = 0.0;
  std::array<Cell, 4> cells_{};
  std::size_t cell_count_ = 0;
};

/// LocalContact::at, for one height.
ElasticContact elastic_contact(const ContactTable& table, const RelativePlace& place);

}  // namespace treadmark::vehicle
