// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/report/pictures/colours.hpp"
#include "treadmark/report/pictures/raster.hpp"
#include "treadmark/report/pictures/svg_text.hpp"

namespace treadmark::pictures {

/// Charts in two dimensions as data, and what draws them. All functions are thread-safe.

using Curve = std::vector<std::array<double, 2>>;  // (x, y)
using Pixel = std::array<double, 2>;               // (x, y) in a picture [px]
using AxisRange = std::array<double, 2>;           // low, high

enum class AxisScale { linear, log };

/// Mark on an axis; at = 0 (low end) .. 1 (high end). A mark without a label is a minor one.
struct AxisTick {
  double at = 0.0;
  std::string label;
};

/// Round step of an axis with at most six intervals; length > 0.
double tick_step(double length);

/// AxisRange of an axis around some values, and where a value lies on it. Values that are not finite or beyond 1e+-300
/// are passed over. On a logarithmic axis with a floor > 0 values from 0 to the floor are shown at the floor; other
/// values that are not positive cannot be shown. Without any value to show the range is 0 .. 1 or 0.1 .. 10.
/// Thread-safe.
class ChartAxis {
 public:
  ChartAxis(AxisScale scale, std::span<const double> values, double floor = 0.0);

  /// Of exactly this range; low < high, both finite, and > 0 on a logarithmic axis.
  ChartAxis(AxisScale scale, const AxisRange& range) : scale_(scale), floor_(0.0), low_(range[0]), high_(range[1]) {}

  double low() const { return low_; }
  double high() const { return high_; }

  /// 0 .. 1 for values inside the range, nothing for those that cannot be shown.
  std::optional<double> place(double value) const;
  /// The nearest place of any number.
  double nearest(double value) const;

  /// The value is shown at the floor, not where it is.
  bool at_floor(double value) const { return scale_ == AxisScale::log && value >= 0.0 && value < floor_; }

  /// At most so many intervals of a linear axis.
  std::vector<AxisTick> ticks(int most = 6) const;

 private:
  std::optional<double> shown(double value) const;
  std::optional<double> part(double value) const;
  std::vector<AxisTick> linear_ticks(int most) const;
  std::vector<AxisTick> log_ticks() const;

