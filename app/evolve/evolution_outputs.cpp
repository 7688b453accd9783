// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include <fmt/format.h>

#include "treadmark/app/evolve/run_evolution.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/histories/evolution_store.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/shown.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {
namespace {

using io::Json;

Json json_of(const FatigueSettings& known, const ContactFatigue& c) {
  Json out;
  io::add_to(out, c, kUtilisedFriction);
  if (known.shear_yield > 0.0) io::add_to(out, c, kPressureRatio);
  for (const FatigueMeasureRow& row : fatigue_measures())
    if (known.has(row.measure)) io::add_to(out, c, row.of_contact);
  return out;
}

Json json_of(const io::Generation& g) {
  Json out = {{"generation", g.number}, {"progress", io::number(g.progress)}};
  for (const io::EvolutionQuantity& q : io::quantities_of(g)) out[q.name] = io::number(q.value);
  for (const io::EvolvedBody& b : g.bodies)
    if (!b.surface_file.empty()) out[body_name(b.body) + std::string("_file")] = b.surface_file;
  out["cases"] = Json::array();
  for (std::size_t i = 0; i < g.cases.size(); ++i) {
    out["cases"].push_back(io::json_of(g.cases[i]));
    for (const io::EvolvedBody& b : g.bodies)
      if (i < b.fatigue.contacts.size())
        out["cases"].back()[body_name(b.body)] = json_of(b.fatigue.known, b.fatigue.contacts[i]);
  }
  return out;
}

}  // namespace

std::string evolution_json(const io::EvolutionResult& result) {
  Json out = {{"treadmark", {{"version", result.version}, {"git", result.git}}},
              {"input", {{"file", result.input_file}, {"sha256", result.input_sha256}}},
              {"title", result.title},
              {"settings", result.settings},
              {"status", result.status},
              {"message", result.message},
              {"laws", Json::array()}};
  if (!result.generations.empty())
    for (const io::EvolvedBody& b : result.generations.front().bodies)
      out["laws"].push_back({{"body", body_name(b.body)}, {"theory", b.law}, {"source", b.source}});
  if (!result.generations.empty())
    for (const io::EvolvedBody& b : result.generations.front().bodies)
      if (const FatigueSettings& known = b.fatigue.known; !known.measures.empty())
        out["fatigue"].push_back(
            {{"body", body_name(b.body)}, {"measures", words_of(known.measures)}, {"source", known.source}});
  if (!result.generations.empty())
    for (const io::EvolvedBody& b : result.generations.front().bodies)
      if (!b.flow.theory.empty())
        out["flow"].push_back({{"body", body_name(b.body)}, {"theory", b.flow.theory}, {"source", b.flow.source}});
  out["remarks"] = Json::array();
  for (const Remark& r : result.remarks)
    out["remarks"].push_back({{"name", r.row().name}, {"text", r.text}, {"grave", r.grave()}});
  out["generations"] = Json::array();
  for (const io::Generation& g : result.generations) out["generations"].push_back(json_of(g));
  return io::dumped(out, 2) + '\n';
}

std::string evolution_table(const io::EvolutionResult& result) {
  if (result.generations.empty()) return "";
  std::vector<std::vector<std::string>> lines{{"generation"}};
  for (const io::EvolutionQuantity& q : io::quantities_of(result.generations.front()))
    if (q.shown & kInTable) lines.front().push_back(q.name);
  for (const io::Generation& g : result.generations) {
    lines.push_back({fmt::format("{:>10}", g.number)});
    const std::vector<io::EvolutionQuantity> known = io::quantities_of(g);
    for (std::size_t k = 1; k < lines.front().size(); ++k) {
      const auto found = ranges::find(known, lines.front()[k], &io::EvolutionQuantity::name);
      lines.back().push_back(found == known.end() ? "-" : fmt::format("{:.5g}", found->value));
    }
  }
  return io::table_text(lines, {1});
}

void write_evolution_folder(const std::filesystem::path& folder, const io::EvolutionResult& result) {
  std::vector<std::filesystem::path> files;
  files.reserve(result.generations.size());
  for (const io::Generation& g : result.generations) files.push_back(folder / io::generation_file(g.number));
  write_file(folder / "evolution.csv", io::evolution_csv(result));
  io::write_evolution_store(folder / "evolution.h5", result, files);
  write_file(folder / "evolution.json", evolution_json(result));
}

}  // namespace treadmark::app
