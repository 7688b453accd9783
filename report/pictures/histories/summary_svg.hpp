// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "treadmark/io/histories/study_model.hpp"
#include "treadmark/report/pictures/chart.hpp"

namespace treadmark::pictures {

/// A value from elsewhere to compare with: in the units of the swept key and of the quantity.
struct SummaryReference {
  double x = 0.0, y = 0.0;
  std::string label;  ///< "paper: 462 kN at 60 m/s"
};

struct SummaryChart {
  std::string title;
  std::string key, x_label;               ///< swept key whose values are numbers: "vehicle.speed", "V [m/s]"
  std::string quantity, y_label;          ///< of the summaries: "q_max_N", "largest Q [kN]"
  double x_factor = 1.0, y_factor = 1.0;  ///< what is drawn over what the study holds
  AxisScale x_scale = AxisScale::linear;
  std::vector<SummaryReference> references = {};
  std::optional<double> level = {};  ///< value of the quantity drawn as a dotted line: a static load
  std::string level_label = {};
};

/// A quantity of the summaries over one swept key as an SVG picture, a line for each choice of the other swept keys.
/// Runs without the quantity are named below. Thread-safe. Errors: as study_table; Error(configuration) for a key or
/// quantity that no run has, values of the key that are no numbers, and factors that are not positive.
std::string summary_svg(const io::StudyResult& study, const SummaryChart& chart);

/// The plotted numbers as a table with commas: kind ("run", "reference" or "level"), line, run, x and y in units of the
/// study. Errors: as above. Thread-safe.
std::string summary_chart_csv(const io::StudyResult& study, const SummaryChart& chart);

}  // namespace treadmark::pictures
