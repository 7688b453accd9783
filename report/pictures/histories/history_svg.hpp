// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/io/histories/history_model.hpp"
#include "treadmark/report/pictures/chart.hpp"

namespace treadmark::pictures {

/// Ends of a range; an absent one is open.
struct Range {
  std::optional<double> low, high;
};

/// The part of a curve in a range of x, cut by straight interpolation at the ends. Parts that belong not together are
/// parted by a NaN, as are those where a value is not finite. Thread-safe.
Curve cut_curve(const Curve& curve, const Range& x);

/// Two columns of a history as a curve. Errors: as column_index. Thread-safe.
Curve history_curve(const io::SimulationResult& result, const std::string& x, const std::string& y);

/// A column of histories as an axis of a chart.
struct HistoryAxis {
  std::string column, label;        ///< "ws1_right.Q_N", "Q [kN]"; an empty label: the name of the column
  double factor = 1.0;              ///< what is drawn over what the column holds
  std::vector<double> levels = {};  ///< values of the column, drawn as dotted lines: a static load
  std::string level_label = {};     ///< what they are; may be empty
};

/// A simulation in a chart.
struct HistoryRun {
  const io::SimulationResult* result = nullptr;
  std::string label;
  std::string panel = {};  ///< of history_multiples_svg
};

struct HistoryChart {
  std::string title;
  HistoryAxis x{"t_s", "t [s]"};
  std::vector<HistoryAxis> y;
  Range x_range = {};  ///< in units of the column
};

/// Histories as an SVG picture: a panel for each axis y above each other, a common axis x, a curve for each run, and a
/// legend where there are several. Curves are thinned to what pixels show: peaks survive. Thread-safe. Errors:
/// Error(configuration) for columns that a run does not have, no axis y, factors and ranges that are none, results
/// whose values are no whole rows.
std::string history_svg(std::span<const HistoryRun> runs, const HistoryChart& chart);

/// One axis y over x as small panels with the same scales, one for each HistoryRun::panel in order of first appearance;
/// the labels stand beside their curves. Errors: as above; Error(configuration) unless there is one axis y.
/// Thread-safe.
std::string history_multiples_svg(std::span<const HistoryRun> runs, const HistoryChart& chart);

/// The numbers behind both pictures, before they are thinned, as a table with commas: run, panel, then the columns of x
/// and of each y within the range of x, exact and in SI units. Errors: as above. Thread-safe.
std::string history_chart_csv(std::span<const HistoryRun> runs, const HistoryChart& chart);

}  // namespace treadmark::pictures
