// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/app/report/page.hpp"
#include "treadmark/app/report/pages/compared_candidates.hpp"

namespace treadmark::app::report {

/// Errors and deviations of zero lie below any logarithmic axis: the charts show them, and all smaller ones, here [%,
/// µm].
inline constexpr double kLeastShown = 1e-3;

/// Largest error of the largest pressure and largest deviation of the surface over the resolution, a curve a backend.
ChartView accuracy_chart(const ComparedCandidates& all);

/// Mean time of search and distance, memory, and time to build over the resolution, a curve a backend.
ChartView cost_chart(const ComparedCandidates& all);

/// Largest error of the largest pressure over the mean time of search and distance.
ChartView trade_chart(const ComparedCandidates& all);

/// The candidates whose results are drawn over the cases: all where they are few, else the truth, the data as given,
/// and of every backend the finest.
std::vector<const ComparedCandidate*> drawn_over_cases(const ComparedCandidates& all);

/// Largest pressure, normal force and their errors over the steps of a timeline with a step a case.
ChartView case_errors_chart(const ComparedCandidates& all);

/// A line a candidate, and a line a row of the file with everything in it.
Table candidate_table(const ComparedCandidates& all);
Table compared_row_table(const ComparedCandidates& all);

}  // namespace treadmark::app::report
