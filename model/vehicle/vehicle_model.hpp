// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/model/vehicle/flexible_axle.hpp"

namespace treadmark {

/// A vehicle and the track below it as plain data in SI units: rigid bodies that move little about a reference
/// configuration, which travels along the track, and what connects them. Axes: x forward, y to the right, z down, z = 0
/// the plane of the rail tops.

/// Displacements and rotations of a body about its centre of mass, in the order of every array of six here.
enum class Freedom : int { x, y, z, roll, pitch, yaw };
/// Number of them.
inline constexpr int kFreedoms = 6;
/// One value a freedom.
using SixValues = std::array<double, kFreedoms>;

/// Name of what does not move (under the track) or moves at the vehicle's speed (elsewhere).
inline constexpr const char* kGround = "ground";

/// A rigid body.
struct BodySpec {
  std::string name;
  double mass = 0.0;             ///< [kg]; > 0
  Vec3 inertia = Vec3::Zero();   ///< about axes x, y, z through the centre of mass [kg m2]; > 0 where it can rotate
  Vec3 position = Vec3::Zero();  ///< centre of mass, of a loaded vehicle at rest [m]
  std::array<bool, kFreedoms> free{};  ///< in the order of Freedom
  SourcePosition where;
};

/// Springs and dampers between the points of two bodies that coincide at rest: one for each direction, one about each
/// axis. Preloads follow from the weights.
struct SpringSpec {
  std::string name, body_a, body_b;  ///< names of bodies, or kGround
  Vec3 position = Vec3::Zero();      ///< [m]
  SixValues stiffness{};             ///< [N/m], [N m/rad]
  SixValues damping{};               ///< [N s/m], [N m s/rad]
  SixValues damper_stiffness{};      ///< of a spring in series with the damper [N/m], [N m/rad]; 0 = none (rigid)
  SourcePosition where;
};

/// A force that depends on a relative displacement along one axis, body b against body a; odd.
struct BumpStopSpec {
  std::string name, body_a, body_b;
  Vec3 position = Vec3::Zero();      ///< [m]
  Freedom direction = Freedom::y;    ///< x, y or z
  std::vector<double> displacement;  ///< increasing from >= 0 [m]
  std::vector<double> force;         ///< at them [N]; linear between, continued by the last slope
  SourcePosition where;
};

/// Which body carries a wheelset.
struct WheelsetSpec {
  std::string body;                       ///< its springs hold the axle boxes, which do not turn with the axle
  double nominal_radius = 0.0;            ///< [m]
  std::optional<FlexibleAxle> axle = {};  ///< none: rigid; with it the body must be free in all directions
};

/// Bodies above the rails and what connects them.
struct VehicleModel {
  std::string name;
  std::vector<BodySpec> bodies;
  std::vector<SpringSpec> springs;
  std::vector<BumpStopSpec> bump_stops;
  std::vector<WheelsetSpec> wheelsets;  ///< leading one first
};

/// The track below one wheelset, moving along with it; there is one of its own for every wheelset. x = 0 below the
/// axle.
struct TrackModel {
  std::string name;
  std::vector<BodySpec> bodies;
  std::vector<SpringSpec> springs;
  std::string left_rail, right_rail;  ///< bodies that carry the rails; empty: rigid track
};

}  // namespace treadmark
