// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/vehicle_on_track.hpp"

#include <cmath>
#include <set>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {

void VehicleOnTrack::connect() {
  if (!(speed > 0.0) || !std::isfinite(speed))
    throw Error(ErrorKind::configuration, "the speed must be positive", {},
                "a standing vehicle is a case of `treadmark run`");
  const auto count = system.wheelsets.size();
  if (pitch_at_start.empty()) pitch_at_start.assign(count, 0.0);
  if (pitch_at_start.size() != count)
    throw Error(ErrorKind::configuration, "there must be one pitch for each wheelset");
  std::set<std::pair<int, wheelrail::Side>> places;
  maps.clear();
  for (const WheelOnRail& wheel : wheels) {
    if (wheel.wheelset < 0 || static_cast<std::size_t>(wheel.wheelset) >= count)
      throw Error(ErrorKind::configuration,
                  fmt::format("there is no wheelset {}: the vehicle has {}", wheel.wheelset + 1, count));
    if (!wheel.element)
      throw Error(ErrorKind::configuration, fmt::format("wheel {} has no contact element", wheel.name));
    if (!places.emplace(wheel.wheelset, wheel.side).second)
      throw Error(ErrorKind::configuration, fmt::format("wheel {} has two contact elements", wheel.name));
    const Multibody::Range& own = system.vehicles.at(
        static_cast<std::size_t>(system.wheelsets[static_cast<std::size_t>(wheel.wheelset)].vehicle));
    maps.emplace_back(pair_map(system, wheel.wheelset, wheel.side, wheel.rail_marker).middleCols(own.first, own.size));
  }
  if (places.size() != 2 * count)
    throw Error(ErrorKind::configuration, "every wheelset needs a contact element at both wheels");
}

PairMotion VehicleOnTrack::motion(std::size_t i, const SystemState& state) const {
  if (line) return motion_on_line(i, state);
  const PairVector u = on_pair(i, state.q), du = on_pair(i, state.v);
  const auto set = static_cast<std::size_t>(wheels[i].wheelset);
  const double pitch_rate = -speed / system.wheelsets[set].nominal_radius;
  PairMotion m;
  m.time = state.time;
  m.wheelset = {speed * state.time + u[0],
                u[1],
                u[2],
                u[3],
                u[5],
                wrap_angle(pitch_at_start[set] + pitch_rate * state.time + u[4])};
  m.wheelset_velocity = {speed + du[0], du[1], du[2], du[3], du[5], pitch_rate + du[4]};
  m.rail = {u[6], u[7], u[8], du[6], du[7], du[8]};
  return m;
}

/// Rates of the travel at a place of the axle in its frame. Heave and roll of the frame are those of its rails as well
/// and left out on both sides.
static PairVector travelling_at(const WheelOnLine& on, double y, double z, double radius) {
  const double v = on.travel.speed;
  const RailMotion& rail = on.rail;
  PairVector rates = PairVector::Zero();
  rates[0] = v + on.spin.y() * (z - radius) - on.spin.z() * y;
  rates[4] = -v / radius + on.spin.y();
  rates[5] = on.spin.z();
  rates.tail<3>() = Vec3(rail.vy, rail.vz, rail.vroll);
  return rates;
}

PairMotion VehicleOnTrack::motion_on_line(std::size_t i, const SystemState& state) const {
  const auto set = static_cast<std::size_t>(wheels[i].wheelset);
  const WheelOnLine on = line->wheel(set, wheels[i].side, state.time);
  const PairVector u = on_pair(i, state.q);
  const PairVector rate = on_pair(i, state.v) + travelling_at(on, u[1], u[2], radius(i));
  PairMotion m;
  m.time = state.time;
  // Yaw counts from the rail: a wheelset that follows it does not slip.
  m.wheelset = {on.travel.distance + u[0],
                u[1],
                u[2],
                u[3],
                u[5] - on.rail_yaw,
                wrap_angle(pitch_at_start[set] - on.travel.distance / radius(i) + u[4])};
  m.wheelset_velocity = {rate[0], rate[1], rate[2], rate[3], rate[5], rate[4]};
  m.rail = {on.rail.y + u[6], on.rail.z + u[7], on.rail.roll + u[8], rate[6], rate[7], rate[8]};
  m.curvature = on.curvature;
  return m;
}

double VehicleOnTrack::mean_speed(const SystemState& state) const {
  double mass = 0.0, momentum = 0.0;
  for (const Multibody::Body& b : system.bodies) {
    mass += b.mass;
    if (b.coordinate[0] >= 0) momentum += b.mass * state.v[b.coordinate[0]];
  }
  return travel(state.time).speed + momentum / mass;
}

PairVector VehicleOnTrack::travelling(std::size_t i, const SystemState& state) const {
  PairVector rates = PairVector::Zero();
  if (!line) {
    rates[0] = speed;
    rates[4] = -speed / radius(i);
    return rates;
  }
  const PairVector u = on_pair(i, state.q);
  const WheelOnLine on = line->wheel(static_cast<std::size_t>(wheels[i].wheelset), wheels[i].side, state.time);
  return travelling_at(on, u[1], u[2], radius(i));
}

Vector VehicleOnTrack::other_forces(const SystemState& state, const std::optional<LineState>& at_line) const {
  Vector forces = characteristic_forces(system, state.q, nullptr, at_line ? &at_line->stop_offsets : nullptr);
  if (line) forces += line->gyroscopic_change(state.v, state.time);
  return forces;
}

ElementResponse VehicleOnTrack::resting_elements(const SystemState& state,
                                                 const std::optional<LineState>& at_line) const {
  const ForceElements& elements = system.elements;
  Vector displacement = elements.of(state.q), rate = elements.of(state.v);
  if (at_line) displacement += at_line->element_stretch, rate += at_line->element_rate;
  return respond(elements, displacement, rate, elements.fresh_memory());
}

double VehicleOnTrack::radius(std::size_t i) const {
  return system.wheelsets[static_cast<std::size_t>(wheels[i].wheelset)].nominal_radius;
}

PairTangent VehicleOnTrack::tangent(std::size_t i, const ContactReaction& reaction, const PairMotion& m) const {
  return pair_tangent(reaction, m, wheels[i].rail_marker, radius(i));
}

}  // namespace treadmark::vehicle
