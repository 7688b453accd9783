// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/report/pictures/comparison_cases.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace treadmark::pictures {

namespace {

/// Largest minus smallest error of the candidates; 0 where none can be compared.
double spread(const io::Comparison& comparison, int case_number) {
  double low = 0.0, high = 0.0;  // the truth
  for (std::size_t i = 1; i < comparison.candidates.size(); ++i) {
    const io::ComparisonRow* row = find_row(comparison.candidates[i], case_number);
    if (row == nullptr || !row->comparable || !std::isfinite(row->pmax_error)) continue;
    low = std::min(low, row->pmax_error);
    high = std::max(high, row->pmax_error);
  }
  return high - low;
}

}  // namespace

std::vector<int> telling_cases(const io::Comparison& comparison, std::size_t count) {
  std::vector<int> cases;
  for (const io::ComparisonCandidate& candidate : comparison.candidates)
    for (const io::ComparisonRow& row : candidate.rows)
      if (std::find(cases.begin(), cases.end(), row.case_number) == cases.end()) cases.push_back(row.case_number);
  if (cases.size() <= count) return cases;

  struct Place {
    std::size_t index;
    double spread;
  };
  std::vector<Place> places;
  for (std::size_t i = 0; i < cases.size(); ++i) places.push_back({i, spread(comparison, cases[i])});
  std::stable_sort(places.begin() + 1, places.end(),
                   [](const Place& a, const Place& b) { return a.spread > b.spread; });
  places.resize(count);
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.index < b.index; });
  std::vector<int> chosen;
  for (const Place& place : places) chosen.push_back(cases[place.index]);
  return chosen;
}

const io::ComparisonRow* find_row(const io::ComparisonCandidate& candidate, int case_number) {
  const auto row = std::find_if(candidate.rows.begin(), candidate.rows.end(),
                                [&](const io::ComparisonRow& r) { return r.case_number == case_number; });
  return row == candidate.rows.end() ? nullptr : &*row;
}

const io::CaseResult* find_result(const io::ComparisonCandidate& candidate, int case_number) {
  const auto result = std::find_if(candidate.results.begin(), candidate.results.end(),
                                   [&](const io::CaseResult& r) { return r.number == case_number; });
  return result == candidate.results.end() ? nullptr : &*result;
}

const io::PatchResult* main_patch(const io::CaseResult& result) {
  const io::PatchResult* best = nullptr;
  for (const io::PatchResult& patch : result.patches)
    if (best == nullptr || patch.fn > best->fn) best = &patch;
  return best;
}

namespace {

/// The column of a backend, or one of several.
struct Column {
  const std::string* name = nullptr;  ///< null: of the truth
  bool sampled = false;               ///< its candidates have resolutions
  std::set<std::size_t> taken;        ///< rows
};

}  // namespace

ComparisonGrid comparison_grid(const io::Comparison& comparison, std::size_t most_columns) {
  const std::vector<io::ComparisonCandidate>& candidates = comparison.candidates;
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
    const io::ComparisonCandidate& candidate = candidates[i];
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

}  // namespace treadmark::pictures
