// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/settings/key_words.hpp"
#include "treadmark/io/simulations/simulation_model.hpp"
#include "treadmark/io/simulations/study_model.hpp"
#include "treadmark/io/simulations/table_of.hpp"

namespace treadmark::io {

/// Reads a study file (TOML, docs/simulation-files.md): [study] with the base it names, relative to its folder, or with
/// the tables of the base beside it. The base is read once with the overrides of every run, so that every varied key
/// and value is known to be right. overrides: "key.path=value", of the study ("study.vary.0.count=3") or of the base
/// for all runs. checked: the runs for which that is done, where others have done it for the rest. Throws
/// Error(configuration) with file:line:column. Safe to call from several threads.
StudyFile read_study_file(const std::filesystem::path& file, std::span<const std::string> overrides = {},
                          const RunRange& checked = {});

/// The base with the overrides of one run. Throws as above.
std::variant<SimulationFile, CaseFile> read_study_run(const StudyFile& study, const StudyRun& run);

/// What the first run asks for, in words and units, with all values of what varies. Errors: as read_study_run.
Inputs inputs_of(const StudyFile& study);

/// Parts of the reader of study files. Error(configuration) at the place of what is wrong.

/// A file with a table of runs: [study], [evolve] or [design].
struct StudyTables {
  /// Parses the file and finds the table; overrides below it change it. Errors: as read_study_file.
  StudyTables(const std::filesystem::path& file, std::string_view name, std::span<const std::string> overrides);
  StudyTables(const StudyTables&) = delete;  // table points into the document
  StudyTables& operator=(const StudyTables&) = delete;
  /// Title, variations, runs and base of the study, from a reader of the table; every run is read once.
  void read_runs(const TableReader& reader, const RunRange& checked = {});

  CaseTable document;
  const CaseEntry* table = nullptr;  ///< in the document
  StudyFile study;                   ///< path and sha256 at first

 private:
  std::vector<std::string> common_;  ///< overrides of all runs
};

/// [[study.vary]].
std::vector<Variation> read_variations(const TableOf<StudyFile>& study);

/// All combinations, the last variation fastest. common: overrides of all runs.
std::vector<StudyRun> runs_of(const std::vector<Variation>& variations, const std::vector<std::string>& common);

/// Shares of runs that sum up to 1, from the weights that a key of the table gives; none: equal shares.
std::vector<double> shares_of_runs(std::vector<double> weights, std::size_t runs, const TableReader& table,
                                   std::string_view key);

/// [[study.figures]].
std::vector<StudyFigure> read_figures(const TableOf<StudyFile>& study, const std::vector<Variation>& variations);

}  // namespace treadmark::io
