// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/simulations/change_value.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"
#include "treadmark/model/contact/theories.hpp"

namespace treadmark::io {

namespace {

/// A key of case files, or the beginning of keys (ending with '_' or '.'), that a simulation gives itself.
struct Refusal {
  std::string_view key, reason, advice;
};

constexpr std::string_view kFound = "a simulation finds it";
constexpr Refusal kRefusals[] = {
    {"cases", "a simulation is one case in time", "use [study] for several of them"},
    {"patch", "a simulation is about wheels on rails", ""},
    {"roller", "vehicles run on a track", ""},
    {"case.side", "a simulation has both sides", "say it in [[simulation.wheels]]"},
    {"case.history", kFound, ""},
    {"case.sequence", "a simulation is one case in time", ""},
    {"case.steps", "a simulation finds its steps", "limit them with simulation.max_step_elements"},
    {"case.time_step_s", "a simulation finds its steps", "limit them with simulation.max_step_us"},
    {"wheelset.vertical_force_N", kFound, "it follows from the masses of the vehicle"},
    {"wheelset.longitudinal_force_N", kFound, ""},
    {"wheelset.s_mm", kFound, ""},
    {"wheelset.y_mm", kFound, ""},
    {"wheelset.z_mm", kFound, ""},
    {"wheelset.roll_", kFound, ""},
    {"wheelset.yaw_", kFound, ""},
    {"wheelset.pitch_", kFound, "the pitch at the start is pitch_deg in [[simulation.wheels]]"},
    {"wheelset.velocity_", kFound, "give simulation.speed_m_s"},
    {"wheelset.rolling", kFound, ""},
    {"wheelset.vy_m_s", kFound, ""},
    {"wheelset.vz_m_s", kFound, ""},
    {"wheelset.vroll_rad_s", kFound, ""},
    {"wheelset.vyaw_rad_s", kFound, ""},
    {"wheelset.vpitch_rad_s", kFound, ""},
    {"wheelset.deviation_", "wheelsets of a simulation are rigid", ""},
    {"track.irregularity_", kFound, ""},
    {"track.springs", "the track of a simulation is a file", "name it in simulation.track"},
    {"track.curvature_per_m", "a simulation runs on straight track", ""},
};

void refuse(std::string_view path, const SourcePosition& where) {
  for (const Refusal& one : kRefusals) {
    const bool beginning = one.key.ends_with('_');
    const bool within =
        path.starts_with(one.key) && (beginning || path.size() == one.key.size() || path[one.key.size()] == '.');
    if (within)
      throw Error(ErrorKind::configuration, fmt::format("{} has no place in a simulation file: {}", path, one.reason),
                  where, std::string(one.advice));
  }
}

void refuse_keys(const CaseTable& table, const std::string& prefix) {
  for (const CaseEntry& entry : table) {
    const std::string path = prefix.empty() ? entry.key : prefix + '.' + entry.key;
    refuse(path, entry.key_where);
    if (entry.value.is_table()) refuse_keys(entry.value.table(), path);
  }
}

/// Where a key is given: by an override, in the file, or not at all.
std::optional<SourcePosition> given_at(const ContactPart& part, std::string_view path) {
  for (const std::string& one : part.overrides)
    if (const CaseOverride change = parse_override(one); change.path == path) return change.value.where;
  const CaseEntry* entry = find_entry(part.tables, path);
  if (entry == nullptr) return std::nullopt;
  return entry->value.where;
}

/// The tables as a complete case: with what the simulation knows, and a load for the checks.
CaseTable completed(const ContactPart& part, const SimulationFile& out) {
  constexpr double kAnyLoad = 1.0;
  CaseTable tables = part.tables;
  const CaseEntry* wheelset = find_entry(tables, "wheelset");
  if (wheelset != nullptr && !wheelset->value.is_table()) return tables;  // the reader of cases tells what is wrong
  const SourcePosition top{part.name.string(), 1, 1};
  const auto put = [&](const std::string& path, double value) { change_value(tables, path, {path, {top, value}, {}}); };
  const double radius = out.vehicle.wheelsets.front().nominal_radius;
  put("wheelset.vertical_force_N", kAnyLoad);
  put("wheelset.velocity_m_s", out.settings.speed);
  put("wheelset.vpitch_rad_s", -out.settings.speed / radius);
  if (!given_at(part, "wheelset.nominal_radius_mm")) put("wheelset.nominal_radius_mm", radius * 1e3);
  return tables;
}

WheelRailCase contact_of(const CaseTable& tables, const ContactPart& part, std::vector<std::string>* notes) {
  CaseFile file = case_file_of(tables, part.name, part.overrides);
  if (notes != nullptr) *notes = std::move(file.notes);
  return std::get<WheelRailCase>(std::move(file.cases.at(0).content));
}

void check_radius(const ContactPart& part, const SimulationFile& out) {
  const auto where = given_at(part, "wheelset.nominal_radius_mm");
  if (!where) return;
  constexpr double kSame = 1e-12;
  for (const WheelsetSpec& wheelset : out.vehicle.wheelsets)
    if (std::abs(wheelset.nominal_radius - out.contact.wheelset.nominal_radius) > kSame)
      throw Error(
          ErrorKind::configuration,
          fmt::format("wheelset.nominal_radius_mm = {:.10g} differs from {:.10g} mm of '{}' in the vehicle file",
                      out.contact.wheelset.nominal_radius * 1e3, wheelset.nominal_radius * 1e3, wheelset.body),
          *where, "leave it out, the vehicle file gives it");
}

void check_regime(const ContactPart& part, const SimulationFile& out) {
  const WheelRailCase& c = out.contact;
  const SourcePosition top{part.name.string(), 1, 1};
  if (c.regime != Regime::steady && c.regime != Regime::transient)
    throw Error(ErrorKind::configuration, "case.regime of a simulation must be \"steady\" or \"transient\"",
                given_at(part, "case.regime").value_or(top), "wheels of a simulation roll");
}

/// Shapes that may be out of round or damaged all around, so that none can be told from them that is not.
bool is_measured_wheel(const SurfaceSource& wheel) {
  const auto* file = std::get_if<GeometryFile>(&wheel.geometry);
  if (file == nullptr) return std::holds_alternative<SolidsInput>(wheel.geometry);
  return can_hold(file->file, kSlicesFile | kTriangleFile | kOffsetFile);
}

}  // namespace

void read_contact(const ContactPart& part, SimulationFile& out) {
  refuse_keys(part.tables, "");
  for (const std::string& one : part.overrides) {
    const CaseOverride change = parse_override(one);
    refuse(change.path, change.value.where);
  }
  out.contact = contact_of(completed(part, out), part, &out.notes);
  // One creepage for a patch is not enough at flanges. Whoever asks for the reference program's ways gets its plane.
  const bool reference_ways =
      out.contact.conventions == Conventions::contact || out.contact.discretisation.conventions == Conventions::contact;
  if (!given_at(part, "contact.reference_surface") && !reference_ways &&
      takes_slip_of_elements(out.contact.tangential_model))
    out.contact.reference_surface = ReferenceSurface::plane_surface_slip;
  out.contact.vertical_force = 0.0;
  check_radius(part, out);
  check_regime(part, out);
}

namespace {

/// Representations that overrides ask for hold for all rails.
bool is_of_all_rails(const std::string& change) {
  return change.starts_with("rail.backend") || change.starts_with("rail.resolution_mm");
}

/// A table of [simulation] with the keys of a body of a case file, read in its place.
WheelRailCase read_in_place(const ContactPart& part, const SimulationTable& simulation, std::string_view key,
                            const std::string& body, const SimulationFile& out) {
  const CaseValue& value = simulation.need(key);
  CaseTable tables = completed(part, out);
  std::erase_if(tables, [&](const CaseEntry& entry) { return entry.key == body; });
  tables.push_back({body, value.where, {value.where, *simulation.table(key)}});
  ContactPart other{{}, {}, part.name};
  for (const std::string& one : part.overrides)
    if (!one.starts_with(body + '.') || is_of_all_rails(one)) other.overrides.push_back(one);
  return contact_of(tables, other, nullptr);
}

void refuse_defects(const SurfaceSource& source, const SimulationTable& simulation, std::string_view key,
                    std::string_view what, std::string_view advice) {
  if (source.defects.empty() && source.offsets.file.empty()) return;
  throw Error(ErrorKind::configuration,
              fmt::format("{} is the shape of {}, it has no defects", simulation.path_of(key), what),
              simulation.need(key).where, std::string(advice));
}

}  // namespace

void read_other_wheel(const ContactPart& part, const SimulationTable& simulation, SimulationFile& out) {
  const std::string_view key = simulation.key(&SimulationFile::other_wheel);
  if (simulation.table(key) != nullptr) {
    out.other_wheel = read_in_place(part, simulation, key, "wheel", out).wheel;
    refuse_defects(*out.other_wheel, simulation, key, "round wheels", "give them in [wheel]");
    return;
  }
  const auto round =
      std::find_if(out.wheels.begin(), out.wheels.end(), [](const WheelContactInput& w) { return !w.defects; });
  if (round == out.wheels.end() || !is_measured_wheel(out.contact.wheel)) return;
  simulation.fail(
      fmt::format("[wheel] is measured all around, but the {} wheel of wheelset {} is round: its shape is missing",
                  round->side == Side::left ? "left" : "right", round->wheelset + 1),
      "give [simulation.other_wheel], for example shape.standard = \"S1002\"");
}

ContactPart with_rail(ContactPart part, const SimulationTable& simulation) {
  using F = SimulationFile;
  const auto given_table = [&](auto rail) { return simulation.table(simulation.key(rail)) != nullptr; };
  const bool left = given_table(&F::left_rail), right = given_table(&F::right_rail);
  const auto common = ranges::find(part.tables, "rail", &CaseEntry::key);
  const auto change = ranges::find_if(
      part.overrides, [](const std::string& one) { return one.starts_with("rail.") && !is_of_all_rails(one); });
  const bool given = common != part.tables.end(), changed = change != part.overrides.end();
  if (left && right) {
    const CaseValue& own = simulation.need(&F::right_rail);
    if (given || changed)
      throw Error(ErrorKind::configuration, "[rail] is the rail of no wheel: both sides have rails of their own",
                  given ? common->key_where : parse_override(*change).value.where,
                  "leave out [rail], simulation.left_rail or simulation.right_rail");
    part.tables.push_back({"rail", own.where, {own.where, own.table()}});
  } else if ((left || right) && !given && !changed) {
    throw Error(ErrorKind::configuration, fmt::format("the {} rail has no shape", left ? "right" : "left"),
                simulation.need(left ? &F::left_rail : &F::right_rail).where,
                fmt::format("give [rail] or [simulation.{}_rail]", left ? "right" : "left"));
  }
  return part;
}

void read_rails(const ContactPart& part, const SimulationTable& simulation, SimulationFile& out) {
  using F = SimulationFile;
  for (auto member : {&F::left_rail, &F::right_rail, &F::table_rail}) {
    const std::string_view key = simulation.key(member);
    if (simulation.table(key) == nullptr) continue;
    std::optional<SurfaceSource>& rail = out.*member;
    rail = read_in_place(part, simulation, key, "rail", out).rail;
    if (rail->where.file.empty()) rail->where = simulation.need(key).where;  // of parts
  }
  if (out.table_rail)
    refuse_defects(*out.table_rail, simulation, simulation.key(&F::table_rail), "rails for tables",
                   "give them to the rail itself");
  const Track& track = out.contact.track;
  if (!track.gauge_based && !(track.rail_y0 > 0.0))
    throw Error(ErrorKind::configuration,
                "track.rail_y_mm of a simulation must be positive: it is that of the right rail",
                given_at(part, "track.rail_y_mm").value_or(SourcePosition{part.name.string(), 1, 1}),
                "the left rail lies at its mirror image");
}

}  // namespace treadmark::io
