// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app {

/// One of many things for which the same was computed.
struct ListRow {
  std::string name;
  std::string status;  ///< "ok", "within" ...
  std::string error;   ///< why there are no numbers; empty: there are
  std::vector<std::string> words = {};
  std::vector<double> numbers = {};  ///< in the units of the columns; NaN: not known
  double badness = 0.0;              ///< the greater the worse; NaN: nothing to judge by
  std::string document = {};         ///< JSON text of all that is known of it; may be empty
};

/// A number of every row: its name, which ends with its unit, and levels to draw with it.
struct ListColumn {
  std::string name;
  bool shown = false;  ///< also where there is no place for all
  std::vector<report::Level> levels = {};
};

/// Results of many files or pairs, a row each.
struct ResultList {
  std::string title;               ///< what was computed
  std::string things;              ///< what a row is: "files", "pairs"
  std::string settings;            ///< what the numbers depend on beside the files
  std::vector<std::string> words;  ///< names of the columns of words
  std::vector<ListColumn> numbers;
  std::vector<ListRow> rows = {};

  std::size_t failed() const;
  /// Rows that failed, then the others from the worst to the best.
  std::vector<const ListRow*> worst_first() const;
};

/// How the rows are made.
struct ListWork {
  std::size_t count = 0;
  std::function<std::string(std::size_t)> name;
  /// Names of files and profiles, and settings of its own, that a row depends on.
  std::function<std::vector<std::string>(std::size_t)> sources;
  std::function<ListRow(std::size_t)> make;  ///< thread-safe; what it throws becomes the row's error
};

/// Makes the rows on all cores; the result does not depend on the number of threads. Rows that are finished are kept in
/// a file while the work goes on, and after it was interrupted or killed the same call goes on from there: a row counts
/// as finished as long as title, settings, version and sources with their content are the same; those made from cases
/// and slices, which name further files, are always made anew. An empty name: nothing is kept. Throws Cancelled after a
/// stop request, once the rows are kept; Error(configuration) for a file of that name which is not of this kind.
void make_rows(ResultList& list, const ListWork& work, const std::filesystem::path& kept, const Progress& progress);

// What is written. All of them thread-safe.
std::string list_text(const ResultList& list);  ///< for a terminal: columns that are shown, the worst first
std::string list_csv(const ResultList& list);   ///< all columns in the order of the rows
/// A table in an HDF5 file: a dataset a column. Errors: Error(configuration).
void write_list_store(const std::filesystem::path& file, const ResultList& list);
report::Page list_page(const ResultList& list);  ///< the worst first

}  // namespace treadmark::app
