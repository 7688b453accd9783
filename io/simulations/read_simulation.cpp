// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/simulations/read_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "treadmark/core/missing_file.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/simulations/change_value.hpp"
#include "treadmark/io/simulations/line_keys.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"

namespace treadmark::io {

namespace {

/// Overrides by what they change.
struct Overrides {
  std::vector<CaseOverride> simulation, vehicle, track;
  std::vector<std::string> contact;
};

bool cut(std::string& path, std::string_view prefix) {
  if (!path.starts_with(prefix)) return false;
  path.erase(0, prefix.size());
  return true;
}

Overrides sorted(std::span<const std::string> assignments) {
  Overrides result;
  for (const std::string& one : assignments) {
    CaseOverride change = parse_override(one);
    if (cut(change.path, "vehicle."))
      result.vehicle.push_back(std::move(change));
    else if (cut(change.path, "track_model."))
      result.track.push_back(std::move(change));
    else if (change.path == "title" || change.path.starts_with("simulation.") || change.path.starts_with("layout.") ||
             change.path.starts_with("irregularities.") || change.path.starts_with("assessment."))
      result.simulation.push_back(std::move(change));
    else
      result.contact.push_back(one);
  }
  return result;
}

void change_simulation(CaseTable& document, const std::vector<CaseOverride>& changes) {
  const CaseTable none;
  const SimulationTable settings(none, {}, {}, simulation_keys());
  const std::string_view distance = settings.key(setting(&SimulationSettings::distance)),
                         duration = settings.key(setting(&SimulationSettings::duration));
  for (const CaseOverride& change : changes) {
    change_value(document, change.path, change);
    // Distance and duration exclude each other: the one that is set last counts.
    std::string key = change.path;
    if (!cut(key, "simulation.") || (key != distance && key != duration)) continue;
    for (CaseEntry& entry : document)
      if (auto* table = std::get_if<CaseTable>(&entry.value.data); table != nullptr && entry.key == "simulation")
        std::erase_if(*table,
                      [&](const CaseEntry& e) { return e.key != key && (e.key == distance || e.key == duration); });
  }
}

void read_models(const SimulationTable& simulation, const std::filesystem::path& folder, const Overrides& overrides,
                 SimulationFile& out) {
  const FileText vehicle = named_text(simulation, simulation.key(&SimulationFile::vehicle_file), folder);
  out.vehicle = parse_vehicle_text(vehicle.text, vehicle.file.path.string(), overrides.vehicle);
  out.vehicle_file = vehicle.file;
  const std::string_view key = simulation.key(&SimulationFile::track_file);
  if (simulation.find(key) == nullptr) {
    if (overrides.track.empty()) return;
    throw Error(ErrorKind::configuration, "there is no track to change, simulation.track is not given",
                overrides.track.front().value.where, "without it the track is rigid");
  }
  const FileText track = named_text(simulation, key, folder);
  AnyTrack any = parse_any_track_text(track.text, track.file.path.string(), overrides.track);
  if (TrackModel* const lumped = std::get_if<TrackModel>(&any))
    out.track = std::move(*lumped);
  else
    out.flexible_track = std::move(std::get<FlexibleTrack>(any));
  out.track_file = track.file;
}

void require_rails_to_share(const SimulationTable& simulation, const SimulationFile& file) {
  if (!file.settings.shared_rails || file.flexible_track) return;
  simulation.refuse(setting(&SimulationSettings::shared_rails),
                    file.track ? "simulation.shared_rails = true, but the track is lumped: each wheelset has its own"
                               : "simulation.shared_rails = true, but there is no flexible track",
                    "give a track whose kind is \"flexible\" (docs/track.md)");
}

/// With steps of more than an element the elements at the leading edge stick or slip at random.
void choose_steps(const SimulationTable& simulation, SimulationFile& out) {
  if (out.contact.regime == Regime::transient &&
      simulation.find(setting(&SimulationSettings::max_step_elements)) == nullptr)
    out.settings.max_step_elements = 1.0;
}

/// Histories of transient rolling reach two elements back.
void check_steps(const SimulationTable& simulation, const SimulationFile& out) {
  const SimulationSettings& s = out.settings;
  using S = SimulationSettings;
  const auto place = [&](auto S::*member) {
    const CaseValue* value = simulation.find(setting(member));
    return value != nullptr ? value->where : simulation.where();
  };
  constexpr double kMostElements = 2.0;
  if (out.contact.regime == Regime::transient && s.max_step_elements > kMostElements)
    throw Error(
        ErrorKind::configuration,
        fmt::format("simulation.max_step_elements = {:.6g}: steps of transient rolling must not exceed dt = 2 dx / V",
                    s.max_step_elements),
        place(&S::max_step_elements), "give at most 2, or case.regime = \"steady\"");
  const double longest = s.longest_step(out.contact.discretisation.dx);
  if (s.min_step > longest)
    throw Error(ErrorKind::configuration,
                fmt::format("simulation.min_step_us = {:.6g} exceeds the longest step of {:.6g} us", s.min_step * 1e6,
                            longest * 1e6),
                place(&S::min_step), "the longest step follows from max_step_us and max_step_elements * dx / V");

  // Each line holds some hundred numbers in memory, and a step takes a millisecond at least.
  constexpr double kMostSteps = 1e9, kMostLines = 1e7;
  const auto extent = simulation.find(setting(&S::duration)) ? &S::duration : &S::distance;
  const double steps = s.duration / longest, lines = s.output_every > 0.0 ? s.distance / s.output_every : steps;
  if (steps > kMostSteps)
    throw Error(ErrorKind::configuration,
                fmt::format("the simulation takes at least {:.3g} steps, more than {:g}", steps, kMostSteps),
                place(extent),
                "shorten it, or allow longer steps (max_step_us, max_step_elements, discretisation.dx_mm)");
  if (std::min(lines, steps) > kMostLines)
    throw Error(
        ErrorKind::configuration,
        fmt::format("the history has at least {:.3g} lines, more than {:g}", std::min(lines, steps), kMostLines),
        place(extent), "shorten it, or write fewer lines (simulation.output_every_mm)");
}

/// Tables beside [simulation] that are none of a case file.
constexpr std::string_view kLineTables[] = {"layout", "irregularities", "assessment"};

/// Reader of one of them, if it is there.
template <class Root>
std::optional<TableOf<Root>> line_table(const CaseTable& document, std::string_view key, const KeyTable<Root>& keys) {
  const auto entry =
      std::find_if(document.begin(), document.end(), [&](const CaseEntry& one) { return one.key == key; });
  if (entry == document.end()) return std::nullopt;
  if (!entry->value.is_table())
    throw Error(ErrorKind::configuration, fmt::format("{} must be a table, found {}", key, entry->value.kind()),
                entry->value.where);
  return TableOf(entry->value, std::string(key), keys);
}

}  // namespace

FileText named_text(const TableReader& simulation, std::string_view key, const std::filesystem::path& folder) {
  std::string name = simulation.text(key);
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path path = (folder / name).lexically_normal();
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    throw MissingFile(
        ErrorKind::configuration, fmt::format("{}: there is no file {}", simulation.path_of(key), path.string()),
        simulation.need(key).where, advice_on_missing(path, "names count from the folder of the simulation file"));
  FileText result{{path, {}}, read_text(path)};
  result.file.sha256 = sha256_hex(result.text);
  return result;
}

SimulationFile simulation_of(CaseTable document, const std::filesystem::path& name,
                             std::span<const std::string> overrides) {
  const Overrides changes = sorted(overrides);
  change_simulation(document, changes.simulation);
  SimulationFile result;
  result.path = name;
  result.title = name.stem().string();
  const CaseEntry* simulation_table = nullptr;
  ContactPart contact{{}, changes.contact, name};
  for (const CaseEntry& entry : document) {
    if (entry.key == "simulation")
      simulation_table = &entry;
    else if (std::find(std::begin(kLineTables), std::end(kLineTables), entry.key) == std::end(kLineTables))
      contact.tables.push_back(entry);
    if (entry.key == "title" && std::holds_alternative<std::string>(entry.value.data))
      result.title = entry.value.text();
  }
  const SourcePosition top{name.string(), 1, 1};
  if (simulation_table == nullptr || !simulation_table->value.is_table())
    throw Error(ErrorKind::configuration, "[simulation] is missing, this is no simulation file",
                simulation_table == nullptr ? top : simulation_table->value.where, "see docs/simulation-files.md");

  const SimulationTable simulation(simulation_table->value, "simulation", simulation_keys());
  read_settings(simulation, result);
  result.fields = read_fields(simulation);
  read_models(simulation, name.parent_path(), changes, result);
  read_train(simulation, name.parent_path(), result);
  require_rails_to_share(simulation, result);
  result.wheels = read_wheels(simulation, result);
  read_history(simulation, result);
  result.torques = read_torques(simulation, result.vehicle);
  read_motions(simulation, result);
  read_twist(simulation, result);
  contact = with_rail(std::move(contact), simulation);
  read_contact(contact, result);
  // The patches of a wheel lie on one raster while it rolls.
  result.contact.discretisation.choose_dx = result.contact.discretisation.choose_ds = false;
  if (const auto table = line_table(document, "layout", layout_keys())) read_layout(*table, result);
  read_free_run(simulation, result);
  check_speeds(simulation, result);
  if (const auto table = line_table(document, "irregularities", irregularity_keys()))
    read_irregularities(*table, name.parent_path(), result);
  if (const auto table = line_table(document, "assessment", assessment_keys()))
    read_assessment(*table, name.parent_path(), result);
  read_other_wheel(contact, simulation, result);
  read_rails(contact, simulation, result);
  read_check_rails(simulation, result);
  choose_steps(simulation, result);
  check_steps(simulation, result);
  return result;
}

SimulationFile parse_simulation_text(std::string_view text, const std::filesystem::path& name,
                                     std::span<const std::string> overrides) {
  SimulationFile result = simulation_of(parse_toml(text, name.string()), name, overrides);
  result.sha256 = sha256_hex(text);
  return result;
}

SimulationFile read_simulation_file(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_simulation_text(read_text(file), file, overrides);
}

}  // namespace treadmark::io
