// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"
#include "treadmark/model/vehicle/train.hpp"

namespace treadmark::io {

double SimulationSettings::longest_step(double dx) const {
  return std::min(max_step.value_or(std::numeric_limits<double>::infinity()),
                  max_step_elements * dx / highest_speed(profile));
}

namespace {

template <class Root>
std::vector<double> increasing(const TableOf<Root>& table, std::vector<double> Root::*list, const Root& root) {
  const std::vector<double>& values = root.*list;
  if (std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) != values.end())
    table.refuse(list, fmt::format("{} must increase", table.path_of(list)));
  return values;
}

/// Two lists of the same length, the first one increasing. of: what x is, "time".
template <class Root>
void check_points(const TableOf<Root>& table, const Root& root, std::vector<double> Root::*x,
                  std::vector<double> Root::*y, std::string_view of = "time") {
  const std::size_t xs = increasing(table, x, root).size(), ys = (root.*y).size();
  if (xs == 0 || xs != ys)
    table.refuse(y, fmt::format("{} has {} values, {} has {}", table.path_of(x), xs, table.path_of(y), ys),
                 fmt::format("give one for each {}", of));
}

SpeedProfile read_profile(const SimulationTable& simulation, double speed) {
  SpeedProfile profile{{0.0}, {speed}};
  const std::string_view key = simulation.key(setting(&SimulationSettings::profile));
  if (simulation.table(key) == nullptr) return profile;
  using P = SpeedProfile;
  const TableOf table(simulation.need(key), simulation.path_of(key), speed_profile_keys());
  const P later = table.read();
  check_points(table, later, &P::time, &P::speed);
  for (const double value : later.speed)
    if (!(value > 0.0))
      table.refuse(&P::speed, fmt::format("{} reaches 0", table.path_of(&P::speed)), "wheels of a simulation roll");
  if (!(later.time.front() > 0.0))
    table.refuse(&P::time, fmt::format("{} begins at 0", table.path_of(&P::time)),
                 "the speed at the start is simulation.speed_m_s");
  profile.time.insert(profile.time.end(), later.time.begin(), later.time.end());
  profile.speed.insert(profile.speed.end(), later.speed.begin(), later.speed.end());
  return profile;
}

template <class Root>
void check_wheelset(const TableOf<Root>& table, const Root& root, std::size_t wheelsets) {
  if (static_cast<std::size_t>(root.wheelset) >= wheelsets)
    table.refuse(&Root::wheelset,
                 fmt::format("{} = {}, but the vehicle has {} wheelset{}", table.path_of(&Root::wheelset),
                             root.wheelset + 1, wheelsets, wheelsets == 1 ? "" : "s"),
                 "wheelsets count from 1, the leading one");
}

/// A motor hangs on its own vehicle, and not on the axle that it turns.
void check_reaction(const TableOf<AxleTorque>& table, const AxleTorque& torque, const VehicleModel& vehicle) {
  using T = AxleTorque;
  std::vector<std::string> names{kGround};
  for (const BodySpec& body : vehicle.bodies) names.push_back(body.name);
  check_name("body", torque.reaction, names, table.need(&T::reaction).where);
  if (torque.reaction == kGround) return;
  const auto body = [&](const std::string& name) { return ranges::find(vehicle.bodies, name, &BodySpec::name); };
  const std::string& axle = vehicle.wheelsets[static_cast<std::size_t>(torque.wheelset)].body;
  if (torque.reaction == axle)
    table.refuse(&T::reaction,
                 fmt::format("{} = '{}' is the axle that the torque turns", table.path_of(&T::reaction), axle),
                 "name the body that holds motor or brake");
  const int own = body(axle)->vehicle, other = body(torque.reaction)->vehicle;
  if (own != other)
    table.refuse(&T::reaction,
                 fmt::format("{} = '{}' is in vehicle {} of the train, wheelset {} in vehicle {}",
                             table.path_of(&T::reaction), torque.reaction, other + 1, torque.wheelset + 1, own + 1),
                 own == 0 ? "bodies of the leading vehicle are called as in its file"
                          : fmt::format("names of vehicle {0} begin with {1}", own + 1, vehicle_prefix(own)));
}

/// at_m counts from x = 0 of the leading vehicle, also where the body is in another one.
void check_point(const TableOf<BodyForce>& table, const BodyForce& force, const VehicleModel& train) {
  constexpr double kBeyond = 1.0;  // buffers stand out beyond couplers [m]
  const int own = ranges::find(train.bodies, force.body, &BodySpec::name)->vehicle;
  const auto of = [&](const std::string& name) { return ranges::find(train.bodies, name, &BodySpec::name)->vehicle; };
  for (const CouplerSpec& coupler : train.couplers) {
    const double ahead = force.point->x() - coupler.position.x();
    if (!(of(coupler.front) == own && ahead < -kBeyond) && !(of(coupler.rear) == own && ahead > kBeyond)) continue;
    table.refuse(&BodyForce::point,
                 fmt::format("{}: x = {:.6g} m is not in the vehicle of '{}', whose coupler is at {:.6g} m",
                             table.path_of(&BodyForce::point), force.point->x(), force.body, coupler.position.x()),
                 "places of a train count from x = 0 of its leading vehicle");
  }
}

WheelContactInput read_wheel(const TableOf<WheelContactInput>& table, std::size_t wheelsets) {
  using W = WheelContactInput;
  W wheel;
  wheel.defects = true;
  table.read(wheel);
  check_wheelset(table, wheel, wheelsets);
  if (!wheel.changes_over()) return wheel;
  const auto place = wheel.full_from ? &W::full_from : &W::full_to;
  if (wheel.model != ContactModelInput::full)
    table.refuse(place, "full_from_m and full_to_m belong to a wheel with contact = \"full\"");
  constexpr double kShortest = 0.1 - 1e-9;
  if (wheel.full_from && wheel.full_to && !(*wheel.full_to - *wheel.full_from >= kShortest))
    table.refuse(place, "full_to_m must lie at least 0.1 m behind full_from_m",
                 "the contacts go over into each other within 0.05 m at both ends");
  return wheel;
}

}  // namespace

