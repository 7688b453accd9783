// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/pictures/chart_axis.hpp"

namespace treadmark::io {

/// Charts in two dimensions as pieces of SVG. All functions are thread-safe.

struct ChartPoint {
  double x = 0.0, y = 0.0;
  double radius = 4.5;  ///< of a circle with the marker's area [px]
  std::string label;    ///< written beside it; may be empty
  std::string details;  ///< shown by viewers that show titles; may be empty
};

/// Points that share a look.
struct ChartSeries {
  std::string name;
  int style = 0;       ///< colour and marker, see chart_marker.hpp
  bool joined = true;  ///< by straight lines, in the order given
  double width = 1.6;  ///< of the line and of the levels [px]
  std::string dashes;  ///< of the line: lengths of strokes and gaps [px]; empty = a full line
  std::vector<ChartPoint> points;
  std::vector<double> levels;  ///< values of y, drawn as dotted lines across the chart
  std::vector<std::array<double, 2>>
      curve;                ///< (x, y) of any number, joined without markers, thinned to what pixels show
  std::string curve_label;  ///< written beside the highest place of the curve; may be empty
};

struct Chart {
  std::string title, x_label, y_label;
  AxisScale x_scale = AxisScale::linear, y_scale = AxisScale::linear;
  double x_floor = 0.0, y_floor = 0.0;  ///< see ChartAxis; markers at a floor are hollow
  std::optional<std::array<double, 2>> x_range,
      y_range;                              ///< ends of a linear axis, in place of those around the values
  bool x_numbers = true, y_numbers = true;  ///< numbers at the ticks
  std::vector<ChartSeries> series;
};

/// The chart with its frame filling the box; numbers and titles are around it: about 60 px to the left, 40 below and 20
/// above. Values that cannot be shown are left out, and a line is broken there.
std::string draw_chart(const Chart& chart, const ChartBox& box);

/// A line for each series, downwards from (x, y), kLegendLine apart. Markers of joined points have the size of the
/// first.
std::string draw_chart_legend(const std::vector<ChartSeries>& series, double x, double y);
inline constexpr double kLegendLine = 20.0;  // [px]

/// Rules for the style sheet of a picture with charts.
inline constexpr int kChartFont = 12;  // [px]
inline constexpr std::string_view kChartStyle =
    ".title{font-size:13px;font-weight:bold}.frame{fill:none;stroke:#444444}.grid{fill:none;stroke:#cccccc;"
    "stroke-width:.8}.minor{fill:none;stroke:#ececec;stroke-width:.7}.line{fill:none}"
    ".level{fill:none;stroke-dasharray:2 4}.mark{stroke-width:1.3}.label{font-size:11px}"
    ".remark{font-size:11px;fill:#555555}.halo{stroke:#ffffff;stroke-width:3px;paint-order:stroke;stroke-linejoin:"
    "round}";

}  // namespace treadmark::io
