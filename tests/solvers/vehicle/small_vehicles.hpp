// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hertz_spring.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"
#include "treadmark/solvers/vehicle/vehicle_on_track.hpp"

namespace treadmark::vehicle {

inline constexpr double kGravity = 9.81;

inline BodySpec body(std::string name, double mass, Vec3 inertia, Vec3 position, std::array<bool, kFreedoms> free) {
  return {std::move(name), mass, inertia, position, free, {}};
}
inline SpringSpec spring(std::string a, std::string b, Vec3 position, SixValues stiffness, SixValues damping = {},
                         SixValues series = {}) {
  return {a + "-" + b, a, b, position, stiffness, damping, series, {}};
}

inline constexpr std::array<bool, kFreedoms> kVertical{false, false, true, false, false, false};

/// A wheelset that only moves up and down, below a sprung mass.
inline VehicleModel wheel_on_mass(double wheelset_mass, double sprung_mass, double stiffness, double damping) {
  VehicleModel v;
  v.bodies = {body("mass", sprung_mass, {1, 1, 1}, {0, 0, -1.0}, kVertical),
              body("wheelset", wheelset_mass, {1, 1, 1}, {0, 0, -0.46}, kVertical)};
  v.springs = {spring("mass", "wheelset", {0, 0, -0.46}, {0, 0, stiffness, 0, 0, 0}, {0, 0, damping, 0, 0, 0})};
  v.wheelsets = {{"wheelset", 0.46}};
  return v;
}

/// A rail of its own mass below each wheel.
inline TrackModel rails_on_springs(double mass, double stiffness, double damping) {
  TrackModel t;
  for (const char* name : {"left_rail", "right_rail"}) {
    t.bodies.push_back(body(name, mass, {1, 1, 1}, {0, name[0] == 'l' ? -0.75 : 0.75, 0.1}, kVertical));
    t.springs.push_back(spring(name, kGround, {0, 0, 0.2}, {0, 0, stiffness, 0, 0, 0}, {0, 0, damping, 0, 0, 0}));
  }
  t.left_rail = "left_rail";
  t.right_rail = "right_rail";
  return t;
}

/// Steps of one length [s] that nothing but the forces shortens.
inline SimulationSettings equal_steps(double duration, double step, double shortest = 1e-4) {
  SimulationSettings s;
  s.duration = duration;
  s.position_tolerance = 1.0;
  s.max_step = s.first_step = step;
  s.min_step = shortest * step;
  s.max_travel = 1.0;
  s.step.force_tolerance = 1e-6;
  return s;
}

inline VehicleOnTrack on_hertz_springs(const VehicleModel& model, const std::optional<TrackModel>& track, double speed,
                                       double k, double creep = 0.0) {
  VehicleOnTrack v;
  v.system = assemble(model, track, speed, kGravity);
  v.speed = speed;
  for (std::size_t i = 0; i < v.system.wheelsets.size(); ++i)
    for (const auto side : {wheelrail::Side::left, wheelrail::Side::right}) {
      const double y = side == wheelrail::Side::left ? -0.75 : 0.75;
      v.wheels.push_back({static_cast<int>(i), side, side == wheelrail::Side::left ? "left" : "right",
                          std::make_shared<HertzSpring>(k, y, 0.46, creep), Vec3(0.0, y, 0.0)});
    }
  v.connect();
  return v;
}

}  // namespace treadmark::vehicle
