// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/read_evolution.hpp"

#include <sstream>

#include <fmt/format.h>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/simulations/evolve_keys.hpp"
#include "treadmark/io/simulations/read_study.hpp"

namespace treadmark::io {
namespace {

/// Where the numbers of a law or of a material come from is said.
template <class Law>
void check_source(const TableOf<Law>& table, const Law& law) {
  if (law.source.empty())
    table.fail(fmt::format("{} is empty", table.path_of(&Law::source)), "say where the numbers come from");
}

/// The keys that a row of a registry needs are there.
template <class Row>
void need_keys(const TableReader& table, const char* what, const Row& row) {
  std::istringstream needed{std::string(row.keys)};
  for (std::string key; needed >> key;) table.need(key, fmt::format("the {} {} needs {}", what, row.word, row.keys));
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

/// A law of a registry. rows: those of the registry.
template <class Law, class Rows>
Law read_law(const TableOf<Law>& table, const Rows& rows) {
  Law law = table.read();
  check_source(table, law);
  need_keys(table, "law", *ranges::find_if(rows, [&](const auto& row) { return row.theory == law.theory; }));
  return checked(table, std::move(law));
}

/// The numbers of the law that a key of a body names, or of its table.
template <class Numbers, class Read>
Numbers named_or(const TableOf<EvolvingBody>& body, Numbers EvolvingBody::*member, Read read) {
  const CaseValue& value = body.need(member);
  const auto* name = std::get_if<std::string>(&value.data);
  if (name == nullptr) return read();
  check_name("law", *name, law_names<Numbers>(), value.where);
  return std::get<Numbers>(law_named(*name)->numbers);
}

/// A table within that of a body, which is there.
template <class Settings>
TableOf<Settings> inner(const TableOf<EvolvingBody>& body, Settings EvolvingBody::*member,
                        const KeyTable<Settings>& keys) {
  const CaseValue& value = body.need(member);
  return {*body.table(body.key(member)), value.where, body.path_of(member), keys};
}

FatigueMeasure measure_named(const TableOf<FatigueSettings>& table, const std::string& word) {
  std::vector<std::string> known;
  for (const FatigueMeasureRow& row : fatigue_measures()) known.emplace_back(row.word);
  check_name("measure", word, known, table.need(&FatigueSettings::measures).where);
  return measures_of(word).front();
}

FatigueSettings read_fatigue(const TableOf<FatigueSettings>& table) {
  FatigueSettings out = table.read();
  const std::string path = table.path_of(&FatigueSettings::measures);
  for (const std::string& word : table.words(table.key(&FatigueSettings::measures))) {
    const FatigueMeasure measure = measure_named(table, word);
    if (out.has(measure)) table.fail(fmt::format("{} names {} twice", path, word));
    out.measures.push_back(measure);
    need_keys(table, "measure", row_of(measure));
  }
  if (out.measures.empty()) table.fail(fmt::format("{} is empty", path), "name some, or leave the table out");
  check_source(table, out);
  if (!out.has(FatigueMeasure::subsurface) && !out.has(FatigueMeasure::dang_van)) out.depths.clear();
  return checked(table, std::move(out));
}

EvolvingBody read_body(const TableOf<EvolveInput>& evolve, EvolvingBody EvolveInput::*member, Body body) {
  const TableOf table(evolve.need(member), evolve.path_of(member), evolving_body_keys());
  EvolvingBody out = table.read();
  out.body = body;
  out.where = table.where();
  using B = EvolvingBody;
  out.law = named_or(table, &B::law, [&] { return read_law(inner(table, &B::law, wear_law_keys()), kWearTheories); });
  if (table.find(&B::fatigue) != nullptr)
    out.fatigue = named_or(table, &B::fatigue, [&] { return read_fatigue(inner(table, &B::fatigue, fatigue_keys())); });
  if (table.find(&B::flow) != nullptr) out.flow = read_law(inner(table, &B::flow, flow_law_keys()), kFlowTheories);
  return out;
}

}  // namespace

EvolutionFile read_evolution_file(const std::filesystem::path& file, std::span<const std::string> overrides) {
  StudyTables tables(file, "evolve", overrides);
  const TableOf evolve(tables.table->value, "evolve", evolve_keys());
  using I = EvolveInput;
  I given = evolve.read();
  EvolutionFile& out = given.file;
  const auto add_body = [&](Body body, EvolvingBody I::*member, std::optional<double> I::*amount) {
    if (evolve.find(member) != nullptr) {
      evolve.table(evolve.key(member));
      evolve.need(amount);
      out.bodies.push_back(read_body(evolve, member, body));
      out.bodies.back().amount = *(given.*amount);
    } else if (evolve.find(amount) != nullptr) {
      evolve.refuse(amount, fmt::format("{} needs {}", evolve.path_of(amount), evolve.path_of(member)),
                    "it says how far that body evolves");
    }
  };
  if (evolve.find(&I::wheel) == nullptr && evolve.find(&I::rail) == nullptr)
    evolve.fail("nothing evolves: neither [evolve.wheel] nor [evolve.rail] is there", "give one of them, with its law");
  add_body(Body::wheel, &I::wheel, &I::distance);
  add_body(Body::rail, &I::rail, &I::passages);
  const auto without_limits = [&](auto... limits) {
    (evolve.exclude(
         [](auto& i) -> auto& { return i.file.updates; }, [limits](auto& i) -> auto& { return i.file.*limits; }),
     ...);
  };
  without_limits(&EvolutionFile::max_depth, &EvolutionFile::max_pressure_change, &EvolutionFile::smallest_step);
  tables.read_runs(evolve);
  out.weights = shares_of_runs(std::move(out.weights), tables.study.runs.size(), evolve,
                               evolve.key([](auto& i) -> auto& { return i.file.weights; }));
  out.positions = std::move(tables.study);
  return std::move(out);
}

}  // namespace treadmark::io
