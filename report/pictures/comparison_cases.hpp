// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::pictures {

/// Numbers of the cases worth a picture: the first, and those in which the errors of the largest pressure differ most
/// between the candidates (the truth's error is 0); equal ones in the order of the cases. At most count of them, in
/// the order of the cases. Thread-safe.
std::vector<int> telling_cases(const io::Comparison& comparison, std::size_t count);

/// Row or result of a case; null where the candidate has none.
const io::ComparisonRow* find_row(const io::ComparisonCandidate& candidate, int case_number);
const io::CaseResult* find_result(const io::ComparisonCandidate& candidate, int case_number);

/// The patch that carries most of the load; null without patches.
const io::PatchResult* main_patch(const io::CaseResult& result);

/// Place of a candidate's panel, counted from 0: bands lie below each other, each with its own rows and columns.
struct GridPlace {
  std::size_t band = 0, row = 0, column = 0;
};

/// Panels of one case.
struct ComparisonGrid {
  std::vector<GridPlace> places;  ///< of the candidates, in their order; no two are equal
  std::vector<std::size_t> rows;  ///< of each band, without empty ones at its end
  std::size_t columns = 0;        ///< of the widest band
};

/// A column a backend, in the order of first appearance, and a row a resolution, from coarse to fine. The truth, the
/// first candidate, has a column for itself and stands in its first row. Candidates without a resolution have their own
/// column beside those of the same backend, and stand in its first row too. A backend that has a resolution twice gets
/// another column. More than most_columns (at least 1) are spread evenly over bands. Thread-safe.
ComparisonGrid comparison_grid(const io::Comparison& comparison, std::size_t most_columns);

}  // namespace treadmark::pictures
