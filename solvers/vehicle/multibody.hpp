// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "treadmark/model/vehicle/vehicle_model.hpp"
#include "treadmark/solvers/vehicle/contact_element.hpp"
#include "treadmark/solvers/vehicle/force_elements.hpp"

namespace treadmark::vehicle {

/// Coordinates of one wheelset and one rail: wheelset x, y, z, roll, pitch, yaw (order of Freedom), rail marker y, z,
/// roll.
inline constexpr int kPairCoordinates = 9;
using PairVector = Eigen::Matrix<double, kPairCoordinates, 1>;
using PairMatrix = Eigen::Matrix<double, kPairCoordinates, kPairCoordinates>;
inline constexpr double kHalfGauge = 0.75;  ///< arm that compares rotations with displacements, moments with forces [m]

/// Generalised forces that a contact reaction exerts on them: their scalar product with the rates is the power of the
/// reaction on both bodies.
PairVector generalised_force(const ContactReaction& reaction, const PairMotion& motion);

/// d(generalised force) = -K d(coordinates) - C d(rates), from the tangents of the patches. K and C are symmetric, not
/// negative.
struct PairTangent {
  PairMatrix stiffness = PairMatrix::Zero(), damping = PairMatrix::Zero();
};
/// rail_marker: profile origin of the rail in track axes at rest [m]; radius: height of the wheelset's centre above the
/// track plane where its z = 0 [m].
PairTangent pair_tangent(const ContactReaction& reaction, const PairMotion& motion, const Vec3& rail_marker,
                         double radius);

/// One coordinate of the whole system.
struct Coordinate {
  int body = -1;  ///< -1: inner end of a damper that has a spring in series; without mass
  Freedom freedom = Freedom::x;
  std::string name;  ///< "bogie1.roll"; a body of the track below wheelset 2: "left_rail@2"
  /// Lengths that a unit of it is worth [m]: 1, of rotations half the gauge; of modes as far as they move.
  double arm = 1.0;
  bool elastic = false;  ///< of a mode of a flexible wheelset, in the direction of its shape: not of the body's centre
  int vehicle = 0;       ///< in Multibody::vehicles
};

/// A force with a characteristic between two bodies.
struct CharacteristicForce {
  Vector direction;  ///< relative displacement by the coordinates of its vehicle
  ForceCurve curve;
  int link = -1;  ///< in Multibody::links
  Freedom freedom = Freedom::x;
  int vehicle = 0;  ///< in Multibody::vehicles
};

/// Equations of motion of vehicle and track about their reference configuration, which travels at constant speed:
///   M q'' + C q' + K q = f + forces of bump stops, force elements and contacts.
/// K q = f holds for a vehicle whose wheelsets cannot move: springs bear their preloads. K contains what these do as
/// bodies lean and move aside (the second order of their potential); weights act at the centres of mass. C contains the
/// gyroscopic coupling of the wheelsets' roll and yaw, that of bending wheelsets included. Immutable.
/// The vehicles of a train have their coordinates one behind the other. M, C and K couple none of different vehicles,
/// so that what is done for each by itself costs as much as there are vehicles.
struct Multibody {
  /// Coordinates of one vehicle, those of the track below it included.
  struct Range {
    int first = 0, size = 0;  ///< the first one, and how many
  };
  std::vector<Range> vehicles;  ///< of a train, the leading one first; one of a single vehicle
  std::vector<Coordinate> coordinates;
  Vector mass;                ///< diagonal of M
  Matrix damping, stiffness;  ///< C, K
  Matrix dissipation;         ///< symmetric part of C: q' . D q' is the power of the dampers
  Vector weight;              ///< f: what wheelsets carry beyond the preloads of their springs
  std::vector<CharacteristicForce> characteristics;
  ForceElements elements;
  std::vector<double> wheelset_load;  ///< vertical load of each wheelset on its two rails [N]
  bool free_along = false;            ///< nothing holds the vehicles to the speed of the reference configuration

