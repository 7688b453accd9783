// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace treadmark {

/// Significant digits of numbers in files: those of times, of measures of sections, of results, and all there are.
enum class Digits { six = 6, ten = 10, twelve = 12, all = 17 };

/// A unit of files, and how many of it are one of SI.
struct FileUnit {
  std::string_view name = "1";  ///< "1" = dimensionless
  double per_si = 1.0;
};

/// Where people are shown a number, apart from files.
enum Shown : unsigned {
  kOnlyInFiles = 0,
  kInTable = 1,  ///< on the terminal
  kInChart = 2,  ///< of a report
  kInCards = 4,  ///< at the top of a report
};

/// One row a number of a result: files, tables and pages walk the rows of a Row (io/tables/) and name none by
/// themselves. Either get or word is given.
template <class Row>
struct Column {
  std::string_view key;          ///< in JSON, CSV and tables, with its unit; empty: not there
  std::string_view stored = {};  ///< in HDF5, in SI; empty: not there
  FileUnit unit = {};            ///< of the key
  std::string_view meaning = {};
  double (*get)(const Row&) = nullptr;  ///< SI
  void (*put)(Row&, double) = nullptr;  ///< nullptr: follows from others, is not read
  std::string Row::*word = nullptr;     ///< of a text
  bool whole = false;                   ///< a whole number
  bool (*has)(const Row&) = nullptr;    ///< nullptr: always known
  unsigned shown = kOnlyInFiles;

  bool known(const Row& row) const { return has == nullptr || has(row); }
  double in_file(const Row& row) const { return unit.per_si * get(row); }
};

}  // namespace treadmark