void read_settings(const SimulationTable& simulation, SimulationFile& out) {
  const auto speed = setting(&SimulationSettings::speed);
  const auto distance = setting(&SimulationSettings::distance), duration = setting(&SimulationSettings::duration);
  simulation.need(speed);
  simulation.exclude(distance, duration);
  simulation.read(out);
  SimulationSettings& s = out.settings;
  if (!(s.speed > 0.0))
    simulation.refuse(speed, fmt::format("{} = 0: a simulation needs a speed", simulation.path_of(speed)),
                      "for a wheel that stands still use a case file");
  s.profile = read_profile(simulation, s.speed);
  if (simulation.find(duration) != nullptr) {
    s.distance = travel_at(s.profile, s.duration).distance;
  } else {
    simulation.need(distance);
    s.duration = s.profile.time.size() > 1 ? time_at(s.profile, s.distance) : s.distance / s.speed;
  }
  constexpr double kNeverEnds = 1e9;  // [s], [m], as the keys themselves
  if (!(s.duration <= kNeverEnds) || !(s.distance <= kNeverEnds)) simulation.fail("the simulation has no end");
}

void read_free_run(const SimulationTable& simulation, SimulationFile& out) {
  using F = SimulationFile;
  using S = SimulationSettings;
  const CaseValue* given = simulation.find(&F::free_run);
  if (given == nullptr) return;
  const std::string path = simulation.path_of(&F::free_run);
  const TableOf table(*given, path, free_run_keys());
  const FreeRun& run = out.free_run.emplace(table.read());
  simulation.exclude(&F::free_run, setting(&S::profile));
  simulation.exclude(&F::free_run, setting(&S::duration));
  simulation.exclude(&F::free_run, &F::twist);
  if (!run.place.empty() || !run.gradient.empty())
    check_points(table, run, &FreeRun::place, &FreeRun::gradient, "place");
  S& s = out.settings;
  try {
    s.profile = free_speed(run, {out.vehicle, out.torques, out.forces, s.gravity, out.start}, s.speed, s.distance);
  } catch (const Error& e) {
    throw Error(e.kind(), path + ": " + e.message(), given->where, e.advice());
  }
  s.duration = time_at(s.profile, s.distance);
}

