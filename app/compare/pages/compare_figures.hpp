// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// A candidate and what its page says of all its cases, in the units of compare.json and with the digits of that file.
/// NaN where nothing was measured.
struct ComparedCandidate {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  const io::ComparisonCandidate* data = nullptr;
  std::string label;                                ///< "mesh 0.5 mm"
  double resolution_mm = kNone;                     ///< NaN: the data as given
  std::vector<const io::ComparisonRow*> rows = {};  ///< of each case of the comparison; nullptr where it is missing
  // the largest in size over the cases
  double pmax_error_percent = kNone, mean_pressure_error_percent = kNone, area_error_percent = kNone,
         force_error_percent = kNone, position_error_mm = kNone;
  double judged_error_percent = kNone;          ///< of the pressure by which all are judged
  double search_s = kNone, distance_s = kNone;  ///< mean per case
  // of wheel and rail the worse, and their sums
  double height_max_um = kNone, height_rms_um = kNone, slope_max_mrad = kNone, curvature_max_per_m = kNone;
  double build_s = kNone, memory_MB = kNone;

  double mean_seconds() const { return search_s + distance_s; }
  bool as_given() const { return !data->has_resolution(); }
  bool solved() const { return !data->rows.empty(); }
};

struct ComparedCandidates {
  io::JudgedPressure pressure;
  std::vector<int> cases;                     ///< numbers, increasing
  std::vector<ComparedCandidate> candidates;  ///< the truth first

  const ComparedCandidate* truth() const { return candidates.empty() ? nullptr : &candidates.front(); }
};

/// The comparison must outlive what is returned.
ComparedCandidates compared(const io::Comparison& comparison);

/// Errors and deviations of zero lie below any logarithmic axis: the charts show them, and all smaller ones, here [%,
/// µm].
inline constexpr double kLeastShown = 1e-3;

/// Largest error of the judged pressure and largest deviation of the surface over the resolution, a curve a backend.
report::ChartView accuracy_chart(const ComparedCandidates& all);

/// Mean time of search and distance, memory, and time to build over the resolution, a curve a backend.
report::ChartView cost_chart(const ComparedCandidates& all);

/// Largest error of the judged pressure over the mean time of search and distance.
report::ChartView trade_chart(const ComparedCandidates& all);

/// The candidates whose results are drawn over the cases: all where they are few, else the truth, the data as given,
/// and of every backend the finest.
std::vector<const ComparedCandidate*> drawn_over_cases(const ComparedCandidates& all);

/// Largest pressure, normal force and their errors over the steps of a timeline with a step a case.
report::ChartView case_errors_chart(const ComparedCandidates& all);

/// A line a candidate, and a line a row of the file with everything in it.
report::Table candidate_table(const ComparedCandidates& all);
report::Table compared_row_table(const ComparedCandidates& all);

}  // namespace treadmark::app::pages
