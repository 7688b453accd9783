// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <set>
#include <span>

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

/// Two lists of points of a curve.
template <class Part>
void check_curve(const TableOf<Part>& part, const Part& spec, std::vector<double> Part::*at, std::string_view points) {
  const std::vector<double>&x = spec.*at, &f = spec.force;
  const auto fail = [&](std::vector<double> Part::*list, const std::string& what) {
    part.refuse(list, fmt::format("{} {}", part.path_of(list), what));
  };
  if (x.size() < 2) fail(at, "needs at least 2 values");
  if (x.size() != f.size()) fail(&Part::force, fmt::format("has {} values for {} {}", f.size(), x.size(), points));
  if (std::adjacent_find(x.begin(), x.end(), std::greater_equal<>()) != x.end()) fail(at, "must increase");
}

void check_stop(const TableOf<BumpStopSpec>& part, const BumpStopSpec& stop) {
  using B = BumpStopSpec;
  check_curve(part, stop, &B::displacement, "displacements");
  const auto &d = stop.displacement, &f = stop.force;
  if (stop.odd) {
    if (d.front() < 0.0)
      part.refuse(&B::displacement, fmt::format("{} begins below 0", part.path_of(&B::displacement)),
                  "odd = false for a force that differs by its sign");
    if (f.front() != 0.0) part.refuse(&B::force, fmt::format("{} must start from 0", part.path_of(&B::force)));
    return;
  }
  const auto rest = std::find(d.begin(), d.end(), 0.0);
  if (rest == d.end() || f[static_cast<std::size_t>(rest - d.begin())] != 0.0)
    part.refuse(&B::displacement,
                fmt::format("{} and {} must have force 0 at displacement 0", part.path_of(&B::displacement),
                            part.path_of(&B::force)),
                "springs bear the weights of a vehicle at rest");
}

void check_damper(const TableOf<DamperCurveSpec>& part, const DamperCurveSpec& damper) {
  using D = DamperCurveSpec;
  check_curve(part, damper, &D::velocity, "velocities");
  if (damper.velocity.front() != 0.0)
    part.refuse(&D::velocity, fmt::format("{} must start from 0", part.path_of(&D::velocity)));
  const auto& f = damper.force;
  if (f.front() != 0.0) part.refuse(&D::force, fmt::format("{} must start from 0", part.path_of(&D::force)));
  if (std::adjacent_find(f.begin(), f.end(), std::greater<>()) != f.end())
    part.refuse(&D::force, fmt::format("{} must not decrease", part.path_of(&D::force)));
  if (damper.series_stiffness > 0.0 && std::adjacent_find(f.begin(), f.end(), std::greater_equal<>()) != f.end())
    part.refuse(&D::force, fmt::format("{} must increase where there is a spring in series", part.path_of(&D::force)));
}

void check_friction(const TableOf<DryFrictionSpec>& part, const DryFrictionSpec& friction) {
  using F = DryFrictionSpec;
  const auto turns = std::count(friction.directions.begin() + 3, friction.directions.end(), true),
             ways = std::count(friction.directions.begin(), friction.directions.end(), true);
  const std::string path = part.path_of(&F::directions);
  if (ways < 1 || ways > 2 || (turns > 0 && ways > 1))
    part.refuse(&F::directions, fmt::format("{} are neither one or two of x, y, z nor one rotation", path));
  if (turns > 0) part.need(&F::arm);
  if (turns == 0 && part.find(&F::arm) != nullptr)
    part.refuse(&F::arm, fmt::format("{} belongs to rotations", part.path_of(&F::arm)));
  if (ways > 1 && friction.coefficient_back)
    part.refuse(&F::coefficient_back,
                fmt::format("{} belongs to friction in one direction", part.path_of(&F::coefficient_back)));
  part.go_with(&F::load_share, &F::load_of);
  if (!(friction.normal_force > 0.0) && part.find(&F::load_of) == nullptr)
    part.fail(fmt::format("{}: nothing presses it", part.path()), "give normal_force_N, or load_of");
}

