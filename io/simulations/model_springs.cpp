// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"

namespace treadmark::io {

namespace {

/// Two bodies, and the points at which parts of one kind connect them.
struct Places {
  std::string body_a, body_b;
  std::vector<Vec3> points;
};

Places read_place(const TableReader& table, const std::vector<std::string>& known) {
  Places place;
  const CaseValue& between = table.need("between", "the two bodies that are connected");
  const std::vector<std::string> names = table.words("between");
  if (names.size() != 2)
    throw Error(ErrorKind::configuration,
                fmt::format("{} has {} names, it needs 2", table.path_of("between"), names.size()), between.where);
  for (std::size_t i = 0; i < 2; ++i)
    check_name(fmt::format("{}: the body", table.path_of("between")), names[i], known, between.list()[i].where);
  if (names[0] == names[1])
    throw Error(ErrorKind::configuration,
                fmt::format("{} connects '{}' with itself", table.path_of("between"), names[0]), between.where);
  place.body_a = names[0];
  place.body_b = names[1];
  table.need("at_m", "a list of points, one part at each of them");
  place.points = table.points("at_m");
  return place;
}

std::vector<Places> read_places(const TableReader& part, const std::vector<BodySpec>& bodies) {
  std::vector<std::string> known = names_of(bodies);
  known.emplace_back(kGround);
  part.exclude("between", "places");
  part.exclude("at_m", "places");
  if (part.find("places") == nullptr) return {read_place(part, known)};
  std::vector<Places> all;
  for (const CaseValue* one : part.tables("places"))
    all.push_back(read_place(TableReader(one->table(), one->where, part.path_of("places"), place_keys()), known));
  if (all.empty())
    throw Error(ErrorKind::configuration, fmt::format("{} is empty", part.path_of("places")),
                part.need("places").where);
  return all;
}

/// The part at every place, numbered when there are several.
template <class Part>
void add_at(const std::vector<Places>& places, Part part, std::vector<Part>& out) {
  std::size_t count = 0, number = 0;
  for (const Places& place : places) count += place.points.size();
  const std::string name = part.name;
  for (const Places& place : places)
    for (const Vec3& point : place.points) {
      if (count > 1) part.name = fmt::format("{}{}", name, ++number);
      part.body_a = place.body_a;
      part.body_b = place.body_b;
      part.position = point;
      out.push_back(part);
    }
}

template <class Part>
void check_names(const std::vector<Part>& parts, std::string_view kind) {
  constexpr std::size_t kMostParts = 2000;  // of 200 bodies
  if (parts.size() > kMostParts)
    throw Error(ErrorKind::configuration, fmt::format("{} {} are more than {}", parts.size(), kind, kMostParts),
                parts[kMostParts].where);
  std::set<std::string> seen;
  for (const Part& part : parts)
    if (!seen.insert(part.name).second)
      throw Error(ErrorKind::configuration, fmt::format("there are two {} named '{}'", kind, part.name), part.where);
}

SixValues six(const TableReader& part, std::string_view linear, std::string_view rotational) {
  const Vec3 along = part.triple(linear).value_or(Vec3::Zero());
  const Vec3 about = part.triple(rotational).value_or(Vec3::Zero());
  return {along[0], along[1], along[2], about[0], about[1], about[2]};
}

void check_spring(const TableReader& part, const SpringSpec& spring) {
  const auto none = [](const SixValues& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; });
  };
  if (none(spring.stiffness) && none(spring.damping))
    part.fail(fmt::format("{} has neither stiffness nor damping", part.path()),
              "give stiffness_N_per_m, damping_N_s_per_m ...");
  for (std::size_t i = 0; i < spring.damping.size(); ++i)
    if (spring.damper_stiffness.at(i) > 0.0 && spring.damping.at(i) == 0.0)
      throw Error(ErrorKind::configuration,
                  fmt::format("{}: a spring in series with the damper in {} needs that damper", part.path(),
                              freedom_word(static_cast<int>(i))),
                  part.need(i < 3 ? "damper_stiffness_N_per_m" : "rotational_damper_stiffness_N_m_per_rad").where);
}

void check_characteristic(const TableReader& part, const BumpStopSpec& stop) {
  const auto fail = [&](std::string_view key, const std::string& what) {
    throw Error(ErrorKind::configuration, fmt::format("{} {}", part.path_of(key), what), part.need(key).where);
  };
  const auto &d = stop.displacement, &f = stop.force;
  if (d.size() < 2) fail("displacement_mm", "needs at least 2 values");
  if (d.size() != f.size()) fail("force_N", fmt::format("has {} values for {} displacements", f.size(), d.size()));
  if (std::adjacent_find(d.begin(), d.end(), std::greater_equal<>()) != d.end())
    fail("displacement_mm", "must increase");
  if (std::adjacent_find(f.begin(), f.end(), std::greater<>()) != f.end()) fail("force_N", "must not decrease");
  if (f.front() != 0.0) fail("force_N", "must start from 0");
}

}  // namespace

std::vector<SpringSpec> read_springs(const TableReader& document, const std::vector<BodySpec>& bodies) {
  std::vector<SpringSpec> springs;
  for (const CaseValue* table : document.tables("springs")) {
    const std::string name = part_name(TableReader(table->table(), table->where, "springs", spring_keys()));
    const TableReader part(table->table(), table->where, "springs." + name, spring_keys());
    SpringSpec spring;
    spring.name = name;
    spring.where = part.where();
    spring.stiffness = six(part, "stiffness_N_per_m", "rotational_stiffness_N_m_per_rad");
    spring.damping = six(part, "damping_N_s_per_m", "rotational_damping_N_m_s_per_rad");
    spring.damper_stiffness = six(part, "damper_stiffness_N_per_m", "rotational_damper_stiffness_N_m_per_rad");
    check_spring(part, spring);
    add_at(read_places(part, bodies), spring, springs);
  }
  check_names(springs, "springs");
  return springs;
}

std::vector<BumpStopSpec> read_bump_stops(const TableReader& document, const std::vector<BodySpec>& bodies) {
  std::vector<BumpStopSpec> stops;
  for (const CaseValue* table : document.tables("bump_stops")) {
    const std::string name = part_name(TableReader(table->table(), table->where, "bump_stops", bump_stop_keys()));
    const TableReader part(table->table(), table->where, "bump_stops." + name, bump_stop_keys());
    BumpStopSpec stop;
    stop.name = name;
    stop.where = part.where();
    const std::string direction = part.text("direction");
    stop.direction = static_cast<Freedom>(direction.front() - 'x');
    part.need("displacement_mm");
    part.need("force_N");
    stop.displacement = part.numbers("displacement_mm");
    stop.force = part.numbers("force_N");
    check_characteristic(part, stop);
    add_at(read_places(part, bodies), stop, stops);
  }
  check_names(stops, "bump stops");
  return stops;
}

}  // namespace treadmark::io