  struct Wheelset {
    std::array<int, kFreedoms> coordinate;  ///< -1: not free
    double nominal_radius = 0.0;
    int left_rail = -1, right_rail = -1;  ///< index into rails; -1: rigid
    int body = -1;                        ///< index into bodies
    int vehicle = 0;                      ///< index into vehicles
    /// What a mode of the axle adds to the motion of one wheel, which is rigid: as the motion of a wheelset's centre.
    struct Elastic {
      int coordinate;
      std::array<SixValues, 2> motion;  ///< of the left and the right wheel
    };
    std::vector<Elastic> elastic = {};
  };
  struct Rail {
    std::array<int, 3> coordinate;  ///< of its body: y, z, roll; -1: not free
    Vec3 centre = Vec3::Zero();     ///< of mass, in track axes of the wheelset [m]
  };
  std::vector<Wheelset> wheelsets;
  std::vector<Rail> rails;

  /// What is above the rails, for lines that bend (LineEffects).
  struct Body {
    std::string name;
    double mass = 0.0;
    Vec3 inertia = Vec3::Zero(), position = Vec3::Zero();
    std::array<int, kFreedoms> coordinate{};  ///< -1: not free
    int wheelset = -1;                        ///< which one it is; its springs do not follow its pitch
  };
  /// A point where springs and dampers connect two bodies.
  struct Link {
    int a = -1, b = -1;  ///< in bodies; -1: ground
    Vec3 point = Vec3::Zero();
    double preload = 0.0;     ///< force of its springs on b along z, of a vehicle at rest [N]
    std::string spring = {};  ///< which one it is; empty: none, or below the rails
  };
  /// One spring or damper of a link: what stretches it by the coordinates.
  struct Stretch {
    int link = -1;
    Freedom freedom = Freedom::x;
    std::vector<std::pair<int, double>> direction;
    double value = 0.0;  ///< stiffness or damping
    bool damper = false;
  };
  /// Preloaded springs turn with the mean rotation of what they connect: along their stretch sideways the preload then
  /// has a component. Its potential is value * (turn . q) * (stretch by the coordinates and by the line).
  struct Leaning {
    int link = -1;
    Freedom freedom = Freedom::x;  ///< of the stretch, x or y
    std::vector<std::pair<int, double>> direction, turn;
    double value = 0.0;  ///< [N]
  };
  std::vector<Body> bodies;
  std::vector<Link> links;
  std::vector<Stretch> stretches;
  std::vector<Leaning> leanings;

  int size() const { return static_cast<int>(mass.size()); }
  /// matrix * v, of C, K or another one that couples no coordinates of different vehicles.
  Vector times(const Matrix& matrix, const Vector& v) const;
};

/// What of a vector belongs to a vehicle.
template <class AnyVector>
auto part_of(AnyVector& v, const Multibody::Range& vehicle) {
  return v.segment(vehicle.first, vehicle.size);
}
/// The same of both sides of a matrix.
template <class AnyMatrix>
auto block_of(AnyMatrix& m, const Multibody::Range& vehicle) {
  return m.block(vehicle.first, vehicle.first, vehicle.size, vehicle.size);
}

/// Runs of vehicles that neither of two matrices couples with the others.
std::vector<Multibody::Range> independent_parts(const Multibody& system, const Matrix& one, const Matrix& other);

/// How all coordinates move while vehicles that are free along the track run ahead by 1 m on their wheels: x of bodies
/// by 1, pitch of wheelsets by -1/R. Empty: they are not free.
Vector running_ahead(const Multibody& system);

/// speed [m/s], gravity [m/s2]. Errors: Error(configuration) with the place of the body or spring that makes no sense.
Multibody assemble(const VehicleModel& vehicle, const std::optional<TrackModel>& track, double speed, double gravity);

/// By how much a state displaces a characteristic [m].
double displacement(const Multibody& system, const CharacteristicForce& force, const Vector& q);

/// Generalised force of all characteristics on the bodies, and their energy [J]. offsets: added to their displacements
/// [m], one each; null: none.
Vector characteristic_forces(const Multibody& system, const Vector& q, double* energy = nullptr,
                             const std::vector<double>* offsets = nullptr);

/// What coordinates the pair of a wheelset and one of its rails moves by: pair coordinates = map * q.
/// rail_marker: profile origin of the rail in track axes [m].
Eigen::Matrix<double, kPairCoordinates, Eigen::Dynamic> pair_map(const Multibody& system, int wheelset,
                                                                 wheelrail::Side side, const Vec3& rail_marker);

}  // namespace treadmark::vehicle
