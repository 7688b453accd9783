// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/histories/evolution_store.hpp"

#include <utility>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/tables/hdf5_origin.hpp"
#include "treadmark/io/tables/hdf5_rows.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::io {
namespace {

constexpr const char* kGenerationFormat = "treadmark generation 1";
constexpr const char* kNumbers = "numbers";
constexpr const char* kEvolutionFormat = "treadmark evolution 1";

template <class Record>
void write_sheet(const Hdf5GroupWriter& parent, const SheetRow<Record>& what, const Record& record) {
  const CellSheet& sheet = record.*what.sheet;
  std::vector<double> rows, values;
  for (const auto& [j, row] : sheet.rows()) {
    rows.push_back(j);
    values.insert(values.end(), row.begin(), row.end());
  }
  const Hdf5GroupWriter group = parent.make_group(what.name);
  group.write({"rows", {rows.size()}, "1", "numbers of the rows that are stored", true}, rows);
  group.write({"values", {rows.size(), static_cast<std::size_t>(sheet.nu())}, what.unit, what.meaning, true}, values);
}

template <class Record>
void read_sheet(const Hdf5GroupReader& parent, const SheetRow<Record>& what, const SurfaceCells& cells,
                Record& record) {
  CellSheet& sheet = record.*what.sheet;
  const Hdf5GroupReader group = parent.open_group(what.name);
  const std::vector<double> rows = group.numbers("rows");
  const auto nu = static_cast<std::size_t>(sheet.nu());
  const std::vector<double> values = group.numbers("values", {rows.size(), nu});
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const int j = to_whole<int>(rows[k]);
    if (!(rows[k] >= 0.0) || j >= cells.ny || j != rows[k])
      throw Error(ErrorKind::input_data, fmt::format("the sheet {} has a row {}", what.name, rows[k]),
                  {parent.file(), 0, 0});
    sheet.rows()[j].assign(values.begin() + static_cast<std::ptrdiff_t>(k * nu),
                           values.begin() + static_cast<std::ptrdiff_t>((k + 1) * nu));
  }
}

std::string depth_group(std::size_t k) { return fmt::format("depth_{}", k + 1); }

void write_fatigue(const Hdf5GroupWriter& body, const EvolvedFatigue& fatigue, const SurfaceRecord& record) {
  const Hdf5GroupWriter group = body.make_group("fatigue");
  group.add({"measures", words_of(fatigue.known.measures)});
  group.add({"source", fatigue.known.source});
  for (const FatigueNumber& number : kFatigueNumbers)
    if (!number.stored.empty()) group.add({std::string(number.stored), fatigue.known.*number.value});
  const std::vector<double>& depths = fatigue.known.depths;
  group.write({"depths", {depths.size()}, "m", "below the surface, of the groups depth_1 ..."}, depths);
  write_rows(group, fatigue.contacts);
  for (std::size_t k = 0; k < record.stresses.size(); ++k) {
    const Hdf5GroupWriter at = group.make_group(depth_group(k));
    for (const auto& row : kStressSheets) write_sheet(at, row, record.stresses[k]);
  }
}

void read_fatigue(const Hdf5GroupReader& body, const SurfaceCells& cells, EvolvedFatigue& fatigue,
                  SurfaceRecord& record) {
  if (!body.has("fatigue")) return;
  const Hdf5GroupReader group = body.open_group("fatigue");
  FatigueSettings& known = fatigue.known;
  known.measures = measures_of(group.text("measures"));
  known.source = group.text("source");
  for (const FatigueNumber& number : kFatigueNumbers)
    if (!number.stored.empty()) known.*number.value = group.number(std::string(number.stored));
  known.depths = group.numbers("depths");
  fatigue.contacts = read_rows<ContactFatigue>(group);
  record.stresses.assign(known.depths.size(), StressRecord(cells.nu));
  for (std::size_t k = 0; k < record.stresses.size(); ++k) {
    const Hdf5GroupReader at = group.open_group(depth_group(k));
    for (const auto& row : kStressSheets) read_sheet(at, row, cells, record.stresses[k]);
  }
}

