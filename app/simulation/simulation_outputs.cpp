// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/simulation/simulation_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "treadmark/app/assessment/assessment_outputs.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/io/histories/history_model.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/report/pictures/histories/history_svg.hpp"
#include "treadmark/report/pictures/pressure_svg.hpp"

namespace treadmark::app {

namespace {

bool is_of_a_wheel(const std::string& name) {
  if (name.starts_with("energy.")) return true;
  if (ranges::any_of(kPointKinds, [&](std::string_view kind) { return name.starts_with(std::string(kind) + '.'); }))
    return true;
  if (name.ends_with(".sumY_N")) return true;
  const auto dot = name.find('.');
  return dot == std::string::npos || (name.starts_with("ws") && (name.substr(0, dot).ends_with("_left") ||
                                                                 name.substr(0, dot).ends_with("_right")));
}

}  // namespace

io::SimulationResult wheel_columns(const io::SimulationResult& result) {
  io::SimulationResult part;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < result.columns.size(); ++i)
    if (result.chosen || is_of_a_wheel(result.columns[i].name)) {
      kept.push_back(i);
      part.columns.push_back(result.columns[i]);
    }
  part.values.reserve(result.rows() * kept.size());
  for (std::size_t row = 0; row < result.rows(); ++row)
    for (const std::size_t i : kept) part.values.push_back(result.values[row * result.columns.size() + i]);
  return part;
}

std::vector<pictures::PatchesPanel> patches_panels(const io::SimulationResult& result) {
  std::vector<pictures::PatchesPanel> panels;
  const io::CaseResult* round_wheel = nullptr;
  for (std::size_t i = 0; i < result.snapshot_scenes.size(); ++i) {
    const io::SnapshotScene& scene = result.snapshot_scenes[i];
    const io::CaseResult& snapshot = result.snapshots.cases[i];
    if (scene.nominal) round_wheel = &snapshot;
    if (!scene.drawn) continue;
    constexpr double kDegree = std::numbers::pi / 180.0;
    pictures::PatchesPanel panel{&snapshot, round_wheel, scene.depth_grid, scene.depth};
    panel.title = fmt::format("{:.1f}°, Q = {:.0f} kN", wrap_angle(snapshot.pitch) / kDegree + 0.0,
                              snapshot.force_tr.z() * 1e-3 + 0.0);
    double pmax = 0.0;
    for (const io::PatchResult& patch : snapshot.patches) pmax = std::max(pmax, patch.pmax);
    panel.remark = snapshot.patches.empty() ? "no contact" : fmt::format("at most {:.0f} MPa", pmax * 1e-6);
    panels.push_back(std::move(panel));
  }
  return panels;
}

void write_simulation_folder(const std::filesystem::path& folder, const io::SimulationResult& result) {
  io::write_history_csv(folder / "history.csv", wheel_columns(result));
  io::write_events_csv(folder / "events.csv", result);
  io::write_modes_csv(folder / "modes.csv", result);
  if (result.rows() > 1) {
    constexpr double kKilo = 1e-3, kMega = 1e-6;
    pictures::HistoryChart chart;
    chart.title = result.title;
    chart.x = {"t_s", "t [s]"};
    const auto has = [&](const char* name) {
      return ranges::find(result.columns, name, &io::HistoryColumn::name) != result.columns.end();
    };
    if (has("Q_N")) chart.y.push_back({"Q_N", "Q [kN]", kKilo, {result.values[io::column_index(result, "Q_N")]}});
    if (has("Ty_N")) chart.y.push_back({"Ty_N", "T_y [kN]", kKilo});
    if (has("pmax_Pa")) chart.y.push_back({"pmax_Pa", "p_max [MPa]", kMega});
    const pictures::HistoryRun run{&result, result.title};
    if (!chart.y.empty()) write_file(folder / "history.svg", pictures::history_svg(std::span(&run, 1), chart));
  }
  if (!result.snapshots.cases.empty()) write_file(folder / "pressure.svg", pictures::pressure_svg(result.snapshots));
  if (const std::vector<pictures::PatchesPanel> panels = patches_panels(result); !panels.empty()) {
    write_file(folder / "patches.svg", pictures::patches_svg(panels, result.title));
    write_file(folder / "patches.csv", pictures::patches_csv(panels));
  }
  io::write_simulation(folder / "simulation.h5", result);
}

