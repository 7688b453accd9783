// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "treadmark/model/vehicle/driving.hpp"
#include "treadmark/model/vehicle/free_run.hpp"
#include "treadmark/solvers/vehicle/irregularities.hpp"
#include "treadmark/solvers/vehicle/limited_spline.hpp"
#include "treadmark/solvers/vehicle/multibody.hpp"
#include "treadmark/solvers/vehicle/track_path.hpp"

namespace treadmark::vehicle {

/// Where and how a vehicle runs, where that is not along a straight, even track at constant speed.
struct LineSetup {
  std::shared_ptr<const TrackPath> path;                 ///< null: straight and level
  std::shared_ptr<const Irregularities> irregularities;  ///< null: none
  double start = 0.0;                                    ///< place of the vehicle's x = 0 at time 0 [m]
  double gauge_at_rest = 1.435;  ///< at which the rails lie; that of the path counts from it [m]
  double base = 1.5;             ///< of cross level, for the roll of a rail [m]
  double gravity = 9.81;         ///< [m/s2]
  SpeedProfile speed;
  std::optional<FreeRun> free_run;  ///< whose speeds these are: gradients and resistance act on the bodies
  std::vector<AxleTorque> torques;
  std::vector<BodyForce> forces;
  std::vector<SpringMotion> spring_motions;
  std::vector<RailShift> rail_shifts;
  bool stays = false;  ///< runs, but stays at its place: the line never changes
};

/// What the line does to all coordinates at one time.
struct LineState {
  Vector force;                          ///< generalised, of everything [N], [N m]
  Vector spring, damper;                 ///< of this what springs and dampers do that the line stretches
  Vector spring_rate;                    ///< rate of the former [N/s]
  double spring_energy = 0.0;            ///< sum of k u^2/2 of the stretches u by the line [J]
  double damper_power = 0.0;             ///< sum of c u'^2 [W]
  std::vector<double> stop_offsets;      ///< stretches of the bump stops by the line [m]
  Vector element_stretch, element_rate;  ///< of the columns of Multibody::elements by the line [m], [m/s]
  /// What the force of a coupler does beside its column, as the vehicles stand across it in a curve.
  struct Aside {
    int column = 0;                                 ///< the coupler, of Multibody::elements
    std::vector<std::pair<int, double>> direction;  ///< coordinates and their parts of the generalised force
  };
  std::vector<Aside> couplers_aside;
  /// Adds so many times the generalised force of these; element_force: of all columns.
  void add_couplers_aside(const Vector& element_force, double times, Vector& sum) const;
};

/// What the line does at one wheel. The frame is that of the path below the axle.
struct WheelOnLine {
  Travel travel;             ///< of the vehicle
  Vec3 spin = Vec3::Zero();  ///< of the frame, in its axes [rad/s]
  RailMotion rail;           ///< offsets of its rail in the frame and their rates along with the wheel
  double rail_yaw = 0.0;     ///< direction of the rail in the frame [rad]
  double curvature = 0.0;    ///< of the rail in the frame's x-y plane [1/m]
};

/// A line under a vehicle as a function of time. Every body of the vehicle moves little about the path frame below it:
/// forces of inertia and gravity in these frames, springs and dampers stretched because frames of connected bodies
/// differ (exactly, by their poses), their preloads that turn along, gyroscopic moments of the wheelsets, torques on
/// axles, forces from outside, motions of the ground ends of springs and of rails. docs/layout.md has the theory.
/// Immutable; safe to use from several threads.
class LineEffects {
 public:
  /// Errors: Error(configuration) where frames of connected bodies differ by more than kLargestAngle somewhere on the
  /// path, the gauge differs by more than kLargestWidening from that of the rails at rest, or for torques, forces and
  /// motions of what is not there.
  LineEffects(const Multibody& system, LineSetup setup);

  /// At a time >= 0 [s].
  Travel travel(double time) const { return travel_at(setup_.speed, clock(time)); }
  /// What the line does to the vehicle then.
  LineState state(double time) const;
  /// The line at a wheel then.
  WheelOnLine wheel(std::size_t wheelset, wheelrail::Side side, double time) const;
  /// The path frame below the vehicle's x = 0; that of a straight without a path.
  PathPoint point(double time) const;
  /// Generalised force that gyroscopic moments change by because the speed is not that at time 0.
  Vector gyroscopic_change(const Vector& rates, double time) const;

  /// What an instrument feels at a place of the vehicle (of the reference configuration) because of the line, beside
  /// the acceleration against the frame: acceleration of the frame's point less the change of gravity [m/s2].
  Vec3 felt_acceleration(const Vec3& place, double time) const;

  /// How far a step from a time goes at most that would take so long [s]: where two points in time of torques, forces,
  /// motions and speeds are nearer to each other than that, steps end at both, so that no pulse falls between them.
  double step_within(double time, double step) const;

  /// At which the path frame below a place along the vehicle turns, in its axes [rad/s].
  Vec3 frame_spin(double x, double time) const;

  /// As it was given.
  const LineSetup& setup() const { return setup_; }

  static constexpr double kLargestAngle = 0.1;      ///< for which directions of springs are still those of both [rad]
  static constexpr double kLargestWidening = 0.05;  ///< [m]

 private:
  struct Frame;
  double climbing(double x, const Travel& travel) const;
  double held_back(double x, const Travel& travel) const;
  double clock(double time) const { return setup_.stays ? 0.0 : time; }
  Frame frame(double x, const Travel& travel) const;
  void add_inertia(LineState& out, const Travel& travel) const;
  void add_links(LineState& out, const Travel& travel, double time) const;
  void check_curves() const;
  void place_motions(const Multibody& system);
  void gather_points();

  LineSetup setup_;
  Eigen::Index size_ = 0;
  double mass_ = 0.0;  ///< of all bodies [kg]
  std::vector<Multibody::Body> bodies_;
  std::vector<Multibody::Link> links_;
  std::vector<Multibody::Stretch> stretches_;
  std::vector<Multibody::Leaning> leanings_;
  std::vector<std::pair<int, Freedom>> stops_;  ///< link and direction
  std::vector<Multibody::Wheelset> wheelsets_;
  std::vector<ElementColumn> columns_;
  std::vector<std::vector<int>> coupler_columns_;  ///< by link
  std::vector<Vector> force_by_;                   ///< generalised, of the forces from outside for 1 N or N m
  struct MovedLink {
    std::size_t link;
    double sign;  ///< of the stretch by the motion
    LimitedSpline motion;
  };
  std::vector<MovedLink> moved_;
  std::vector<LimitedSpline> shifts_;
  std::vector<std::pair<int, int>> torque_on_;  ///< coordinates of the axle's and the reaction's pitch; -1: none
  std::vector<double> points_;                  ///< in time, increasing [s]
};

}  // namespace treadmark::vehicle