void check_speeds(const SimulationTable& simulation, const SimulationFile& file) {
  if (file.free_run || !runs_free(file.vehicle)) return;
  using S = SimulationSettings;
  constexpr int kParts = 8;  // looked at between two points, between which speeds are parabolas
  const S& s = file.settings;
  const DrivenTrain train{file.vehicle, file.torques, file.forces, s.gravity, file.start};
  const double mass = running_mass(file.vehicle), radius = file.vehicle.wheelsets.front().nominal_radius;
  const std::vector<double> driven = points_in_time(train);
  std::vector<double> times = s.profile.time;
  times.insert(times.end(), driven.begin(), driven.end());
  times.push_back(s.duration);
  std::erase_if(times, [&](double t) { return !(t > 0.0 && t <= s.duration); });
  ranges::sort(times);
  double speed = s.speed, begin = 0.0;
  for (const double end : times) {
    for (int part = 0; part < kParts; ++part) {
      const auto at = [&](double share) { return begin + share / kParts * (end - begin); };
      const double now = at(part + 1);
      speed += impulse(train, at(part), now) / mass;
      const double wanted = travel_at(s.profile, now).speed;
      if (!is_another_speed(speed, wanted)) continue;
      const CaseValue* profile = simulation.find(setting(&S::profile));
      const double change = travel_at(s.profile, at(part + 0.5)).acceleration;
      std::string advice = "give [simulation.free_run]: the speed follows from [[simulation.torques]] then";
      if (change != 0.0)
        advice +=
            fmt::format("; the {:.4g} m/s2 that are wanted take {:.4g} N m in all", change, mass * change * radius);
      throw Error(
          ErrorKind::configuration,
          fmt::format("{} {:.4g} m/s at {:.4g} s, but the vehicles, which nothing holds along the track, run at "
                      "{:.4g} m/s then{}",
                      profile != nullptr ? "simulation.speed_profile wants" : "the speed is to stay", wanted, now,
                      speed, driven.empty() ? ": nothing drives or brakes them" : " under torques and forces along x"),
          profile != nullptr ? profile->where : simulation.where(), std::move(advice));
    }
    begin = end;
  }
}

FieldRequests read_fields(const SimulationTable& simulation) {
  const std::string_view key = simulation.key(&SimulationFile::fields);
  if (simulation.table(key) == nullptr) return {};
  const TableOf table(simulation.need(key), simulation.path_of(key), field_keys());
  FieldRequests fields = table.read();
  for (auto list : {&FieldRequests::pitch, &FieldRequests::position}) increasing(table, list, fields);
  return fields;
}

std::vector<AxleTorque> read_torques(const SimulationTable& simulation, const VehicleModel& vehicle) {
  std::vector<AxleTorque> torques;
  const auto list = &SimulationFile::torques;
  for (const CaseValue* one : simulation.tables(list)) {
    const TableOf table(*one, simulation.path_of(list), torque_keys());
    AxleTorque& torque = torques.emplace_back(table.read());
    torque.where = one->where;
    check_wheelset(table, torque, vehicle.wheelsets.size());
    check_points(table, torque, &AxleTorque::time, &AxleTorque::torque);
    check_reaction(table, torque, vehicle);
  }
  return torques;
}

