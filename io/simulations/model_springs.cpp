// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/io/simulations/table_of.hpp"
#include "treadmark/io/simulations/vehicle_keys.hpp"

namespace treadmark::io {

namespace {

Places read_place(const TableOf<Places>& table, const std::vector<std::string>& known) {
  const CaseValue& between = table.need(&Places::between);
  table.need(&Places::points);
  Places place = table.read();
  const std::vector<std::string>& names = place.between;
  const std::string path = table.path_of(&Places::between);
  if (names.size() != 2) table.refuse(&Places::between, fmt::format("{} has {} names, it needs 2", path, names.size()));
  for (std::size_t i = 0; i < 2; ++i)
    check_name(fmt::format("{}: the body", path), names[i], known, between.list()[i].where);
  if (names[0] == names[1]) table.refuse(&Places::between, fmt::format("{} connects '{}' with itself", path, names[0]));
  return place;
}

std::vector<Places> read_places(const TableOf<Places>& part, const std::vector<BodySpec>& bodies) {
  std::vector<std::string> known = names_of(bodies);
  known.emplace_back(kGround);
  part.exclude(&Places::between, &Places::several);
  part.exclude(&Places::points, &Places::several);
  if (part.find(&Places::several) == nullptr) return {read_place(part, known)};
  std::vector<Places> all;
  const std::string path = part.path_of(&Places::several);
  for (const CaseValue* one : part.tables(&Places::several))
    all.push_back(read_place(TableOf(*one, path, place_keys()), known));
  if (all.empty()) part.refuse(&Places::several, fmt::format("{} is empty", path));
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
      part.body_a = place.between[0];
      part.body_b = place.between[1];
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

void check_spring(const TableOf<SpringSpec>& part, const SpringSpec& spring) {
  const auto none = [](const SixValues& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; });
  };
  if (none(spring.stiffness) && none(spring.damping))
    part.fail(fmt::format("{} has neither stiffness nor damping", part.path()),
              "give stiffness_N_per_m, damping_N_s_per_m ...");
  for (std::size_t i = 0; i < spring.damping.size(); ++i)
    if (spring.damper_stiffness.at(i) > 0.0 && spring.damping.at(i) == 0.0)
      part.refuse([first = i / 3 * 3](const SpringSpec& s) -> const double& { return s.damper_stiffness.at(first); },
                  fmt::format("{}: a spring in series with the damper in {} needs that damper", part.path(),
                              freedom_word(static_cast<int>(i))));
}

void check_characteristic(const TableOf<BumpStopSpec>& part, const BumpStopSpec& stop) {
  using B = BumpStopSpec;
  const auto fail = [&](std::vector<double> B::*list, const std::string& what) {
    part.refuse(list, fmt::format("{} {}", part.path_of(list), what));
  };
  const auto &d = stop.displacement, &f = stop.force;
  if (d.size() < 2) fail(&B::displacement, "needs at least 2 values");
  if (d.size() != f.size()) fail(&B::force, fmt::format("has {} values for {} displacements", f.size(), d.size()));
  if (std::adjacent_find(d.begin(), d.end(), std::greater_equal<>()) != d.end())
    fail(&B::displacement, "must increase");
  if (std::adjacent_find(f.begin(), f.end(), std::greater<>()) != f.end()) fail(&B::force, "must not decrease");
  if (f.front() != 0.0) fail(&B::force, "must start from 0");
}

/// What all parts that connect bodies begin with.
template <class Part>
Part named_part(const TableReader& table, const std::string& name, const KeyTable<Part>& keys) {
  Part part = TableOf(table, keys).read();
  part.name = name;
  part.where = table.where();
  return part;
}

TableReader part_table(const CaseValue& table, const std::string& list, const TableKeys& keys, std::string& name) {
  name = part_name(TableReader(table.table(), table.where, list, keys));
  return {table.table(), table.where, list + '.' + name, keys};
}

}  // namespace

std::vector<SpringSpec> read_springs(const TableReader& document, const std::vector<BodySpec>& bodies) {
  std::vector<SpringSpec> springs;
  std::string name;
  for (const CaseValue* one : document.tables("springs")) {
    const TableReader table = part_table(*one, "springs", spring_table_keys(), name);
    const SpringSpec spring = named_part(table, name, spring_keys());
    check_spring(TableOf(table, spring_keys()), spring);
    add_at(read_places(TableOf(table, spring_place_keys()), bodies), spring, springs);
  }
  check_names(springs, "springs");
  return springs;
}

std::vector<BumpStopSpec> read_bump_stops(const TableReader& document, const std::vector<BodySpec>& bodies) {
  std::vector<BumpStopSpec> stops;
  std::string name;
  for (const CaseValue* one : document.tables("bump_stops")) {
    const TableReader table = part_table(*one, "bump_stops", bump_stop_table_keys(), name);
    const BumpStopSpec stop = named_part(table, name, bump_stop_keys());
    check_characteristic(TableOf(table, bump_stop_keys()), stop);
    add_at(read_places(TableOf(table, bump_stop_place_keys()), bodies), stop, stops);
  }
  check_names(stops, "bump stops");
  return stops;
}

}  // namespace treadmark::io
