// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/comparison_cases.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::io {
namespace {

/// Largest minus smallest error of the candidates; 0 where none can be compared.
double spread(const Comparison& comparison, int case_number) {
  double low = 0.0, high = 0.0;  // the truth
  for (std::size_t i = 1; i < comparison.candidates.size(); ++i) {
    const ComparisonRow* row = find_row(comparison.candidates[i], case_number);
    if (row == nullptr || !row->comparable || !std::isfinite(row->pmax_error)) continue;
    low = std::min(low, row->pmax_error);
    high = std::max(high, row->pmax_error);
  }
  return high - low;
}

}  // namespace

std::vector<int> telling_cases(const Comparison& comparison, std::size_t count) {
  std::vector<int> cases;
  for (const ComparisonCandidate& candidate : comparison.candidates)
    for (const ComparisonRow& row : candidate.rows)
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

const ComparisonRow* find_row(const ComparisonCandidate& candidate, int case_number) {
  const auto row = std::find_if(candidate.rows.begin(), candidate.rows.end(),
                                [&](const ComparisonRow& r) { return r.case_number == case_number; });
  return row == candidate.rows.end() ? nullptr : &*row;
}

const CaseResult* find_result(const ComparisonCandidate& candidate, int case_number) {
  const auto result = std::find_if(candidate.results.begin(), candidate.results.end(),
                                   [&](const CaseResult& r) { return r.number == case_number; });
  return result == candidate.results.end() ? nullptr : &*result;
}

const PatchResult* main_patch(const CaseResult& result) {
  const PatchResult* best = nullptr;
  for (const PatchResult& patch : result.patches)
    if (best == nullptr || patch.fn > best->fn) best = &patch;
  return best;
}

}  // namespace treadmark::io