void read_motions(const SimulationTable& simulation, SimulationFile& out) {
  const auto read_list = [&](auto list, const auto& keys, auto check) {
    for (const CaseValue* one : simulation.tables(list)) {
      const TableOf table(*one, simulation.path_of(list), keys);
      auto& part = (out.*list).emplace_back(table.read());
      part.where = one->where;
      check(table, part);
    }
  };
  const auto check_motion = [](const auto& table, const auto& part) {
    using Part = std::remove_cvref_t<decltype(part)>;
    check_points(table, part, &Part::time, &Part::displacement);
    if (part.time.size() < 2) table.refuse(&Part::time, fmt::format("{} needs two times", table.path_of(&Part::time)));
  };
  // Of parts that say which rails they are for.
  const auto read_rails_below = [&](const auto& table, auto& part) {
    using Part = std::remove_cvref_t<decltype(part)>;
    if (const CaseValue* side = table.checked_if(table.key(&Part::left))) {
      check_name(table.path_of(&Part::left), side->text(), std::vector<std::string>{"left", "right"}, side->where);
      part.left = side->text() == "left";
    }
    if (part.wheelset && static_cast<std::size_t>(*part.wheelset) >= out.vehicle.wheelsets.size())
      table.refuse(&Part::wheelset, fmt::format("{} = {}, but the vehicle has {}", table.path_of(&Part::wheelset),
                                                *part.wheelset + 1, out.vehicle.wheelsets.size()));
  };
  read_list(&SimulationFile::forces, force_keys(), [&](const TableOf<BodyForce>& table, BodyForce& force) {
    using B = BodyForce;
    read_rails_below(table, force);
    const bool on_rails = table.find(&B::body) == nullptr;
    if (on_rails == !force.left || (!on_rails && force.wheelset))
      table.fail(fmt::format("{} acts on a body, or on rails", table.path()),
                 "give body, or side and maybe wheelset of the rails");
    if (!on_rails)
      check_name(table.path_of(&B::body), force.body, names_of(out.vehicle.bodies), table.need(&B::body).where);
    if (on_rails && force.point) table.refuse(&B::point, "a force on rails acts at their centres of mass");
    if (force.point) check_point(table, force, out.vehicle);
    const bool moment = static_cast<int>(force.direction) >= 3;
    if (table.key(&B::force) != (moment ? "moment_N_m" : "force_N") || table.find(&B::force) == nullptr)
      table.fail(fmt::format("{}: {} must be given along with this direction", table.path(),
                             moment ? "moment_N_m" : "force_N"));
    check_points(table, force, &B::time, &B::force);
    if (moment && force.point) table.refuse(&B::point, "a moment acts at no point");
  });
  read_list(&SimulationFile::spring_motions, spring_motion_keys(),
            [&](const TableOf<SpringMotion>& table, const SpringMotion& motion) {
              using M = SpringMotion;
              std::vector<std::string> grounded;
              for (const SpringSpec& s : out.vehicle.springs)
                if (s.body_a == kGround || s.body_b == kGround) grounded.push_back(s.name);
              check_name(table.path_of(&M::spring) + ": the spring on the ground", motion.spring, grounded,
                         table.need(&M::spring).where);
              check_motion(table, motion);
              const SpringSpec& spring = *ranges::find(out.vehicle.springs, motion.spring, &SpringSpec::name);
              const auto along = static_cast<std::size_t>(motion.direction);
              if (spring.stiffness.at(along) == 0.0 && spring.damping.at(along) == 0.0)
                table.refuse(&M::direction,
                             fmt::format("spring '{}' has neither stiffness nor damping along {}: moving its end does "
                                         "nothing",
                                         motion.spring, freedom_word(static_cast<int>(motion.direction))));
            });
  read_list(&SimulationFile::rail_shifts, rail_shift_keys(), [&](const TableOf<RailShift>& table, RailShift& shift) {
    read_rails_below(table, shift);
    check_motion(table, shift);
  });
}