std::string summary_text(const io::SimulationResult& result) {
  std::string text = fmt::format("{}: {}{}{}\n", result.title.empty() ? result.input_file : result.title, result.status,
                                 result.message.empty() ? "" : ", ", result.message);
  for (const io::NamedValue& v : result.summary) {
    double value = v.value;
    std::string unit = v.unit == "1" ? "" : v.unit;
    if (v.unit == "N") value *= 1e-3, unit = "kN";
    if (v.unit == "Pa") value *= 1e-6, unit = "MPa";
    text += fmt::format("  {:<26} {:>12.6g} {:<4} {}\n", v.name.substr(0, v.name.rfind('_' + v.unit)), value, unit,
                        v.description);
  }
  return text;
}

std::string times_text(const SimulationTimes& t) {
  const double geometry = t.contact.search_s + t.contact.distance_s;
  const double contact = geometry + t.contact.normal_s + t.contact.tangential_s;
  const double whole = t.shared ? contact : t.integration_s;
  const auto share = [&](double part) { return whole > 0.0 ? 100.0 * part / whole : 0.0; };
  std::string text = fmt::format(
      "time: {:.2f} s surfaces and contact tables, {:.2f} s equilibrium, {:.2f} s modes, {:.2f} s integration\n",
      t.build_s, t.equilibrium_s, t.modes_s, t.integration_s);
  if (contact > 0.0)
    text += fmt::format(
        "  of the {}: geometry {:.0f} % (search {:.0f} %, distance {:.0f} %), normal problem {:.0f} %, "
        "tangential problem "
        "{:.0f} %{}; {} contact solutions\n",
        t.shared ? fmt::format("contacts, {:.2f} s of all threads", contact) : "integration", share(geometry),
        share(t.contact.search_s), share(t.contact.distance_s), share(t.contact.normal_s),
        share(t.contact.tangential_s),
        t.shared ? "" : fmt::format(", other {:.0f} %", share(t.integration_s - contact)), t.contact.searches);
  return text;
}

std::string statics_text(const io::SimulationResult& result) {
  std::string text;
  for (const io::NamedValue& v : result.statics)
    text += fmt::format("{:<24} {:>14.6g}  {}\n", v.name, v.value, v.description);
  return text;
}

std::string modes_text(const io::SimulationResult& result) {
  std::string text = fmt::format("{:>12} {:>9}  {}\n", "f [Hz]", "damping", "kinetic energy");
  for (const io::ModeRow& mode : result.modes)
    text += fmt::format("{:>12.4f} {:>9.4f}  {}\n", mode.frequency_Hz, mode.damping_ratio, mode.shape);
  return text;
}

namespace {

using io::Json;

Json named(const std::vector<io::NamedValue>& values) {
  Json out = Json::object();
  for (const io::NamedValue& v : values) out[v.name] = v.value;
  return out;
}

}  // namespace

std::string to_json(const io::SimulationResult& r, const SimulationTimes& t, const AssessedRun* assessed) {
  Json out;
  out["treadmark"] = {{"version", r.version}, {"git", r.git}, {"threads", thread_count()}};
  out["input"] = {{"file", r.input_file}, {"sha256", r.input_sha256}, {"settings", r.settings}};
  for (const auto& [file, hash] : r.geometry_sha256) out["input"]["geometry"][file] = hash;
  for (const auto& [name, value] : r.inputs) out["input"]["values"][name] = value;
  out["title"] = r.title;
  out["status"] = r.status;
  out["message"] = r.message;
  out["static"] = named(r.statics);
  out["summary"] = named(r.summary);
  out["modes"] = io::json_of(r.modes, Digits::all);
  out["events"] = io::json_of(r.events, Digits::all);
  if (assessed) out["assessment"] = Json::parse(assessment_json(std::span(assessed, 1))).at("runs").at(0);
  out["rows"] = r.rows();
  out["timing"] = {{"build_s", t.build_s},
                   {"equilibrium_s", t.equilibrium_s},
                   {"modes_s", t.modes_s},
                   {"integration_s", t.integration_s},
                   {"search_s", t.contact.search_s},
                   {"distance_s", t.contact.distance_s},
                   {"normal_s", t.contact.normal_s},
                   {"tangential_s", t.contact.tangential_s},
                   {"contact_solutions", t.contact.searches}};
  return io::dumped(out, 2) + '\n';
}

}  // namespace treadmark::app