  AxisScale scale_;
  double floor_, low_, high_;
};

/// A point that wants a text beside it [px].
struct LabelPoint {
  double x = 0.0, y = 0.0, radius = 0.0;
  std::string text;
  double half_height = -1.0;  ///< of what is no circle but a rectangle, whose half width is the radius
};

/// Places of the texts, where their baselines start, in the order of the points: beside, above or below each, inside
/// the box, on as few markers and other texts as can be found one after the other. Points without a text are only kept
/// clear.
std::vector<Pixel> place_labels(std::span<const LabelPoint> points, const Box& box, double font_size);

/// What is left of a line when each column of pixels keeps its first, lowest, highest and last point, in their order:
/// drawn with pixels it looks the same (M4 aggregation, Jugel et al. 2014).
std::vector<Pixel> thin_curve(std::span<const Pixel> line);

/// SVG path data of a line, to 0.01 px.
std::string curve_path(std::span<const Pixel> line);

/// SVG path data of the marker at (x, y); every shape has the area of a circle of this radius [px]. Eight shapes.
std::string chart_marker_path(int style, double x, double y, double radius);

/// Corners of the shape around the origin, for the same area.
std::vector<Pixel> chart_marker_corners(int style, double radius);

struct ChartPoint {
  double x = 0.0, y = 0.0;
  double radius = 4.5;       ///< of a circle with the marker's area [px]
  std::string label = {};    ///< written beside it; may be empty
  std::string details = {};  ///< shown by viewers that show titles; may be empty
};

/// A rectangle or the ellipse in it; what lies outside the axes is cut off.
struct ChartShape {
  double x_low = 0.0, x_high = 0.0, y_low = 0.0, y_high = 0.0;
  std::string label = {}, details = {};  ///< as of points
};

/// Points that share a look.
struct ChartSeries {
  std::string name;
  int style = 0;            ///< colour and marker
  bool joined = true;       ///< by straight lines, in the order given
  double width = 1.6;       ///< of the line and of the levels, diameter of the dots [px]
  std::string dashes = {};  ///< of the line: lengths of strokes and gaps [px]; empty = a full line
  std::vector<ChartPoint> points = {};
  std::vector<double> levels = {};  ///< values of y, drawn as dotted lines across the chart
  Curve curve = {};                 ///< of any number, joined without markers, thinned to what pixels show
  std::string curve_label = {};     ///< written beside the highest place of the curve; may be empty
  std::string colour = {};          ///< in place of that of the style
  Curve dots = {};                  ///< of any number; those that would cover each other are drawn once
  std::vector<ChartShape> shapes = {};
  std::string shape_look = {};  ///< their attributes
  bool ellipses = false;
  double least = 0.0;  ///< width and height of a shape [px]
};

/// A picture that fills the frame, in place of a grid.
struct ChartImage {
  PaletteImage pixels;
  ColourScale colours;  ///< shown as a bar to the right
  std::string label;    ///< above the bar
};

struct Chart {
  std::string title, x_label, y_label;
  AxisScale x_scale = AxisScale::linear, y_scale = AxisScale::linear;
  double x_floor = 0.0, y_floor = 0.0;        ///< see ChartAxis; markers at a floor are hollow
  std::optional<AxisRange> x_range, y_range;  ///< ends of an axis, in place of those around the values
  bool x_numbers = true, y_numbers = true;    ///< numbers at the ticks
  std::vector<ChartSeries> series;
  int x_ticks = 6, y_ticks = 6;               ///< at most so many intervals of a linear axis
  bool y_down = false;                        ///< y grows downwards
  std::vector<std::string> x_names, y_names;  ///< of the places 0, 1, ... in place of numbers; y from the top
  std::vector<std::string> y_notes = {};      ///< inside the frame, at the same places
  std::vector<AxisTick> top = {};             ///< a second axis x above the frame
  std::optional<ChartImage> image = {};
  std::string nothing = "no values";  ///< said in a chart without any
};

/// The chart with its frame filling the box; numbers and titles are around it: about 60 px to the left, 40 below and 20
/// above. Values that cannot be shown are left out, and a line is broken there.
std::string draw_chart(const Chart& chart, const Box& box);

/// A line for each series, downwards from (x, y), kLegendLine apart; with a width, beside each other in lines no wider.
/// Markers of joined points have the size of the first.
std::string draw_chart_legend(const std::vector<ChartSeries>& series, double x, double y, double width = 0.0);
inline constexpr double kLegendLine = 20.0;  // [px]

/// Colour, width and dashes of curve number index of count: wide below narrow, so that equal curves show.
void set_look(ChartSeries& series, std::size_t index, std::size_t count);

/// A whole picture of charts with the same size, row after row [px].
struct ChartSheet {
  enum class Legend { none, common, each, below };

  std::string title;
  std::vector<Chart> charts;
  std::size_t columns = 1;
  double left = 78.0, top = 44.0, right = 24.0, bottom = 50.0;  ///< around the charts
  double width = 640.0, height = 200.0;                         ///< of a chart
  double gap_x = 0.0, gap_y = 18.0;                             ///< between them
  Legend legend = Legend::none;             ///< beside the first or each, with at least two names, or below each
  std::vector<ChartSeries> series = {};     ///< of the common legend
  double legend_x = 24.0, legend_y = 10.0;  ///< of it, from the charts' upper right corner
  double legend_width = 0.0;                ///< of its room, at least
  std::string beside = {};                  ///< elements below the common legend, their origin there
  double beside_height = 16.0;
  std::vector<std::string> remarks = {};  ///< below, from the left
};

std::string draw_sheet(const ChartSheet& sheet);
inline constexpr double kRemarkLine = 15.0;  // [px]

/// The named ones.
std::vector<ChartSeries> named(const std::vector<ChartSeries>& series);

/// AxisRange of all finite x in the charts; nothing where there is no range.
std::optional<AxisRange> range_of_x(const std::vector<Chart>& charts);

/// A line of remarks.
std::string remark(double x, double y, const std::string& words);

/// Rules for the style sheet of a picture with charts.
inline constexpr int kChartFont = 12;  // [px]
inline constexpr std::string_view kChartStyle =
    ".title{font-size:13px;font-weight:bold}.frame{fill:none;stroke:#444444}.grid{fill:none;stroke:#cccccc;"
    "stroke-width:.8}.minor{fill:none;stroke:#ececec;stroke-width:.7}.line{fill:none}"
    ".level{fill:none;stroke-dasharray:2 4}.mark{stroke-width:1.3}.label{font-size:11px}"
    ".remark{font-size:11px;fill:#555555}.halo{stroke:#ffffff;stroke-width:3px;paint-order:stroke;stroke-linejoin:"
    "round}";
inline constexpr std::string_view kTickStyle = ".tick{fill:none;stroke:#666666;stroke-width:.7}";  // with images

}  // namespace treadmark::pictures
