// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/io/histories/history_model.hpp"
#include "treadmark/io/results/chart_draw.hpp"

namespace treadmark::io {

using Curve = std::vector<std::array<double, 2>>;  // (x, y)

/// Ends of a range; an absent one is open.
struct Range {
  std::optional<double> low, high;
};

/// The part of a curve in a range of x, cut by straight interpolation at the ends. Parts that belong not together are
/// parted by a NaN, as are those where a value is not finite. Thread-safe.
Curve cut_curve(const Curve& curve, const Range& x);

/// Two columns of a history as a curve. Errors: as column_index. Thread-safe.
Curve history_curve(const SimulationResult& result, const std::string& x, const std::string& y);

/// Colour, width and dashes of curve number index of count: wide below narrow, so that equal curves show.
void set_look(ChartSeries& series, std::size_t index, std::size_t count);

/// Width of a legend with these names, its lines included [px]; 0 without series.
double legend_width(const std::vector<ChartSeries>& series);

}  // namespace treadmark::io
