// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <functional>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"

namespace treadmark::io {

double SimulationSettings::longest_step(double dx) const {
  return std::min(max_step.value_or(std::numeric_limits<double>::infinity()),
                  max_step_elements * dx / highest_speed(profile));
}

namespace {

double read_speed(const TableReader& simulation) {
  simulation.exclude("speed_m_s", "speed_km_h");
  const std::string key = simulation.find("speed_km_h") != nullptr ? "speed_km_h" : "speed_m_s";
  const CaseValue& value = simulation.need(key, "a simulation needs a speed");
  const double speed = simulation.number(key);
  if (!(speed > 0.0))
    throw Error(ErrorKind::configuration, fmt::format("simulation.{} = 0: a simulation needs a speed", key),
                value.where, "for a wheel that stands still use a case file");
  return speed;
}

std::vector<double> increasing(const TableReader& fields, std::string_view key) {
  std::vector<double> values = fields.numbers(key);
  if (std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) != values.end())
    throw Error(ErrorKind::configuration, fmt::format("{} must increase", fields.path_of(key)), fields.need(key).where);
  return values;
}

/// Two lists of the same length, the first one increasing.
std::pair<std::vector<double>, std::vector<double>> read_points(const TableReader& table, std::string_view x,
                                                                std::string_view y) {
  table.need(x);
  table.need(y);
  std::pair<std::vector<double>, std::vector<double>> points{increasing(table, x), table.numbers(y)};
  if (points.first.empty() || points.first.size() != points.second.size())
    throw Error(ErrorKind::configuration,
                fmt::format("{} has {} values, {} has {}", table.path_of(x), points.first.size(), table.path_of(y),
                            points.second.size()),
                table.need(y).where, "give one for each time");
  return points;
}

SpeedProfile read_profile(const TableReader& simulation, double speed) {
  SpeedProfile profile{{0.0}, {speed}};
  const CaseTable* found = simulation.table("speed_profile");
  if (found == nullptr) return profile;
  const TableReader table(*found, simulation.need("speed_profile").where, simulation.path_of("speed_profile"),
                          speed_profile_keys());
  const auto [times, speeds] = read_points(table, "time_s", "speed_m_s");
  for (const double value : speeds)
    if (!(value > 0.0))
      throw Error(ErrorKind::configuration, fmt::format("{} reaches 0", table.path_of("speed_m_s")),
                  table.need("speed_m_s").where, "wheels of a simulation roll");
  if (!(times.front() > 0.0))
    throw Error(ErrorKind::configuration, fmt::format("{} begins at 0", table.path_of("time_s")),
                table.need("time_s").where, "the speed at the start is simulation.speed_m_s");
  profile.time.insert(profile.time.end(), times.begin(), times.end());
  profile.speed.insert(profile.speed.end(), speeds.begin(), speeds.end());
  return profile;
}

WheelContactInput read_wheel(const TableReader& table, std::size_t wheelsets) {
  WheelContactInput wheel;
  wheel.wheelset = table.integer("wheelset") - 1;
  if (static_cast<std::size_t>(wheel.wheelset) >= wheelsets)
    throw Error(ErrorKind::configuration,
                fmt::format("simulation.wheels.wheelset = {}, but the vehicle has {} wheelset{}", wheel.wheelset + 1,
                            wheelsets, wheelsets == 1 ? "" : "s"),
                table.need("wheelset").where, "wheelsets count from 1, the leading one");
  wheel.side = table.text("side") == "left" ? Side::left : Side::right;
  wheel.model = table.text("contact") == "full" ? ContactModelInput::full : ContactModelInput::table;
  wheel.defects = table.flag_or("defects", true);
  wheel.pitch = table.number_if("pitch_deg");
  wheel.full_from = table.number_if("full_from_m");
  wheel.full_to = table.number_if("full_to_m");
  if (!wheel.changes_over()) return wheel;
  const SourcePosition& where = table.need(wheel.full_from ? "full_from_m" : "full_to_m").where;
  if (wheel.model != ContactModelInput::full)
    throw Error(ErrorKind::configuration, "full_from_m and full_to_m belong to a wheel with contact = \"full\"", where);
  constexpr double kShortest = 0.1 - 1e-9;
  if (wheel.full_from && wheel.full_to && !(*wheel.full_to - *wheel.full_from >= kShortest))
    throw Error(ErrorKind::configuration, "full_to_m must lie at least 0.1 m behind full_from_m", where,
                "the contacts go over into each other within 0.05 m at both ends");
  return wheel;
}

}  // namespace

SimulationSettings read_settings(const TableReader& simulation) {
  SimulationSettings s;
  s.speed = read_speed(simulation);
  s.profile = read_profile(simulation, s.speed);
  simulation.exclude("distance_m", "duration_s");
  if (simulation.find("duration_s") != nullptr) {
    s.duration = simulation.number("duration_s");
    s.distance = travel_at(s.profile, s.duration).distance;
  } else {
    simulation.need("distance_m", "say how far, distance_m, or how long, duration_s");
    s.distance = simulation.number("distance_m");
    s.duration = s.profile.time.size() > 1 ? time_at(s.profile, s.distance) : s.distance / s.speed;
  }
  constexpr double kNeverEnds = 1e9;  // [s], [m], as the keys themselves
  if (!(s.duration <= kNeverEnds) || !(s.distance <= kNeverEnds)) simulation.fail("the simulation has no end");
  for (const SettingKey<SimulationSettings>& key : plain_setting_keys())
    if (const CaseValue* value = simulation.checked_if(key.info.path)) key.set(s, *value, {});
  return s;
}

