// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/report.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"
#include "treadmark/solvers/wheelrail/loads.hpp"

namespace treadmark::vehicle {

/// Motion of a rail's profile origin (rail marker) against its place at rest, track axes [m], [rad], [m/s], [rad/s].
struct RailMotion {
  double y = 0.0, z = 0.0, roll = 0.0;     ///< [m], [rad]
  double vy = 0.0, vz = 0.0, vroll = 0.0;  ///< [m/s], [rad/s]
};

/// One wheelset over one rail at one instant. wheelset.x: distance travelled along the track; velocities are whole ones
/// (x: V and what is added to it; pitch: -V/R and what is added to it).
struct PairMotion {
  double time = 0.0;                                 ///< [s]
  wheelrail::SixMotion wheelset, wheelset_velocity;  ///< [m], [rad], [m/s], [rad/s]
  RailMotion rail;
  double curvature = 0.0;  ///< of the rail in the plane of the track, positive to the right [1/m]
};

/// How a patch's force follows motion, in contact axes: d(force on the rail) = K d(wheel - rail displacement) + C
/// d(velocity), both diagonal. Serves the convergence of implicit steps; the sum of the normal forces is the contact's.
struct PatchTangent {
  Pose X_TC;                                ///< contact axes at the contact point, track axes
  double stiffness_n = 0.0;                 ///< [N/m]
  double damping_x = 0.0, damping_s = 0.0;  ///< of creep [N s/m]
  double normal_force = 0.0;                ///< [N]
};

/// What acts between one wheel and one rail.
struct ContactReaction {
  Status status = Status::ok;  ///< no_contact is not a failure
  std::string message;
  bool derailed = false;                    ///< no solution because wheel and rail have parted
  wheelrail::Wrench on_rail;                ///< track axes; moment about the rail marker [N], [N m]
  wheelrail::Wrench on_wheelset;            ///< track axes; moment about the wheelset's centre [N], [N m]
  double lateral_creep_force = 0.0;         ///< T_y: sum of F_s over the patches, on the rail [N]
  double longitudinal_creep_force = 0.0;    ///< T_x: sum of F_x [N]
  double spin_moment = 0.0;                 ///< of creep, about n, on the rail [N m]; 0 where the element does not know
  double wheelset_z = 0.0;                  ///< where a load was given: the height found [m]
  double normal_force = 0.0;                ///< sum of F_n [N]
  double least_gap = 0.0;                   ///< < 0: greatest penetration [m]
  double give = 0.0;                        ///< how far a rail at rest would still sink under the wheel's load [m]
  double max_pressure = 0.0;                ///< [Pa]; 0 where the element does not know
  double area = 0.0;                        ///< of contact [m2]
  double contact_y = 0.0, contact_x = 0.0;  ///< of the most loaded patch, track axes, x from the axle [m]
  int patches = 0;                          ///< in contact
  int doubts = 0;                           ///< warnings that are grave (model/remarks.hpp)
  double elastic_energy = 0.0;              ///< stored in the contact [J]
  double frictional_power = 0.0;            ///< dissipated, >= 0 [W]
  double rail_power = 0.0;                  ///< of this, by dampers of a rail that bends [W]
  double corrected = 0.0;                   ///< what a linearisation inside the element changed the force by [N]
  double check_force = 0.0;                 ///< of a check rail on the back of the flange, part of both loads [N]
  double full_share = 0.0;  ///< of the full contact, where the element chooses between it and a table; 0 to 1
  double table_error = 0.0, table_wear_error = 0.0;  ///< as TableDeviation, where the element finds it
  RailMotion bending;                                ///< of the rail at the contact, beside the motion of its body
  std::vector<PatchTangent> tangents;
};

/// Whether there is no solution; no contact is one.
inline bool is_unsolved(const ContactReaction& r) {
  return r.status == Status::failed || r.status == Status::not_converged;
}

/// The force element of one wheel on one rail. Not thread-safe.
/// evaluate() may be called for any number of trial states, in any order; each goes on from the instant that was
/// accepted last.
class ContactElement {
 public:
  virtual ~ContactElement() = default;

  /// Errors: Error(configuration) for input that makes no sense; else a status.
  virtual ContactReaction evaluate(const PairMotion& motion) = 0;
  /// Once all wheels have been evaluated, none of which failed, for one wheel after the other: what they do to each
  /// other through a common rail. False: their forces do not agree yet, and all want to be evaluated again.
  virtual bool settle(ContactReaction& evaluated) {
    static_cast<void>(evaluated);
    return true;
  }
  /// What was evaluated last is what the next steps go on from.
  virtual void accept() = 0;

  /// Whether an evaluation takes so long that several of them are worth a thread each.
  virtual bool costly() const { return false; }
  /// How far the next step may go [m].
  virtual double longest_travel() const { return std::numeric_limits<double>::infinity(); }

  /// Everything on which following evaluations depend, to the last bit.
  virtual void save(ByteWriter& out) const = 0;
  /// Errors: Error(input_data) for bytes that are not those of such an element.
  virtual void restore(ByteReader& in) = 0;
};

}  // namespace treadmark::vehicle
