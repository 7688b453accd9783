// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark::io {

/// What a study file asks for: runs of one simulation or case file that differ in some keys, and figures of their
/// results.

/// One value of what is varied.
struct VariedValue {
  std::string label;                   ///< as shown: the value itself, or the name of a set of keys
  std::optional<double> number;        ///< in the unit of the key, where the value is one
  std::vector<std::string> overrides;  ///< "key=value"
  SourcePosition where;
};

struct Variation {
  std::string key;    ///< empty where every value is a set of keys
  std::string label;  ///< for charts; the key without one
  std::vector<VariedValue> values;
};

struct StudyRun {
  int number = 0;                      ///< from 1
  std::vector<std::size_t> values;     ///< which value of each variation
  std::vector<std::string> overrides;  ///< those of the whole study, then its own
};

/// Some runs of a study, by number.
struct RunRange {
  int first = 1, last = std::numeric_limits<int>::max();

  bool whole() const { return *this == RunRange{}; }
  bool has(const StudyRun& run) const { return first <= run.number && run.number <= last; }
  friend bool operator==(const RunRange&, const RunRange&) = default;
};

/// A number of somebody else, to be drawn beside the results.
struct FigureMark {
  double x = 0.0, y = 0.0;  ///< in the units of the columns
  std::string label;
};

struct StudyFigure {
  enum class Kind {
    history,  ///< columns of the runs' histories, a line for each run
    summary,  ///< a point for each run
    patches,  ///< contact patches at the instants that were kept
  };
  std::filesystem::path file;  ///< .svg, as given
  Kind kind = Kind::history;
  std::string title;
  std::string x;               ///< column, or key of a variation; empty for patches
  std::vector<std::string> y;  ///< columns; for patches what is shown of them
  SourcePosition x_where;      ///< where it stands
  std::vector<SourcePosition> y_where;
  std::string x_label, y_label;  ///< empty: those of the columns
  std::optional<std::array<double, 2>> x_range;
  std::string series;               ///< key or label of the variation whose values get a line each; empty: all runs
  std::vector<std::string> labels;  ///< of the lines, in place of the values; empty: the values
  std::vector<std::vector<std::size_t>> only;  ///< by variation: its values that are drawn; empty: all of them
  std::vector<FigureMark> marks;
};

struct StudyFile {
  std::filesystem::path path;
  std::string sha256;  ///< of the study file itself, hex
  std::string title;
  std::filesystem::path base;  ///< simulation or case file; the study file itself where that holds the base
  bool base_is_simulation = false;
  std::vector<Variation> variations;
  std::vector<StudyRun> runs;  ///< product of the variations, the last one fastest
  std::vector<StudyFigure> figures;
  std::vector<std::string> notes;
};

}  // namespace treadmark::io
