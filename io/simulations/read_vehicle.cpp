// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/simulations/read_vehicle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/simulations/change_value.hpp"
#include "treadmark/io/simulations/check_held.hpp"
#include "treadmark/io/simulations/table_of.hpp"
#include "treadmark/io/simulations/vehicle_keys.hpp"

namespace treadmark::io {

namespace {

/// Overrides of keys that are not in another table mean the one that gives the model its name.
void change_model(CaseTable& document, std::span<const CaseOverride> changes, const std::string& main_table,
                  const TableKeys& tables) {
  for (const CaseOverride& change : changes) {
    const std::string_view head = std::string_view(change.path).substr(0, change.path.find('.'));
    const bool in_other = head != main_table && ranges::find(tables, head, &KeyInfo::path) != tables.end();
    change_value(document, in_other ? change.path : main_table + '.' + change.path, change);
  }
}

/// The table that gives the model its name.
TableOf<ModelHead> main_table(const TableReader& document, const std::string& key, const KeyTable<ModelHead>& keys) {
  const CaseTable* table = document.table(key);
  if (table == nullptr)
    document.fail(fmt::format("[{0}] is missing, this is no {0} file", key), "see docs/simulation-files.md");
  return {*table, document.find(key)->where, key, keys};
}

template <class Model>
void scale_model(Model& model, const ModelHead& head) {
  for (BodySpec& body : model.bodies) scale(body_keys(), body, head);
  for (SpringSpec& spring : model.springs) {
    scale(spring_keys(), spring, head);
    if (!(head.damping > 0.0)) spring.damper_stiffness = {};
  }
}

/// The stiffness of steel stays: frequencies follow.
void scale_axles(VehicleModel& vehicle, const ModelHead& head) {
  for (WheelsetSpec& wheelset : vehicle.wheelsets) {
    if (!wheelset.axle) continue;
    scale(axle_keys(), *wheelset.axle, head);
    for (BendingMode& mode : wheelset.axle->bending) {
      mode.mass *= head.mass;
      mode.damping *= head.damping;
    }
    for (TorsionMode& mode : wheelset.axle->torsion) {
      mode.inertia *= head.mass;
      mode.damping *= head.damping;
    }
  }
}

/// Springs are scaled, not the rail, whose stiffness is known well.
void scale_track(FlexibleTrack& track, const ModelHead& head) {
  scale(beam_keys(), track.rail, head);
  if (track.sideways) scale(sideways_keys(), *track.sideways, head);
  for (RailSeat& seat : track.seats) {
    scale(seat_keys(), seat, head);
    scale(sideways_seat_keys(), seat, head);
  }
  if (track.lateral) scale(lateral_keys(), *track.lateral, head);
}

/// Tables and keys of the other kind of track say that the kind is not what was meant.
void refuse_other_kind(const TableReader& document, const TableOf<ModelHead>& table, bool flexible) {
  const auto refuse = [&](const TableReader& reader, std::string_view key) {
    if (reader.find(key) == nullptr) return;
    throw Error(
        ErrorKind::configuration,
        fmt::format("{} belongs to tracks whose kind is \"{}\"", reader.path_of(key), flexible ? "lumped" : "flexible"),
        reader.find(key)->where, "see docs/simulation-files.md");
  };
  if (flexible) {
    refuse(table, table.key(&ModelHead::rails));
    for (const char* key : {"bodies", "springs"}) refuse(document, key);
  } else {
    for (const char* key : {"rail", "seats", "varied", "joints", "lateral"}) refuse(document, key);
  }
}

std::vector<WheelsetSpec> read_wheelsets(const TableReader& document, const std::vector<BodySpec>& bodies) {
  std::vector<WheelsetSpec> wheelsets;
  const std::vector<FlexibleAxle> axles = read_axles(document);
  std::vector<std::string> axle_names;
  for (const FlexibleAxle& axle : axles) axle_names.push_back(axle.name);
  std::set<std::string> seen;
  for (const CaseValue* one : document.tables("wheelsets")) {
    const TableOf part(*one, "wheelsets", wheelset_keys());
    WheelsetSpec wheelset = part.read();
    const SourcePosition& where = part.need(&WheelsetSpec::body).where;
    check_name(part.path_of(&WheelsetSpec::body) + ": the body", wheelset.body, names_of(bodies), where);
    if (!seen.insert(wheelset.body).second)
      throw Error(ErrorKind::configuration, fmt::format("the body '{}' is a wheelset twice", wheelset.body), where);
    const auto body =
        std::find_if(bodies.begin(), bodies.end(), [&](const BodySpec& b) { return b.name == wheelset.body; });
    if (!body->free.at(static_cast<std::size_t>(Freedom::z)))
      throw Error(ErrorKind::configuration, fmt::format("the wheelset '{}' cannot move in z", wheelset.body), where,
                  "add \"z\" to what is free: the load of its wheels follows from its vertical motion");
    if (const CaseValue* name = part.checked_if(part.key(&WheelsetSpec::axle))) {
      check_name(part.path_of(&WheelsetSpec::axle) + ": the axle", name->text(), axle_names, name->where);
      wheelset.axle = *ranges::find(axles, name->text(), &FlexibleAxle::name);
    }
    wheelsets.push_back(std::move(wheelset));
  }
  for (const FlexibleAxle& axle : axles)
    if (ranges::none_of(wheelsets, [&](const WheelsetSpec& w) { return w.axle && w.axle->name == axle.name; }))
      throw Error(ErrorKind::configuration, fmt::format("no wheelset has the axle '{}'", axle.name), axle.where,
                  "name it as axle of one of [[wheelsets]]");
  if (wheelsets.empty())
    document.fail("there are no [[wheelsets]]", "name the bodies that run on the rails, the leading one first");
  return wheelsets;
}

}  // namespace

void check_held(const VehicleModel& vehicle) {
  // Wheels on two rails hold x, y and pitch by creep forces, z and roll by normal ones.
  Foundation wheels{"the wheelsets", {}, {true, true, true, true, true, false}};
  for (const WheelsetSpec& wheelset : vehicle.wheelsets) wheels.bodies.push_back(wheelset.body);
  std::vector<SpringSpec> holding = vehicle.springs;
  holding.reserve(holding.size() + vehicle.frictions.size());
  for (const DryFrictionSpec& f : vehicle.frictions) {
    SpringSpec& sticking = holding.emplace_back(SpringSpec{f.name, f.body_a, f.body_b, f.position, {}, {}, {}, {}});
    for (std::size_t d = 0; d < kFreedoms; ++d)
      if (f.directions.at(d)) sticking.stiffness.at(d) = f.stiffness * (d < 3 ? 1.0 : f.arm * f.arm);
  }
  for (const AirSpringSpec& a : vehicle.air_springs) {
    SpringSpec& bearing = holding.emplace_back(SpringSpec{a.name, a.body_a, a.body_b, a.position, {}, {}, {}, {}});
    // of the order of what it has
    bearing.stiffness.at(static_cast<std::size_t>(Freedom::z)) = a.load * a.area / a.bellows;
  }
  check_held(vehicle.bodies, holding, wheels);
}

namespace {

void take_rails(const TableOf<ModelHead>& table, const std::vector<std::string>& rails, TrackModel& track) {
  const CaseValue& list = table.need(&ModelHead::rails);
  if (rails.size() != 2 || rails[0] == rails[1])
    throw Error(ErrorKind::configuration, "track.rails must name two bodies, the left and the right rail", list.where);
  for (std::size_t i = 0; i < 2; ++i)
    check_name("track.rails: the body", rails[i], names_of(track.bodies), list.list()[i].where);
  track.left_rail = rails[0];
  track.right_rail = rails[1];
}

std::vector<CaseOverride> parsed(std::span<const std::string> overrides) {
  std::vector<CaseOverride> changes;
  for (const std::string& one : overrides) changes.push_back(parse_override(one));
  return changes;
}

}  // namespace

VehicleModel parse_vehicle_text(std::string_view text, const std::string& name, std::span<const CaseOverride> changes) {
  CaseTable tables = parse_toml(text, name);
  change_model(tables, changes, "vehicle", vehicle_tables());
  const TableReader document(tables, {name, 1, 1}, "", vehicle_tables());
  const ModelHead head = main_table(document, "vehicle", vehicle_keys()).read();
  VehicleModel vehicle;
  vehicle.name = head.name;
  vehicle.bodies = read_bodies(document);
  vehicle.springs = read_springs(document, vehicle.bodies);
  vehicle.bump_stops = read_bump_stops(document, vehicle.bodies);
  vehicle.damper_curves = read_damper_curves(document, vehicle.bodies);
  vehicle.air_springs = read_air_springs(document, vehicle.bodies);
  vehicle.frictions = read_frictions(document, vehicle.bodies, vehicle.springs, vehicle.bump_stops);
  vehicle.wheelsets = read_wheelsets(document, vehicle.bodies);
  check_held(vehicle);
  scale_model(vehicle, head);
  scale_axles(vehicle, head);
  for (DamperCurveSpec& damper : vehicle.damper_curves) scale(damper_curve_keys(), damper, head);
  if (!(head.damping > 0.0)) vehicle.damper_curves.clear();
  return vehicle;
}

AnyTrack parse_any_track_text(std::string_view text, const std::string& name, std::span<const CaseOverride> changes) {
  CaseTable tables = parse_toml(text, name);
  change_model(tables, changes, "track", track_tables());
  const TableReader document(tables, {name, 1, 1}, "", track_tables());
  const TableOf<ModelHead> table = main_table(document, "track", track_keys());
  const ModelHead head = table.read();
  refuse_other_kind(document, table, head.flexible);
  if (head.flexible) {
    FlexibleTrack track = read_flexible_track(document);
    track.name = head.name;
    track.source = head.source;
    scale_track(track, head);
    return track;
  }
  TrackModel track;
  track.name = head.name;
  track.bodies = read_bodies(document);
  track.springs = read_springs(document, track.bodies);
  take_rails(table, head.rails, track);
  check_held(track.bodies, track.springs, {"the ground", {kGround}, {}});
  scale_model(track, head);
  return track;
}

TrackModel parse_track_text(std::string_view text, const std::string& name, std::span<const CaseOverride> changes) {
  AnyTrack track = parse_any_track_text(text, name, changes);
  if (TrackModel* const lumped = std::get_if<TrackModel>(&track)) return std::move(*lumped);
  throw Error(ErrorKind::configuration, "a lumped track is needed, this is a flexible one", {name, 1, 1},
              "'treadmark track FILE --fit 3 -o FOLDER' makes a lumped one of it");
}

VehicleModel read_vehicle_file(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_vehicle_text(read_text(file), file.string(), parsed(overrides));
}

TrackModel read_track_file(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_track_text(read_text(file), file.string(), parsed(overrides));
}

AnyTrack read_any_track_file(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_any_track_text(read_text(file), file.string(), parsed(overrides));
}

}  // namespace treadmark::io
