// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/histories/study_store.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/tables/hdf5_origin.hpp"

namespace treadmark::io {

namespace {

constexpr const char* kLabels = "labels";  // of swept keys, as kNames

/// A dataset with a value of each run.
template <class Value, class Get>
void write_runs(const Hdf5GroupWriter& group, const StudyTable& table, Hdf5Dataset what, Get get) {
  std::vector<Value> values;
  for (const SimulationRun* run : table.runs) values.push_back(get(*run));
  what.shape = {values.size()};
  group.write(what, std::span<const Value>(values));
}

void write_sweep(const Hdf5GroupWriter& root, const StudyTable& table, const StudyResult& study) {
  const Hdf5GroupWriter sweep = root.make_group("sweep"), swept = sweep.make_group("swept"),
                        summary = sweep.make_group("summary");
  using Text = std::string;
  write_runs<double>(sweep, table, {"number", {}, "1", "of the run, in the name of its group"},
                     [](auto& run) { return run.number; });
  write_runs<Text>(sweep, table, {"label", {}, "1", "of the run"}, [](auto& run) { return run.label; });
  write_runs<Text>(sweep, table, {"status", {}, "1", "of the run"}, [](auto& run) { return run.status; });
  write_runs<Text>(sweep, table, {"message", {}, "1", "of the run"}, [](auto& run) { return run.message; });
  swept.add({kNames, table.keys});
  std::vector<Text> labels;
  for (const Text& key : table.keys) labels.push_back(label_of_key(study, key));
  swept.add({kLabels, labels});
  for (const std::string& key : table.keys)
    write_runs<Text>(swept, table, {key, {}, "1", "value of the key as written"}, [&](auto& run) {
      const Text* value = swept_value(run, key);
      return value != nullptr ? *value : Text();
    });
  std::vector<Text> names;
  for (const NamedValue& quantity : table.quantities) names.push_back(quantity.name);
  summary.add({kNames, names});
  for (const NamedValue& quantity : table.quantities)
    write_runs<double>(summary, table, {quantity.name, {}, quantity.unit, quantity.description},
                       [&](auto& run) { return summary_value(run, quantity.name); });
}

}  // namespace

void write_study_store(const std::filesystem::path& path, const StudyResult& study) {
  const StudyTable table = study_table(study);
  Hdf5Writer file(path);
  file.root().add(origin_attributes(kStudyFormat, study));
  write_sweep(file.root(), table, study);
  for (const SimulationRun* run : table.runs)
    if (!run->store.empty()) file.root().copy_file(run->store, fmt::format("run_{:04}", run->number));
  file.commit();
}

StudyResult read_study_head(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const Hdf5GroupReader& root = file.root();
  if (const std::string format = root.text("format"); format != kStudyFormat)
    throw Error(ErrorKind::input_data,
                fmt::format("the store of a study holds \"{}\" where \"{}\" is read", format, kStudyFormat),
                {path.string(), 0, 0}, "give a file that treadmark sweep wrote");
  StudyResult study;
  read_origin(root, study);
  const Hdf5GroupReader swept = root.open_group("sweep").open_group("swept");
  if (!swept.has_attribute(kLabels)) return study;
  const std::vector<std::string> keys = swept.texts(kNames), labels = swept.texts(kLabels);
  for (std::size_t i = 0; i < std::min(keys.size(), labels.size()); ++i)
    if (keys[i] != labels[i]) study.labels.emplace_back(keys[i], labels[i]);
  return study;
}

void write_sweep_csv(const std::filesystem::path& path, const StudyResult& study) {
  const StudyTable table = study_table(study);
  std::string out;
  for (const std::string& key : table.keys) out += csv_cell(key) + ',';
  for (const NamedValue& quantity : table.quantities) out += csv_cell(quantity.name) + ',';
  out += "run,label,status,message\n";
  for (const SimulationRun* run : table.runs) {
    for (const std::string& key : table.keys) {
      const std::string* value = swept_value(*run, key);
      out += (value != nullptr ? csv_cell(*value) : "") + ',';
    }
    for (const NamedValue& quantity : table.quantities) {
      const auto same = [&](const NamedValue& one) { return one.name == quantity.name; };
      const auto found = std::find_if(run->summary.begin(), run->summary.end(), same);
      out += (found != run->summary.end() ? csv_number(found->value) : "") + ',';
    }
    out +=
        fmt::format("{},{},{},{}\n", run->number, csv_cell(run->label), csv_cell(run->status), csv_cell(run->message));
  }
  write_file(path, out);
}

}  // namespace treadmark::io