FieldRequests read_fields(const TableReader& simulation) {
  const CaseTable* table = simulation.table("fields");
  if (table == nullptr) return {};
  const TableReader fields(*table, simulation.need("fields").where, simulation.path_of("fields"), field_keys());
  return {increasing(fields, "pitch_deg"), increasing(fields, "position_m")};
}

std::vector<AxleTorque> read_torques(const TableReader& simulation, const VehicleModel& vehicle) {
  std::vector<AxleTorque> torques;
  for (const CaseValue* one : simulation.tables("torques")) {
    const TableReader table(one->table(), one->where, simulation.path_of("torques"), torque_keys());
    AxleTorque& torque = torques.emplace_back();
    torque.where = one->where;
    torque.wheelset = table.integer("wheelset") - 1;
    if (static_cast<std::size_t>(torque.wheelset) >= vehicle.wheelsets.size())
      throw Error(ErrorKind::configuration,
                  fmt::format("{} = {}, but the vehicle has {} wheelset{}", table.path_of("wheelset"),
                              torque.wheelset + 1, vehicle.wheelsets.size(), vehicle.wheelsets.size() == 1 ? "" : "s"),
                  table.need("wheelset").where, "wheelsets count from 1, the leading one");
    std::tie(torque.time, torque.torque) = read_points(table, "time_s", "torque_N_m");
    torque.reaction = table.text("reaction");
    std::vector<std::string> names{kGround};
    for (const BodySpec& body : vehicle.bodies) names.push_back(body.name);
    check_name("body", torque.reaction, names, table.need("reaction").where);
  }
  return torques;
}

std::vector<WheelContactInput> read_wheels(const TableReader& simulation, std::size_t wheelsets) {
  std::vector<WheelContactInput> wheels(2 * wheelsets);
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    wheels[i].wheelset = static_cast<int>(i / 2);
    wheels[i].side = i % 2 == 0 ? Side::left : Side::right;
  }
  std::vector<bool> given(wheels.size());
  for (const CaseValue* one : simulation.tables("wheels")) {
    const TableReader table(one->table(), one->where, simulation.path_of("wheels"), wheel_keys());
    const WheelContactInput wheel = read_wheel(table, wheelsets);
    const std::size_t index = 2 * static_cast<std::size_t>(wheel.wheelset) + (wheel.side == Side::left ? 0 : 1);
    if (given[index])
      table.fail(fmt::format("the {} wheel of wheelset {} is given twice", wheel.side == Side::left ? "left" : "right",
                             wheel.wheelset + 1));
    given[index] = true;
    std::optional<double>& other = wheels[index ^ 1].pitch;
    if (wheel.pitch && other && *other != *wheel.pitch)
      throw Error(ErrorKind::configuration,
                  fmt::format("wheelset {} has two different pitch angles at the start", wheel.wheelset + 1),
                  table.need("pitch_deg").where, "both wheels turn with the axle");
    const std::optional<double> pitch = wheel.pitch ? wheel.pitch : other;
    wheels[index] = wheel;
    wheels[index].pitch = other = pitch;
  }
  return wheels;
}

void read_check_rails(const TableReader& simulation, SimulationFile& out) {
  for (const CaseValue* one : simulation.tables("check_rails")) {
    const TableReader table(one->table(), one->where, simulation.path_of("check_rails"), check_rail_keys());
    CheckRailInput rail;
    rail.side = table.text("side") == "left" ? Side::left : Side::right;
    rail.from = table.number("from_m");
    rail.to = table.number("to_m");
    rail.face_y = table.number("face_y_mm");
    rail.depth = table.number_or("depth_mm", rail.depth);
    rail.stiffness = table.number("stiffness_N_per_m");
    rail.damping = table.number_or("damping_N_s_per_m", rail.damping);
    rail.friction = table.number_or("friction", rail.friction);
    rail.flare_length = table.number_or("flare_m", rail.flare_length);
    rail.flare = table.number_or("flare_mm", rail.flare);
    const auto refuse = [&](std::string_view key, const std::string& message, std::string advice = {}) {
      throw Error(ErrorKind::configuration, message, table.need(key).where, std::move(advice));
    };
    if (!(rail.to > rail.from)) refuse("to_m", "a check rail ends before it begins");
    if (2.0 * rail.flare_length > rail.to - rail.from)
      refuse("flare_m", "the flares at both ends are longer than the check rail");
    constexpr double kMostPush = 5e-3;
    const double back = 0.5 * out.contact.wheelset.flange_back_distance;
    if (rail.face_y > back + kMostPush)
      refuse("face_y_mm",
             fmt::format("the check rail lies {:.4g} mm within the flange of a wheelset in the middle of the track",
                         1e3 * (rail.face_y - back)),
             "the backs of the flanges are wheelset.flange_back_distance_mm apart");
    if (rail.face_y - (rail.flare_length > 0.0 ? rail.flare : 0.0) > back)
      refuse("face_y_mm", "the check rail begins within the flange of a wheelset in the middle of the track",
             "give it flares, flare_m and flare_mm");
    out.check_rails.push_back(rail);
  }
}

}  // namespace treadmark::io
