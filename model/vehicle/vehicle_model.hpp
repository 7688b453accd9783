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
  int vehicle = 0;  ///< of a train, which one it belongs to, from 0
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

/// A force that depends on a relative displacement along one axis, body b against body a.
struct BumpStopSpec {
  std::string name, body_a, body_b;
  Vec3 position = Vec3::Zero();      ///< [m]
  Freedom direction = Freedom::y;    ///< x, y or z
  std::vector<double> displacement;  ///< increasing, from >= 0 where it is odd [m]
  std::vector<double> force;         ///< at them [N]; linear between, continued by the last slopes
  SourcePosition where;
  bool odd = true;  ///< the other way the same; else displacements of both signs, no force at 0
};

/// A force that depends on the rate of a relative displacement along one axis, body b against body a; odd.
struct DamperCurveSpec {
  std::string name, body_a, body_b;
  Vec3 position = Vec3::Zero();    ///< [m]
  Freedom direction = Freedom::z;  ///< x, y or z
  std::vector<double> velocity;    ///< increasing from 0 [m/s]
  std::vector<double> force;       ///< at them, from 0, increasing [N]; linear between, continued by the last slope
  double series_stiffness = 0.0;   ///< of a spring in series [N/m]; 0 = none (rigid)
  SourcePosition where;
};

/// Dry friction between the points of two bodies that coincide at rest, in one direction or in two at a time. It sticks
/// as a spring does until its force reaches the bound and slides at this bound then.
struct DryFrictionSpec {
  std::string name, body_a, body_b;
  Vec3 position = Vec3::Zero();              ///< [m]
  std::array<bool, kFreedoms> directions{};  ///< one or two of x, y, z, or one rotation
  double arm = 0.0;                          ///< of a rotation: at which the force acts [m]
  double stiffness = 0.0;                    ///< while it sticks, at this arm [N/m]; > 0
  double damping = 0.0;                      ///< beside the stiffness [N s/m]
  double coefficient = 0.0;                  ///< bound over the normal force while it slides
  std::optional<double> coefficient_back;    ///< of one direction, the other way; none: the same
  double static_ratio = 1.0;                 ///< bound while it sticks over that while it slides; >= 1
  double normal_force = 0.0;                 ///< constant part of it [N]; >= 0
  std::string load_of;      ///< spring whose vertical load, or bump stop whose force, adds to it; empty: none
  double load_share = 1.0;  ///< of that load
  SourcePosition where;
};

/// Gas in a bellows that bears a load along z, and in a reservoir behind an orifice (its pressure falls by the square
/// of the flow). It follows p V^n; the gas that flows keeps its own, as behind a piston without mass.
struct AirSpringSpec {
  std::string name, body_a, body_b;
  Vec3 position = Vec3::Zero();  ///< [m]
  double load = 0.0;       ///< by which springs that bear together share it; pressures follow from shares [N]; > 0
  double area = 0.0;       ///< on which the pressure acts [m2]; > 0
  double bellows = 0.0;    ///< volume of its gas at rest, with what is open to it [m3]; > 0
  double reservoir = 0.0;  ///< volume behind the orifice [m3]; 0: none
  double orifice = 0.0;    ///< diameter [m]; > 0 with a reservoir
  double loss = 0.0;       ///< coefficient: pressure over the dynamic one in the orifice; > 0 with a reservoir
  double exponent = 1.4;   ///< n: 1 isothermal, 1.4 adiabatic air
  SourcePosition where;
};

/// Which body carries a wheelset.
struct WheelsetSpec {
  std::string body;                       ///< its springs hold the axle boxes, which do not turn with the axle
  double nominal_radius = 0.0;            ///< [m]
  std::optional<FlexibleAxle> axle = {};  ///< none: rigid; with it the body must be free in all directions
};

/// What couples two vehicles of a train along x: a spring behind a free play, a damper that acts while the spring does,
/// and friction in its draft gear.
struct CouplerSpec {
  std::string name, rear, front;    ///< bodies of the following and of the leading vehicle
  Vec3 position = Vec3::Zero();     ///< where it acts [m]
  double slack = 0.0;               ///< free play, from push to pull [m]
  std::vector<double> travel;       ///< beyond it, the same in pull and push, from 0, increasing [m]
  std::vector<double> force;        ///< of the spring at them, from 0 [N]; linear between, continued by the last slope
  double damping = 0.0;             ///< [N s/m]; its force is never more than the spring's
  double friction = 0.0;            ///< bound of the friction over the spring's force
  double friction_stiffness = 0.0;  ///< while it sticks [N/m]; > 0 with friction
  SourcePosition where;
};

/// Bodies above the rails and what connects them.
struct VehicleModel {
  std::string name;
  std::vector<BodySpec> bodies;
  std::vector<SpringSpec> springs;
  std::vector<BumpStopSpec> bump_stops;
  std::vector<WheelsetSpec> wheelsets;  ///< leading one first
  std::vector<DamperCurveSpec> damper_curves = {};
  std::vector<DryFrictionSpec> frictions = {};
  std::vector<AirSpringSpec> air_springs = {};
  std::vector<CouplerSpec> couplers = {};  ///< of a train, whose vehicles stand one behind the other
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
