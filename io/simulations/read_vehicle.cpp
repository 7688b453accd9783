// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/simulations/read_vehicle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/simulations/change_value.hpp"
#include "treadmark/io/simulations/check_held.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"

namespace treadmark::io {

namespace {

/// Overrides of keys that are not in another table mean the one that gives the model its name.
void change_model(CaseTable& document, std::span<const CaseOverride> changes, const std::string& main_table,
                  const TableKeys& tables) {
  for (const CaseOverride& change : changes) {
    const std::string_view head = std::string_view(change.path).substr(0, change.path.find('.'));
    const bool in_other = head != main_table && std::ranges::find(tables, head, &KeyInfo::path) != tables.end();
    change_value(document, in_other ? change.path : main_table + '.' + change.path, change);
  }
}

/// Reader of the table that gives the model its name.
TableReader main_table(const TableReader& document, const std::string& key, const std::vector<KeyInfo>& known) {
  const CaseTable* table = document.table(key);
  if (table == nullptr)
    document.fail(fmt::format("[{0}] is missing, this is no {0} file", key), "see docs/simulation-files.md");
  TableReader reader(*table, document.find(key)->where, key, known);
  reader.text_or("source", {});
  return reader;
}

void scale(SixValues& values, double factor) {
  for (double& value : values) value *= factor;
}

template <class Model>
void scale_model(Model& model, const TableReader& table) {
  const double mass = table.number_or("scale_mass", 1.0), stiffness = table.number_or("scale_stiffness", 1.0),
               damping = table.number_or("scale_damping", 1.0);
  for (BodySpec& body : model.bodies) {
    body.mass *= mass;
    body.inertia *= mass;
  }
  for (SpringSpec& spring : model.springs) {
    scale(spring.stiffness, stiffness);
    scale(spring.damping, damping);
    scale(spring.damper_stiffness, damping > 0.0 ? stiffness : 0.0);
  }
}

/// The stiffness of steel stays: frequencies follow.
void scale_axles(VehicleModel& vehicle, const TableReader& table) {
  const double mass = table.number_or("scale_mass", 1.0), damping = table.number_or("scale_damping", 1.0);
  for (WheelsetSpec& wheelset : vehicle.wheelsets) {
    if (!wheelset.axle) continue;
    wheelset.axle->wheel_polar_inertia *= mass;
    for (BendingMode& mode : wheelset.axle->bending) {
      mode.mass *= mass;
      mode.damping *= damping;
    }
    for (TorsionMode& mode : wheelset.axle->torsion) {
      mode.inertia *= mass;
      mode.damping *= damping;
    }
  }
}

/// Springs are scaled, not the rail, whose stiffness is known well.
void scale_track(FlexibleTrack& track, const TableReader& table) {
  const double mass = table.number_or("scale_mass", 1.0), stiffness = table.number_or("scale_stiffness", 1.0),
               damping = table.number_or("scale_damping", 1.0);
  track.rail.mass *= mass;
  track.rail.rotary_inertia *= mass;
  if (track.sideways) {
    track.sideways->rotary_inertia *= mass;
    track.sideways->polar_inertia *= mass;
  }
  for (RailSeat& seat : track.seats) {
    seat.sleeper_mass *= mass;
    for (double* spring : {&seat.pad_stiffness, &seat.bed_stiffness, &seat.lateral_pad_stiffness, &seat.roll_stiffness,
                           &seat.lateral_bed_stiffness})
      *spring *= stiffness;
    for (double* damper : {&seat.pad_damping, &seat.bed_damping, &seat.lateral_pad_damping, &seat.roll_damping,
                           &seat.lateral_bed_damping})
      *damper *= damping;
  }
  if (!track.lateral) return;
  track.lateral->pad_stiffness *= stiffness;
  track.lateral->bed_stiffness *= stiffness;
  track.lateral->pad_damping *= damping;
  track.lateral->bed_damping *= damping;
  track.lateral->rail_mass *= mass;
  track.lateral->sleeper_mass *= mass;
}

/// Tables and keys of the other kind of track say that the kind is not what was meant.
void refuse_other_kind(const TableReader& document, const TableReader& table, bool flexible) {
  const auto refuse = [&](const TableReader& reader, std::string_view key) {
    if (reader.find(key) == nullptr) return;
    throw Error(
        ErrorKind::configuration,
        fmt::format("{} belongs to tracks whose kind is \"{}\"", reader.path_of(key), flexible ? "lumped" : "flexible"),
        reader.find(key)->where, "see docs/simulation-files.md");
  };
  if (flexible) {
    refuse(table, "rails");
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
    const TableReader part(one->table(), one->where, "wheelsets", wheelset_keys());
    WheelsetSpec wheelset{part.text("body"), part.number("nominal_radius_mm")};
    const SourcePosition& where = part.need("body").where;
    check_name("wheelsets.body: the body", wheelset.body, names_of(bodies), where);
    if (!seen.insert(wheelset.body).second)
      throw Error(ErrorKind::configuration, fmt::format("the body '{}' is a wheelset twice", wheelset.body), where);
    const auto body =
        std::find_if(bodies.begin(), bodies.end(), [&](const BodySpec& b) { return b.name == wheelset.body; });
    if (!body->free.at(static_cast<std::size_t>(Freedom::z)))
      throw Error(ErrorKind::configuration, fmt::format("the wheelset '{}' cannot move in z", wheelset.body), where,
                  "add \"z\" to what is free: the load of its wheels follows from its vertical motion");
    if (const CaseValue* name = part.checked_if("axle")) {
      check_name("wheelsets.axle: the axle", name->text(), axle_names, name->where);
      wheelset.axle = *std::ranges::find(axles, name->text(), &FlexibleAxle::name);
    }
    wheelsets.push_back(std::move(wheelset));
  }
  for (const FlexibleAxle& axle : axles)
    if (std::ranges::none_of(wheelsets, [&](const WheelsetSpec& w) { return w.axle && w.axle->name == axle.name; }))
      throw Error(ErrorKind::configuration, fmt::format("no wheelset has the axle '{}'", axle.name), axle.where,
                  "name it as axle of one of [[wheelsets]]");
  if (wheelsets.empty())
    document.fail("there are no [[wheelsets]]", "name the bodies that run on the rails, the leading one first");
  return wheelsets;
}

void check_vehicle(const VehicleModel& vehicle) {
  // Wheels on two rails hold x, y and pitch by creep forces, z and roll by normal ones.
  Foundation wheels{"the wheelsets", {}, {true, true, true, true, true, false}};
  for (const WheelsetSpec& wheelset : vehicle.wheelsets) wheels.bodies.push_back(wheelset.body);
  check_held(vehicle.bodies, vehicle.springs, wheels);
}

void read_rails(const TableReader& table, TrackModel& track) {
  const CaseValue& list = table.need("rails", "the bodies that are the left and the right rail");
  const std::vector<std::string> rails = table.words("rails");
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
  const TableReader table = main_table(document, "vehicle", vehicle_keys());
  VehicleModel vehicle;
  vehicle.name = table.text("name");
  vehicle.bodies = read_bodies(document);
  vehicle.springs = read_springs(document, vehicle.bodies);
  vehicle.bump_stops = read_bump_stops(document, vehicle.bodies);
  vehicle.wheelsets = read_wheelsets(document, vehicle.bodies);
  check_vehicle(vehicle);
  scale_model(vehicle, table);
  scale_axles(vehicle, table);
  return vehicle;
}

AnyTrack parse_any_track_text(std::string_view text, const std::string& name, std::span<const CaseOverride> changes) {
  CaseTable tables = parse_toml(text, name);
  change_model(tables, changes, "track", track_tables());
  const TableReader document(tables, {name, 1, 1}, "", track_tables());
  const TableReader table = main_table(document, "track", track_keys());
  const bool flexible = table.text_or("kind", "lumped") == "flexible";
  refuse_other_kind(document, table, flexible);
  if (flexible) {
    FlexibleTrack track = read_flexible_track(document);
    track.name = table.text("name");
    track.source = table.text_or("source", {});
    scale_track(track, table);
    return track;
  }
  TrackModel track;
  track.name = table.text("name");
  track.bodies = read_bodies(document);
  track.springs = read_springs(document, track.bodies);
  read_rails(table, track);
  check_held(track.bodies, track.springs, {"the ground", {kGround}, {}});
  scale_model(track, table);
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
