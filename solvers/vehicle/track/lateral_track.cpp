// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track/lateral_track.hpp"

#include <cmath>
#include <string>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {

std::optional<TrackModel> lateral_track(const FlexibleTrack& track) {
  if (!track.lateral) return std::nullopt;
  if (track.seats.size() < 2) throw Error(ErrorKind::configuration, "a flexible track needs at least two seats");
  const LateralSupport& l = *track.lateral;
  const RailSeat& seat = track.seats.front();
  const double bed = seat.pad_stiffness / (track.seats[1].x - seat.x);
  const double point = 2.0 * std::sqrt(2.0) * std::pow(track.rail.bending_stiffness, 0.25) * std::pow(bed, 0.75);
  const double carrying = point / seat.pad_stiffness, foot = l.foot_width * l.foot_width / 12.0;
  constexpr double kRailHeight = 0.09, kFootHeight = 0.17, kSleeperHeight = 0.28, kBedHeight = 0.39;  // [m]
  constexpr auto kSide = static_cast<std::size_t>(Freedom::y), kRoll = static_cast<std::size_t>(Freedom::roll);
  TrackModel below;
  below.name = track.name;
  for (const double side : {-0.5, 0.5}) {
    const std::string name = side < 0.0 ? "left" : "right";
    const double y = side * track.gauge;
    BodySpec rail, sleeper;
    rail.name = name + "_rail";
    rail.mass = l.rail_mass;
    rail.inertia.x() = l.rail_mass * l.roll_inertia;
    rail.position = {0.0, y, kRailHeight};
    rail.free[kSide] = rail.free[kRoll] = true;
    sleeper.name = name + "_sleeper";
    sleeper.mass = l.sleeper_mass;
    sleeper.position = {0.0, y, kSleeperHeight};
    sleeper.free[kSide] = true;
    SpringSpec pad, ballast;
    pad.name = name + "_pad";
    pad.body_a = sleeper.name;
    pad.body_b = rail.name;
    pad.position = {0.0, y, kFootHeight};
    pad.stiffness[kSide] = l.pad_stiffness;
    pad.damping[kSide] = l.pad_damping;
    pad.stiffness[kRoll] = carrying * seat.pad_stiffness * foot;
    pad.damping[kRoll] = carrying * seat.pad_damping * foot;
    ballast.name = name + "_bed";
    ballast.body_a = kGround;
    ballast.body_b = sleeper.name;
    ballast.position = {0.0, y, kBedHeight};
    ballast.stiffness[kSide] = l.bed_stiffness;
    ballast.damping[kSide] = l.bed_damping;
    (side < 0.0 ? below.left_rail : below.right_rail) = rail.name;
    below.bodies.insert(below.bodies.end(), {rail, sleeper});
    below.springs.insert(below.springs.end(), {pad, ballast});
  }
  return below;
}

}  // namespace treadmark::vehicle
