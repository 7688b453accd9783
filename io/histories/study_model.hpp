// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/io/histories/history_model.hpp"

namespace treadmark::io {

/// One simulation of a study.
struct SimulationRun {
  int number = 0;                                          ///< from 1
  std::vector<std::pair<std::string, std::string>> swept;  ///< (key, value)
  std::string label, status, message;
  std::vector<NamedValue> summary;
  std::filesystem::path store;  ///< file of write_simulation; empty = none
};

/// Simulations that differ in the values of some keys.
struct StudyResult : Origin {
  /// (key, label) of the keys that the study names otherwise.
  std::vector<std::pair<std::string, std::string>> labels;
  std::vector<SimulationRun> runs;  ///< in any order
};

/// The runs in the order of their numbers, with all keys and all names of summaries in order of first appearance.
struct StudyTable {
  std::vector<const SimulationRun*> runs;  ///< of the study, which must outlive the table
  std::vector<std::string> keys;
  std::vector<NamedValue> quantities;  ///< name, unit and description; the value means nothing
};

/// Errors: Error(configuration) for numbers that are not positive or repeated, and keys or names repeated in a run.
/// Thread-safe.
StudyTable study_table(const StudyResult& study);

/// Value of a swept key; nullptr where the run has none.
const std::string* swept_value(const SimulationRun& run, const std::string& key);

/// What a key is called: its label, else the key itself.
const std::string& label_of_key(const StudyResult& study, const std::string& key);

/// Value of the summary; NaN where the run has none.
double summary_value(const SimulationRun& run, const std::string& name);

}  // namespace treadmark::io