void write_flow(const Hdf5GroupWriter& body, const EvolvedFlow& flow, const SurfaceRecord& record) {
  const Hdf5GroupWriter group = body.make_group("flow");
  const std::vector<Attribute> head{{"theory", flow.theory}, {"source", flow.source}, {"max_raised", flow.max_raised}};
  group.add(head);
  group.write({"depths", {flow.depths.size()}, "m", "below the surface, of the groups depth_1 ..."}, flow.depths);
  for (std::size_t k = 0; k < record.flow.size(); ++k) {
    const Hdf5GroupWriter at = group.make_group(depth_group(k));
    for (const auto& row : kFlowSheets) write_sheet(at, row, record.flow[k]);
  }
}

void read_flow(const Hdf5GroupReader& body, const SurfaceCells& cells, EvolvedFlow& flow, SurfaceRecord& record) {
  if (!body.has("flow")) return;
  const Hdf5GroupReader group = body.open_group("flow");
  flow.theory = group.text("theory"), flow.source = group.text("source");
  flow.max_raised = group.number("max_raised");
  flow.depths = group.numbers("depths");
  record.flow.assign(flow.depths.size(), FlowRecord(cells.nu));
  for (std::size_t k = 0; k < record.flow.size(); ++k) {
    const Hdf5GroupReader at = group.open_group(depth_group(k));
    for (const auto& row : kFlowSheets) read_sheet(at, row, cells, record.flow[k]);
  }
}

void write_numbers(const Hdf5GroupWriter& parent, const std::vector<EvolutionQuantity>& numbers) {
  if (numbers.empty()) return;
  const Hdf5GroupWriter group = parent.make_group(kNumbers);
  std::vector<std::string> names;
  for (const EvolutionQuantity& q : numbers) {
    names.push_back(q.name);
    group.write({q.name, {1}, q.unit, q.meaning}, std::vector<double>{q.value});
  }
  group.add({kNames, names});
}

std::vector<EvolutionQuantity> read_numbers(const Hdf5GroupReader& parent) {
  std::vector<EvolutionQuantity> numbers;
  if (!parent.has(kNumbers)) return numbers;
  const Hdf5GroupReader group = parent.open_group(kNumbers);
  for (const std::string& name : group.texts(kNames))
    numbers.push_back(
        {name, group.text_of(name, "unit"), group.text_of(name, "meaning"), group.numbers(name, {1}).front()});
  return numbers;
}

void write_body(const Hdf5GroupWriter& root, const EvolvedBody& body) {
  const Hdf5GroupWriter group = root.make_group(body_name(body.body));
  const SurfaceCells& c = body.cells;
  write_attributes(group, body);
  group.write({"radius", {c.radius.size()}, "m", "of the rows of a wheel; 1 of a rail", true}, c.radius);
  group.write({"section_z", {body.z.size()}, "m", "height of the section of the first column by row", true}, body.z);
  for (const auto& row : kSheets) write_sheet(group, row, body.record);
  if (!body.fatigue.known.measures.empty()) write_fatigue(group, body.fatigue, body.record);
  if (!body.flow.theory.empty()) write_flow(group, body.flow, body.record);
  write_numbers(group, body.numbers);
}

EvolvedBody read_body(const Hdf5GroupReader& group, Body which) {
  EvolvedBody body;
  body.body = body.cells.body = which;
  SurfaceCells& c = body.cells;
  read_attributes(group, body);
  if (c.nu < 1 || c.ny < 1) throw Error(ErrorKind::input_data, "an evolved surface has no cells", {group.file(), 0, 0});
  const std::vector<std::size_t> rows{static_cast<std::size_t>(c.ny)};
  c.radius = group.numbers("radius", rows);
  body.z = group.numbers("section_z", rows);
  const SurfaceRecord sums = std::exchange(body.record, SurfaceRecord(c.nu));
  body.record.volume_by_law = sums.volume_by_law, body.record.work_of_contacts = sums.work_of_contacts;
  for (const auto& row : kSheets) read_sheet(group, row, c, body.record);
  read_fatigue(group, c, body.fatigue, body.record);
  read_flow(group, c, body.flow, body.record);
  body.numbers = read_numbers(group);
  return body;
}

}  // namespace

