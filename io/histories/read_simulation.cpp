// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/results/read_hdf5.hpp"
#include "treadmark/io/tables/hdf5_origin.hpp"
#include "treadmark/io/tables/hdf5_rows.hpp"

namespace treadmark::io {
namespace {

/// A file of a simulation, checked for its format.
class Store {
 public:
  explicit Store(const std::filesystem::path& path) : name_(path.string()), file_(path) {
    if (root().text("format") != kSimulationFormat)
      refuse(fmt::format("holds \"{}\" where \"{}\" is read", root().text("format"), kSimulationFormat));
  }

  const Hdf5GroupReader& root() const { return file_.root(); }

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(ErrorKind::input_data, "the store of a simulation " + what, {name_, 0, 0},
                "give a file that a simulation wrote");
  }
  void require(bool condition, const std::string& where) const {
    if (!condition) refuse("has lists of different lengths in " + where);
  }

 private:
  std::string name_;
  Hdf5Reader file_;
};

std::vector<std::pair<std::string, std::string>> pairs(const Store& store, const char* firsts, const char* seconds) {
  const auto first = store.root().texts(firsts), second = store.root().texts(seconds);
  store.require(first.size() == second.size(), seconds);
  std::vector<std::pair<std::string, std::string>> out;
  for (std::size_t i = 0; i < first.size(); ++i) out.emplace_back(first[i], second[i]);
  return out;
}

std::vector<HistoryColumn> read_columns(const Store& store) {
  const Hdf5GroupReader group = store.root().open_group("history");
  std::vector<HistoryColumn> out;
  for (const std::string& name : group.texts(kNames))
    out.push_back({name, group.text_of(name, "unit"), group.text_of(name, "meaning")});
  return out;
}

void read_values(const Store& store, SimulationResult& result) {
  const Hdf5GroupReader group = store.root().open_group("history");
  std::vector<std::vector<double>> columns;
  for (const HistoryColumn& column : result.columns) {
    columns.push_back(group.numbers(column.name));
    store.require(columns.back().size() == columns.front().size(), "history");
  }
  if (columns.empty()) return;
  result.values.reserve(columns.size() * columns.front().size());
  for (std::size_t row = 0; row < columns.front().size(); ++row)
    for (const auto& column : columns) result.values.push_back(column[row]);
}

std::vector<NamedValue> read_named(const Store& store, const char* where) {
  const Hdf5GroupReader group = store.root().open_group(where);
  std::vector<NamedValue> out;
  for (const std::string& name : group.texts(kNames)) {
    const std::vector<double> value = group.numbers(name);
    store.require(value.size() == 1, where);
    out.push_back({name, value.front(), group.text_of(name, "unit"), group.text_of(name, "meaning")});
  }
  return out;
}

std::vector<std::byte> read_bytes(const Store& store) {
  std::vector<std::byte> out;
  if (!store.root().has(kCheckpoint)) return out;
  for (const std::uint8_t one : store.root().bytes(kCheckpoint)) out.push_back(std::byte{one});
  return out;
}

SimulationResult read_head(const Store& store) {
  const Hdf5GroupReader& root = store.root();
  SimulationResult result;
  read_origin(root, result);
  result.status = root.text("status");
  result.message = root.text("message");
  result.swept = pairs(store, "swept_keys", "swept_values");
  result.columns = read_columns(store);
  result.events = read_rows<HistoryEvent>(root.open_group("events"));
  result.statics = read_named(store, "static");
  result.summary = read_named(store, "summary");
  result.modes = read_rows<ModeRow>(root.open_group("modes"));
  return result;
}

}  // namespace

SimulationResult read_simulation(const std::filesystem::path& path) {
  const Store store(path);
  SimulationResult result = read_head(store);
  read_values(store, result);
  result.checkpoint = read_bytes(store);
  return result;
}

SimulationResult read_simulation_head(const std::filesystem::path& path) { return read_head(Store(path)); }

SnapshotSeries read_snapshots(const std::filesystem::path& path) {
  const Store store(path);
  SnapshotSeries series;
  RunResult& run = series.run;
  run.version = store.root().text("version");
  run.git = store.root().text("git");
  const Hdf5GroupReader fields = store.root().open_group(kFields);
  run.cases = read_cases(fields);
  run.cases_total = static_cast<int>(run.cases.size());
  run.sampled = read_surfaces(fields);
  check_surface_names(fields, run.cases, run.sampled);
  for (const CaseResult& one : run.cases) {
    const Hdf5GroupReader group = fields.open_group(fmt::format("case_{:04}", one.number));
    if (group.has_attribute(kTime)) series.times.push_back(group.number(kTime));
    if (group.has_attribute(kNominal))
      series.scenes.push_back({group.integer(kNominal) != 0, group.integer(kDrawn) != 0});
  }
  store.require(series.times.empty() || series.times.size() == run.cases.size(), kFields);
  store.require(series.scenes.empty() || series.scenes.size() == run.cases.size(), kFields);
  return series;
}

SimulationCheckpoint read_checkpoint(const std::filesystem::path& path) {
  const Store store(path);
  const Hdf5GroupReader& root = store.root();
  return {root.text("version"),
          root.text("git"),
          root.text("sha256"),
          root.texts("settings"),
          pairs(store, "geometry_files", "geometry_sha256"),
          read_bytes(store)};
}

}  // namespace treadmark::io