void read_twist(const SimulationTable& simulation, SimulationFile& out) {
  using F = SimulationFile;
  using T = TwistTest;
  const CaseValue* given = simulation.find(&F::twist);
  if (given == nullptr) return;
  const TableOf table(*given, simulation.path_of(&F::twist), twist_keys());
  const T& test = out.twist.emplace(table.read());
  std::vector<double> places;
  for (const WheelsetSpec& wheelset : out.vehicle.wheelsets)
    places.push_back(ranges::find(out.vehicle.bodies, wheelset.body, &BodySpec::name)->position.x());
  if (places.size() % static_cast<std::size_t>(test.wheelsets_per_bogie) != 0)
    table.fail(fmt::format("{} wheelsets are no bogies of {}", places.size(), test.wheelsets_per_bogie),
               "say how many wheelsets a bogie has (wheelsets_per_bogie; 1: single axles)");
  if (test.vehicle == 0.0 && test.bogie == 0.0)
    table.fail(fmt::format("{}: nothing is twisted", table.path()), "give vehicle_per_mille, bogie_per_mille or both");
  constexpr double kSlack = 1e-9;
  if (test.period > out.settings.duration * (1.0 + kSlack))
    table.refuse(&T::period, fmt::format("{} = {:.6g}: the run ends after {:.6g} s", table.path_of(&T::period),
                                         test.period, out.settings.duration));
  for (RailShift& shift : twist_shifts(test, places)) {
    shift.where = given->where;
    out.rail_shifts.push_back(std::move(shift));
  }
}

std::vector<WheelContactInput> read_wheels(const SimulationTable& simulation, const SimulationFile& file) {
  const std::size_t wheelsets = file.vehicle.wheelsets.size();
  std::vector<WheelContactInput> wheels(2 * wheelsets);
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    wheels[i].wheelset = static_cast<int>(i / 2);
    wheels[i].side = i % 2 == 0 ? Side::left : Side::right;
    wheels[i].model = file.settings.contact;
  }
  std::vector<bool> given(wheels.size());
  const auto list = &SimulationFile::wheels;
  for (const CaseValue* one : simulation.tables(list)) {
    const TableOf table(*one, simulation.path_of(list), wheel_keys());
    const WheelContactInput wheel = read_wheel(table, wheelsets);
    const std::size_t index = 2 * static_cast<std::size_t>(wheel.wheelset) + (wheel.side == Side::left ? 0 : 1);
    if (given[index])
      table.fail(fmt::format("the {} wheel of wheelset {} is given twice", wheel.side == Side::left ? "left" : "right",
                             wheel.wheelset + 1));
    given[index] = true;
    std::optional<double>& other = wheels[index ^ 1].pitch;
    if (wheel.pitch && other && *other != *wheel.pitch)
      table.refuse(&WheelContactInput::pitch,
                   fmt::format("wheelset {} has two different pitch angles at the start", wheel.wheelset + 1),
                   "both wheels turn with the axle");
    const std::optional<double> pitch = wheel.pitch ? wheel.pitch : other;
    wheels[index] = wheel;
    wheels[index].pitch = other = pitch;
  }
  return wheels;
}

void read_check_rails(const SimulationTable& simulation, SimulationFile& out) {
  using C = CheckRailInput;
  const auto list = &SimulationFile::check_rails;
  for (const CaseValue* one : simulation.tables(list)) {
    const TableOf table(*one, simulation.path_of(list), check_rail_keys());
    const C rail = table.read();
    table.go_with(&C::flare, &C::flare_length);
    table.go_with(&C::flare_length, &C::flare);
    if (!(rail.to > rail.from)) table.refuse(&C::to, "a check rail ends before it begins");
    if (2.0 * rail.flare_length > rail.to - rail.from)
      table.refuse(&C::flare_length, "the flares at both ends are longer than the check rail");
    constexpr double kMostPush = 5e-3;
    const double back = 0.5 * out.contact.wheelset.flange_back_distance;
    if (rail.face_y > back + kMostPush)
      table.refuse(
          &C::face_y,
          fmt::format("the check rail lies {:.4g} mm within the flange of a wheelset in the middle of the track",
                      1e3 * (rail.face_y - back)),
          "the backs of the flanges are wheelset.flange_back_distance_mm apart");
    if (rail.face_y - (rail.flare_length > 0.0 ? rail.flare : 0.0) > back)
      table.refuse(&C::face_y, "the check rail begins within the flange of a wheelset in the middle of the track",
                   "give it flares, flare_m and flare_mm");
    out.check_rails.push_back(rail);
  }
}

}  // namespace treadmark::io