void write_generation(const std::filesystem::path& path, const Generation& g) {
  Hdf5Writer file(path);
  file.root().add({"format", std::string(kGenerationFormat)});
  file.root().add({"units", std::string("SI")});
  write_attributes(file.root(), g);
  for (const EvolvedBody& body : g.bodies) write_body(file.root(), body);
  write_rows(file.root().make_group("cases"), g.cases);
  write_numbers(file.root(), g.numbers);
  file.commit();
}

Generation read_generation(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const Hdf5GroupReader& root = file.root();
  if (const std::string format = root.text("format"); format != kGenerationFormat)
    throw Error(ErrorKind::input_data, fmt::format("\"{}\" where \"{}\" is read", format, kGenerationFormat),
                {path.string(), 0, 0}, "give a folder that treadmark evolve wrote");
  Generation g;
  read_attributes(root, g);
  for (const Body body : {Body::wheel, Body::rail}) {
    const char* name = body_name(body);
    if (root.has(name)) g.bodies.push_back(read_body(root.open_group(name), body));
  }
  g.cases = read_rows<EvolvedCase>(root.open_group("cases"));
  g.numbers = read_numbers(root);
  return g;
}

void write_evolution_store(const std::filesystem::path& path, const EvolutionResult& result,
                           const std::vector<std::filesystem::path>& generations) {
  Hdf5Writer file(path);
  file.root().add(origin_attributes(kEvolutionFormat, result));
  const std::vector<Attribute> end{{"status", result.status}, {"message", result.message}};
  file.root().add(end);
  const Hdf5GroupWriter table = file.root().make_group("table");
  if (!result.generations.empty()) {
    std::vector<std::string> names;
    const std::vector<EvolutionQuantity> first = quantities_of(result.generations.front());
    for (std::size_t k = 0; k < first.size(); ++k) {
      std::vector<double> values;
      values.reserve(result.generations.size());
      for (const Generation& g : result.generations) values.push_back(quantities_of(g)[k].value);
      names.push_back(first[k].name);
      table.write({first[k].name, {values.size()}, first[k].unit, first[k].meaning}, values);
    }
    table.add({kNames, names});
  }
  for (std::size_t i = 0; i < generations.size(); ++i)
    file.root().copy_file(generations[i], fmt::format("generation_{:04}", i));
  file.commit();
}

std::string generation_file(int number) { return fmt::format("generation_{:04}.h5", number); }
std::string simulation_file(int number, std::size_t position, std::size_t positions) {
  return positions > 1 ? fmt::format("simulation_{:04}_{}.h5", number, position + 1)
                       : fmt::format("simulation_{:04}.h5", number);
}
std::string contacts_file(int number) { return fmt::format("contacts_{:04}.h5", number); }

EvolutionResult read_evolution_folder(const std::filesystem::path& folder) {
  EvolutionResult result;
  result.input_file = folder.filename().string();
  result.status = "unfinished";
  if (const std::filesystem::path store = folder / "evolution.h5"; std::filesystem::exists(store)) {
    const Hdf5Reader file(store);
    const Hdf5GroupReader& root = file.root();
    read_origin(root, result);
    result.status = root.text("status"), result.message = root.text("message");
  }
  for (int k = 0; std::filesystem::exists(folder / generation_file(k)); ++k) {
    if (k > 0) forget_records(result.generations.back());
    result.generations.push_back(read_generation(folder / generation_file(k)));
  }
  return result;
}

std::string evolution_csv(const EvolutionResult& result) {
  std::string out = "generation";
  if (!result.generations.empty())
    for (const EvolutionQuantity& q : quantities_of(result.generations.front())) out += ',' + csv_cell(q.name);
  out += '\n';
  for (const Generation& g : result.generations) {
    out += std::to_string(g.number);
    for (const EvolutionQuantity& q : quantities_of(g)) out += ',' + csv_number(q.value);
    out += '\n';
  }
  return out;
}

}  // namespace treadmark::io