/// The springs and stops that load_of names, one a place.
std::vector<std::string> loads_of(const TableOf<DryFrictionSpec>& part, std::size_t places,
                                  const std::vector<std::string>& known) {
  using F = DryFrictionSpec;
  std::vector<std::string> loads;
  for (const std::string& name : part.words(part.key(&F::load_of))) {
    const auto is_known = [&](const std::string& n) { return std::find(known.begin(), known.end(), n) != known.end(); };
    if (is_known(name)) loads.push_back(name);
    std::size_t number = 1;
    while (!is_known(name) && is_known(fmt::format("{}{}", name, number)))
      loads.push_back(fmt::format("{}{}", name, number++));
    if (!is_known(name) && number == 1)
      check_name(part.path_of(&F::load_of), name, known, part.need(&F::load_of).where);
  }
  if (loads.size() == 1) loads.resize(places, loads.front());
  if (loads.size() != places)
    part.refuse(&F::load_of,
                fmt::format("{} names {} loads for {} places", part.path_of(&F::load_of), loads.size(), places));
  return loads;
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

/// The keys of a part that connects bodies.
template <class Part>
struct PartKeys {
  std::string list, kind;  ///< name of the list of tables, and what its parts are in messages
  const TableKeys& all;
  const KeyTable<Places>& places;
  const KeyTable<Part>& own;
};

/// check: TableOf<Part>, Part& ->; completes and checks what the keys cannot say. each: TableOf<Part>, std::span<Part>
/// ->, of the parts at all places of a table.
template <class Part, class Check, class Each>
std::vector<Part> read_parts(const TableReader& document, const std::vector<BodySpec>& bodies,
                             const PartKeys<Part>& keys, Check check, Each each) {
  std::vector<Part> parts;
  std::string name;
  for (const CaseValue* one : document.tables(keys.list)) {
    const TableReader table = part_table(*one, keys.list, keys.all, name);
    Part part = named_part(table, name, keys.own);
    const TableOf own(table, keys.own);
    check(own, part);
    const std::size_t before = parts.size();
    add_at(read_places(TableOf(table, keys.places), bodies), part, parts);
    each(own, std::span(parts).subspan(before));
  }
  check_names(parts, keys.kind);
  return parts;
}

constexpr auto kNothingMore = [](const auto&, auto) {};

}  // namespace

std::vector<SpringSpec> read_springs(const TableReader& document, const std::vector<BodySpec>& bodies) {
  return read_parts<SpringSpec>(document, bodies,
                                {"springs", "springs", spring_table_keys(), spring_place_keys(), spring_keys()},
                                check_spring, kNothingMore);
}

std::vector<BumpStopSpec> read_bump_stops(const TableReader& document, const std::vector<BodySpec>& bodies) {
  return read_parts<BumpStopSpec>(
      document, bodies, {"bump_stops", "bump stops", bump_stop_table_keys(), bump_stop_place_keys(), bump_stop_keys()},
      check_stop, kNothingMore);
}

std::vector<DamperCurveSpec> read_damper_curves(const TableReader& document, const std::vector<BodySpec>& bodies) {
  return read_parts<DamperCurveSpec>(
      document, bodies,
      {"damper_curves", "dampers", damper_curve_table_keys(), damper_curve_place_keys(), damper_curve_keys()},
      check_damper, kNothingMore);
}

std::vector<AirSpringSpec> read_air_springs(const TableReader& document, const std::vector<BodySpec>& bodies) {
  using A = AirSpringSpec;
  return read_parts<A>(
      document, bodies,
      {"air_springs", "air springs", air_spring_table_keys(), air_spring_place_keys(), air_spring_keys()},
      [](const TableOf<A>& part, const A& air) {
        part.go_with(&A::orifice, &A::reservoir);
        part.go_with(&A::loss, &A::reservoir);
        if (!(air.reservoir > 0.0)) return;
        part.need(&A::orifice);
        part.need(&A::loss);
      },
      kNothingMore);
}

std::vector<DryFrictionSpec> read_frictions(const TableReader& document, const std::vector<BodySpec>& bodies,
                                            const std::vector<SpringSpec>& springs,
                                            const std::vector<BumpStopSpec>& stops) {
  using F = DryFrictionSpec;
  std::vector<std::string> known;
  known.reserve(springs.size() + stops.size());
  for (const SpringSpec& s : springs) known.push_back(s.name);
  for (const BumpStopSpec& s : stops) known.push_back(s.name);
  return read_parts<F>(
      document, bodies, {"frictions", "frictions", friction_table_keys(), friction_place_keys(), friction_keys()},
      [](const TableOf<F>& part, F& friction) {
        friction.directions = directions_of(part, part.key(&F::directions));
        check_friction(part, friction);
      },
      [&](const TableOf<F>& part, std::span<F> all) {
        if (part.find(&F::load_of) == nullptr) return;
        const std::vector<std::string> loads = loads_of(part, all.size(), known);
        for (std::size_t i = 0; i < all.size(); ++i) all[i].load_of = loads[i];
      });
}

}  // namespace treadmark::io
