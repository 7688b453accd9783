// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/comparison_grid.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace treadmark::io {
namespace {

/// The column of a backend, or one of several.
struct Column {
  const std::string* name = nullptr;  ///< null: of the truth
  bool sampled = false;               ///< its candidates have resolutions
  std::set<std::size_t> taken;        ///< rows
};

}  // namespace

ComparisonGrid comparison_grid(const Comparison& comparison, std::size_t most_columns) {
  const std::vector<ComparisonCandidate>& candidates = comparison.candidates;
  ComparisonGrid grid;
  if (candidates.empty()) return grid;

  std::vector<double> resolutions;
  for (std::size_t i = 1; i < candidates.size(); ++i)
    if (candidates[i].has_resolution()) resolutions.push_back(candidates[i].resolution);
  std::sort(resolutions.begin(), resolutions.end(), std::greater<>());
  resolutions.erase(std::unique(resolutions.begin(), resolutions.end()), resolutions.end());

  std::vector<Column> columns{{nullptr, false, {0}}};
  grid.places.push_back({});
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    const ComparisonCandidate& candidate = candidates[i];
    const bool sampled = candidate.has_resolution();
    const auto row =
        sampled ? std::find(resolutions.begin(), resolutions.end(), candidate.resolution) : resolutions.begin();
    const auto row_number = static_cast<std::size_t>(row - resolutions.begin());
    auto column = std::find_if(columns.begin(), columns.end(), [&](const Column& c) {
      return c.name != nullptr && *c.name == candidate.name && c.sampled == sampled && !c.taken.contains(row_number);
    });
    if (column == columns.end()) column = columns.insert(columns.end(), {&candidate.name, sampled, {}});
    column->taken.insert(row_number);
    grid.places.push_back({0, row_number, static_cast<std::size_t>(column - columns.begin())});
  }

  const std::size_t most = std::max<std::size_t>(1, most_columns);
  const std::size_t bands = (columns.size() + most - 1) / most;
  grid.columns = (columns.size() + bands - 1) / bands;
  grid.rows.assign((columns.size() + grid.columns - 1) / grid.columns, 0);
  for (GridPlace& place : grid.places) {
    place.band = place.column / grid.columns;
    place.column %= grid.columns;
    grid.rows[place.band] = std::max(grid.rows[place.band], place.row + 1);
  }
  return grid;
}

}  // namespace treadmark::io
