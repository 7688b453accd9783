// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/read_evolution.hpp"

#include <algorithm>
#include <numeric>
#include <sstream>

#include <fmt/format.h>

#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"
#include "treadmark/model/body_name.hpp"

namespace treadmark::io {
namespace {

const WearTheoryRow& theory_named(const std::string& word) {
  return *std::ranges::find(kWearTheories, word, &WearTheoryRow::word);
}

/// Where the numbers of a law or of a material come from.
std::string source_of(const TableReader& table) {
  std::string source = table.text("source");
  if (source.empty())
    table.fail(fmt::format("{} is empty", table.path_of("source")), "say where the numbers come from");
  return source;
}

/// The keys that a row of a registry needs are there.
template <class Row>
void need_keys(const TableReader& table, const char* what, const Row& row) {
  std::istringstream needed{std::string(row.keys)};
  for (std::string key; needed >> key;) table.need(key, fmt::format("the {} {} needs {}", what, row.word, row.keys));
}

/// The keys that are one member each.
template <class Root>
void read_plain(const TableReader& table, const std::vector<SettingKey<Root>>& keys, Root& out) {
  for (const SettingKey<Root>& key : keys)
    if (const CaseValue* value = table.checked_if(key.info.path)) key.set(out, *value, {});
}

/// What check() refuses is refused with the place of the table.
template <class Settings>
Settings checked(const TableReader& table, Settings settings) {
  try {
    check(settings);
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("{}: {}", table.path(), e.message()), table.where(), e.advice());
  }
  return settings;
}

WearLaw read_law(const TableReader& body) {
  const CaseValue& value = body.need("law", "a law of wear has no numbers of its own: see `treadmark list laws`");
  const TableReader table(*body.table("law"), value.where, body.path_of("law"), wear_law_keys());
  const WearTheoryRow& row = theory_named(table.text("theory"));
  WearLaw law;
  law.theory = row.theory;
  law.source = source_of(table);
  need_keys(table, "law", row);
  read_plain(table, plain_wear_law_keys(), law);
  return checked(table, std::move(law));
}

FatigueMeasure measure_named(const TableReader& table, const std::string& word) {
  std::vector<std::string> known;
  for (const FatigueMeasureRow& row : fatigue_measures()) known.emplace_back(row.word);
  check_name("measure", word, known, table.need("measures").where);
  return measures_of(word).front();
}

FatigueSettings read_fatigue(const TableReader& body) {
  FatigueSettings out;
  const CaseTable* given = body.table("fatigue");
  if (given == nullptr) return out;
  const TableReader table(*given, body.need("fatigue").where, body.path_of("fatigue"), fatigue_keys());
  for (const std::string& word : table.words("measures")) {
    const FatigueMeasure measure = measure_named(table, word);
    if (out.has(measure)) table.fail(fmt::format("{} names {} twice", table.path_of("measures"), word));
    out.measures.push_back(measure);
    need_keys(table, "measure", row_of(measure));
  }
  if (out.measures.empty())
    table.fail(fmt::format("{} is empty", table.path_of("measures")), "name some, or leave the table out");
  out.source = source_of(table);
  read_plain(table, plain_fatigue_keys(), out);
  if (!out.has(FatigueMeasure::subsurface) && !out.has(FatigueMeasure::dang_van)) out.depths.clear();
  return checked(table, std::move(out));
}

FlowLaw read_flow(const TableReader& body) {
  FlowLaw law;
  const CaseTable* given = body.table("flow");
  if (given == nullptr) return law;
  const TableReader table(*given, body.need("flow").where, body.path_of("flow"), flow_law_keys());
  const FlowTheoryRow& row = *std::ranges::find(kFlowTheories, table.text("theory"), &FlowTheoryRow::word);
  law.theory = row.theory;
  law.source = source_of(table);
  need_keys(table, "law", row);
  read_plain(table, plain_flow_law_keys(), law);
  return checked(table, std::move(law));
}

EvolvingBody read_body(const TableReader& evolve, const char* key, Body body, const char* amount) {
  const TableReader table(*evolve.table(key), evolve.need(key).where, evolve.path_of(key), evolving_body_keys());
  EvolvingBody out;
  out.body = body;
  out.where = table.where();
  evolve.need(amount, fmt::format("a {} evolves over it", body_name(body)));
  out.amount = evolve.number(amount);
  read_plain(table, plain_evolving_body_keys(), out);
  out.law = read_law(table);
  out.fatigue = read_fatigue(table);
  out.flow = read_flow(table);
  return out;
}

std::vector<double> read_weights(const TableReader& evolve, std::size_t runs) {
  std::vector<double> weights = evolve.numbers("weights");
  if (weights.empty()) weights.assign(runs, 1.0);
  if (weights.size() != runs)
    throw Error(ErrorKind::configuration,
                fmt::format("{} has {} values for {} positions", evolve.path_of("weights"), weights.size(), runs),
                evolve.need("weights").where, "one for each position, in the order of the product of evolve.vary");
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0.0))
    throw Error(ErrorKind::configuration, fmt::format("{} are all zero", evolve.path_of("weights")),
                evolve.need("weights").where);
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

EvolutionFile read_evolution_file(const std::filesystem::path& file, std::span<const std::string> overrides) {
  StudyTables tables(file, "evolve", overrides);
  const TableReader evolve(tables.table->value.table(), tables.table->value.where, "evolve", evolve_keys());
  EvolutionFile out;
  if (evolve.find("wheel") != nullptr) out.bodies.push_back(read_body(evolve, "wheel", Body::wheel, "distance_km"));
  if (evolve.find("rail") != nullptr) out.bodies.push_back(read_body(evolve, "rail", Body::rail, "passages"));
  if (out.bodies.empty())
    evolve.fail("nothing evolves: neither [evolve.wheel] nor [evolve.rail] is there", "give one of them, with its law");
  for (const auto& [body, amount] : {std::pair{"wheel", "distance_km"}, std::pair{"rail", "passages"}})
    if (evolve.find(body) == nullptr && evolve.find(amount) != nullptr)
      throw Error(ErrorKind::configuration, fmt::format("{} needs {}", evolve.path_of(amount), evolve.path_of(body)),
                  evolve.need(amount).where, "it says how far that body evolves");
  read_plain(evolve, plain_evolve_keys(), out);
  for (const char* limit : {"max_depth_mm", "max_pressure_change", "smallest_step"}) evolve.exclude("updates", limit);
  tables.read_runs(evolve);
  out.weights = read_weights(evolve, tables.study.runs.size());
  out.positions = std::move(tables.study);
  return out;
}

}  // namespace treadmark::io
