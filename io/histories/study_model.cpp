// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/histories/study_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "treadmark/core/error.hpp"

namespace treadmark::io {
namespace {

void require_new(std::set<std::string>& seen, const std::string& name, int number) {
  if (!seen.insert(name).second)
    throw Error(ErrorKind::configuration, fmt::format("run {} of a study has {} twice", number, name));
}

}  // namespace

const std::string* swept_value(const SimulationRun& run, const std::string& key) {
  for (const auto& [name, value] : run.swept)
    if (name == key) return &value;
  return nullptr;
}

const std::string& label_of_key(const StudyResult& study, const std::string& key) {
  for (const auto& [name, label] : study.labels)
    if (name == key) return label;
  return key;
}

double summary_value(const SimulationRun& run, const std::string& name) {
  for (const NamedValue& one : run.summary)
    if (one.name == name) return one.value;
  return std::numeric_limits<double>::quiet_NaN();
}

StudyTable study_table(const StudyResult& study) {
  StudyTable table;
  for (const SimulationRun& run : study.runs) table.runs.push_back(&run);
  std::sort(table.runs.begin(), table.runs.end(), [](const auto* a, const auto* b) { return a->number < b->number; });
  int before = 0;
  for (const SimulationRun* run : table.runs) {
    if (run->number <= before)
      throw Error(ErrorKind::configuration,
                  fmt::format("run {} of a study is there twice or counts from less than 1", run->number));
    before = run->number;
    std::set<std::string> keys, names;
    for (const auto& [key, value] : run->swept) {
      require_new(keys, key, run->number);
      if (std::find(table.keys.begin(), table.keys.end(), key) == table.keys.end()) table.keys.push_back(key);
    }
    for (const NamedValue& one : run->summary) {
      require_new(names, one.name, run->number);
      const auto same = [&](const NamedValue& other) { return other.name == one.name; };
      if (std::none_of(table.quantities.begin(), table.quantities.end(), same)) table.quantities.push_back(one);
    }
  }
  return table;
}

}  // namespace treadmark::io
