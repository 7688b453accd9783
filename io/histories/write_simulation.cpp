// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include "treadmark/io/hdf5/hdf5_writer.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/results/write_hdf5.hpp"
#include "treadmark/io/tables/hdf5_origin.hpp"
#include "treadmark/io/tables/hdf5_rows.hpp"

namespace treadmark::io {
namespace {

void add_pairs(std::vector<Attribute>& list, const std::vector<std::pair<std::string, std::string>>& pairs,
               const char* firsts, const char* seconds) {
  std::vector<std::string> first, second;
  for (const auto& [one, other] : pairs) {
    first.push_back(one);
    second.push_back(other);
  }
  list.push_back({firsts, first});
  list.push_back({seconds, second});
}

std::vector<Attribute> attributes_of(const SimulationResult& result) {
  std::vector<Attribute> list = origin_attributes(kSimulationFormat, result);
  list.push_back({"axes", "x forward, y right, z down; forces and tractions act on the rail"});
  list.push_back({"status", result.status});
  list.push_back({"message", result.message});
  add_pairs(list, result.geometry_sha256, "geometry_files", "geometry_sha256");
  add_pairs(list, result.swept, "swept_keys", "swept_values");
  return list;
}

template <class Named>
void add_names(const Hdf5GroupWriter& group, const std::vector<Named>& list) {
  std::vector<std::string> names;
  for (const Named& one : list) names.push_back(one.name);
  group.add({kNames, names});
}

void write_history(const Hdf5GroupWriter& root, const SimulationResult& result) {
  const Hdf5GroupWriter group = root.make_group("history");
  add_names(group, result.columns);
  for (std::size_t i = 0; i < result.columns.size(); ++i) {
    const HistoryColumn& column = result.columns[i];
    group.write({column.name, {result.rows()}, column.unit, column.description, true}, column_values(result, i));
  }
}

void write_named(const Hdf5GroupWriter& root, const char* name, const std::vector<NamedValue>& list) {
  const Hdf5GroupWriter group = root.make_group(name);
  add_names(group, list);
  for (const NamedValue& one : list) group.write({one.name, {}, one.unit, one.description}, {&one.value, 1});
}

void write_snapshots(const Hdf5GroupWriter& root, const SimulationResult& result) {
  const Hdf5GroupWriter fields = root.make_group(kFields);
  for (std::size_t i = 0; i < result.snapshots.cases.size(); ++i) {
    const CaseResult& one = result.snapshots.cases[i];
    const Hdf5GroupWriter group = fields.make_group(fmt::format("case_{:04}", one.number));
    if (!result.snapshot_times.empty()) group.add({kTime, result.snapshot_times[i]});
    if (!result.snapshot_scenes.empty()) {
      group.add({kNominal, result.snapshot_scenes[i].nominal ? 1 : 0});
      group.add({kDrawn, result.snapshot_scenes[i].drawn ? 1 : 0});
    }
    write_case(group, one, CaseTimes::left_out);
  }
  write_surfaces(fields, result.snapshots.sampled);
}

void write_bytes(const Hdf5GroupWriter& root, const std::vector<std::byte>& bytes) {
  if (bytes.empty()) return;
  root.write({kCheckpoint, {bytes.size()}, "1", "state from which the simulation can go on", true},
             std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

}  // namespace

void write_simulation(const std::filesystem::path& path, const SimulationResult& result) {
  check_simulation(result);
  Hdf5Writer file(path);
  const Hdf5GroupWriter& root = file.root();
  root.add(attributes_of(result));
  write_history(root, result);
  write_rows(root.make_group("events"), result.events);
  write_named(root, "static", result.statics);
  write_named(root, "summary", result.summary);
  write_rows(root.make_group("modes"), result.modes);
  write_snapshots(root, result);
  write_bytes(root, result.checkpoint);
  file.commit();
}

}  // namespace treadmark::io
