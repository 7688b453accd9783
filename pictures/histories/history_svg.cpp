// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/pictures/histories/history_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/error.hpp"
#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/pictures/svg_text.hpp"

namespace treadmark::io {

namespace {

// Sizes in pixels.
constexpr double kLeft = 78.0, kTop = 56.0, kRight = 24.0, kBottom = 50.0;
constexpr double kWidth = 640.0, kHeight = 200.0;  // of a panel in a stack
constexpr double kBetween = 18.0;                  // panels in a stack
constexpr double kSmall = 400.0, kSmallHeight = 260.0, kSmallGapX = 26.0, kSmallGapY = 64.0;
constexpr double kLegend = 24.0;  // from the panels

[[noreturn]] void refuse_chart(const std::string& message) {
  throw Error(ErrorKind::configuration, "chart of histories: " + message);
}

void check(std::span<const HistoryRun> runs, const HistoryChart& chart) {
  if (chart.y.empty()) refuse_chart("no axis y");
  for (const HistoryRun& run : runs) {
    if (run.result == nullptr) refuse_chart(fmt::format("run \"{}\" has no result", run.label));
    check_simulation(*run.result);
  }
  std::vector<HistoryAxis> axes = chart.y;
  axes.push_back(chart.x);
  for (const HistoryAxis& axis : axes)
    if (!std::isfinite(axis.factor) || !(axis.factor > 0.0))
      refuse_chart(fmt::format("the factor of {} is {}", axis.column, axis.factor));
  const Range& range = chart.x_range;
  for (const auto& end : {range.low, range.high})
    if (end && !std::isfinite(*end)) refuse_chart("an end of the range of x is not finite");
  if (range.low && range.high && !(*range.low < *range.high)) refuse_chart("the range of x ends before it begins");
}

std::string label_of(const HistoryAxis& axis) { return axis.label.empty() ? axis.column : axis.label; }

ChartSeries make_series(const HistoryRun& run, const HistoryAxis& x, const HistoryAxis& y, const Range& range) {
  ChartSeries series;
  series.name = run.label;
  series.curve = cut_curve(history_curve(*run.result, x.column, y.column), range);
  for (auto& [at, value] : series.curve) {
    at *= x.factor;
    value *= y.factor;
  }
  return series;
}

ChartSeries make_levels(const HistoryAxis& y) {
  ChartSeries series;
  series.style = 4;  // black
  for (const double level : y.levels) series.levels.push_back(level * y.factor);
  return series;
}

/// Ends of the shown range: those asked for, else those of the curves.
std::optional<std::array<double, 2>> shown_x(const std::vector<Chart>& charts, const HistoryChart& spec) {
  double low = INFINITY, high = -INFINITY;
  for (const Chart& chart : charts)
    for (const ChartSeries& series : chart.series)
      for (const auto& point : series.curve)
        if (std::isfinite(point[0])) {
          low = std::min(low, point[0]);
          high = std::max(high, point[0]);
        }
  if (spec.x_range.low) low = *spec.x_range.low * spec.x.factor;
  if (spec.x_range.high) high = *spec.x_range.high * spec.x.factor;
  return low < high && std::isfinite(high - low) ? std::optional(std::array{low, high}) : std::nullopt;
}

/// Round ends around everything in the charts.
std::array<double, 2> shown_y(const std::vector<Chart>& charts) {
  std::vector<double> values;
  for (const Chart& chart : charts)
    for (const ChartSeries& series : chart.series) {
      values.insert(values.end(), series.levels.begin(), series.levels.end());
      for (const auto& point : series.curve) values.push_back(point[1]);
    }
  const ChartAxis axis(AxisScale::linear, values);
  return {axis.low(), axis.high()};
}

/// What the dotted lines are.
std::string level_remark(const HistoryChart& spec, double bottom) {
  std::string words;
  for (const HistoryAxis& y : spec.y)
    if (!y.levels.empty() && !y.level_label.empty() && words.find(y.level_label) == std::string::npos)
      words += (words.empty() ? "dotted: " : ", ") + y.level_label;
  return words.empty() ? "" : svg_text(kLeft, bottom - 14.0, words, "start", " class=\"remark\"");
}

std::string title(const std::string& words, double middle) {
  return svg_text(middle, 22.0, words, "middle", " class=\"title\"");
}

std::vector<std::string> panel_names(std::span<const HistoryRun> runs) {
  std::vector<std::string> names;
  for (const HistoryRun& run : runs)
    if (std::find(names.begin(), names.end(), run.panel) == names.end()) names.push_back(run.panel);
  return names;
}

/// The curves of one of the small panels.
Chart make_small(std::span<const HistoryRun> runs, const HistoryChart& spec, const std::string& name) {
  Chart chart;
  chart.title = name;
  if (!spec.y.front().levels.empty()) chart.series.push_back(make_levels(spec.y.front()));
  std::size_t index = 0;
  for (const HistoryRun& run : runs) {
    if (run.panel != name) continue;
    ChartSeries series = make_series(run, spec.x, spec.y.front(), spec.x_range);
    series.style = static_cast<int>(index++);
    series.width = 1.3;
    series.curve_label = run.label;
    chart.series.push_back(std::move(series));
  }
  return chart;
}

}  // namespace

std::string history_svg(std::span<const HistoryRun> runs, const HistoryChart& spec) {
  check(runs, spec);
  std::vector<Chart> charts;
  for (const HistoryAxis& y : spec.y) {
    Chart chart;
    chart.y_label = label_of(y);
    chart.x_numbers = &y == &spec.y.back();
    if (chart.x_numbers) chart.x_label = label_of(spec.x);
    for (const HistoryRun& run : runs) {
      chart.series.push_back(make_series(run, spec.x, y, spec.x_range));
      set_look(chart.series.back(), chart.series.size() - 1, runs.size());
    }
    if (!y.levels.empty()) chart.series.push_back(make_levels(y));
    charts.push_back(std::move(chart));
  }
  std::vector<ChartSeries> legend = charts.front().series;
  legend.resize(runs.size() > 1 ? runs.size() : 0);
  const double count = static_cast<double>(charts.size());
  const double height = std::max(kTop + count * kHeight + (count - 1.0) * kBetween + kBottom,
                                 kTop + kLegendLine * static_cast<double>(legend.size()) + 16.0);
  const double beside = legend.empty() ? 0.0 : kLegend + legend_width(legend);
  std::string out = svg_head(kLeft + kWidth + (legend.empty() ? kRight : beside), height, kChartFont, kChartStyle);
  out += title(spec.title, kLeft + 0.5 * kWidth) + level_remark(spec, height);
  const auto range = shown_x(charts, spec);
  double y = kTop - 16.0;
  for (Chart& chart : charts) {
    chart.x_range = range;
    out += draw_chart(chart, {kLeft, y, kWidth, kHeight});
    y += kHeight + kBetween;
  }
  if (!legend.empty()) out += draw_chart_legend(legend, kLeft + kWidth + kLegend, kTop - 4.0);
  return out + "</svg>\n";
}

std::string history_multiples_svg(std::span<const HistoryRun> runs, const HistoryChart& spec) {
  check(runs, spec);
  if (spec.y.size() != 1) refuse_chart(fmt::format("small panels show one axis y, not {}", spec.y.size()));
  std::vector<Chart> charts;
  for (const std::string& name : panel_names(runs)) charts.push_back(make_small(runs, spec, name));
  if (charts.empty()) charts.emplace_back();
  const std::size_t count = charts.size(), columns = count > 4 ? 3 : std::min<std::size_t>(count, 2);
  const std::size_t rows = (count + columns - 1) / columns;
  const double across = static_cast<double>(columns), down = static_cast<double>(rows);
  const double panel = count == 1 ? kWidth : kSmall, panel_height = count == 1 ? 1.7 * kHeight : kSmallHeight;
  const double width = across * panel + (across - 1.0) * kSmallGapX;
  const double height = kTop + down * panel_height + (down - 1.0) * kSmallGapY + kBottom;
  std::string out = svg_head(kLeft + width + kRight, height, kChartFont, kChartStyle);
  out += title(spec.title, kLeft + 0.5 * width) + level_remark(spec, height);
  const auto x_range = shown_x(charts, spec);
  const std::array<double, 2> y_range = shown_y(charts);
  for (std::size_t i = 0; i < count; ++i) {
    Chart& chart = charts[i];
    chart.x_range = x_range;
    chart.y_range = y_range;
    chart.y_numbers = i % columns == 0;
    if (chart.y_numbers) chart.y_label = label_of(spec.y.front());
    if (i + columns >= count) chart.x_label = label_of(spec.x);
    out +=
        draw_chart(chart, {kLeft + static_cast<double>(i % columns) * (panel + kSmallGapX),
                           kTop + static_cast<double>(i / columns) * (panel_height + kSmallGapY), panel, panel_height});
  }
  return out + "</svg>\n";
}

std::string history_chart_csv(std::span<const HistoryRun> runs, const HistoryChart& spec) {
  check(runs, spec);
  std::string out = "run,panel," + csv_cell(spec.x.column);
  for (const HistoryAxis& y : spec.y) out += ',' + csv_cell(y.column);
  out += '\n';
  for (const HistoryRun& run : runs) {
    const SimulationResult& result = *run.result;
    std::vector<std::size_t> indices{column_index(result, spec.x.column)};
    for (const HistoryAxis& y : spec.y) indices.push_back(column_index(result, y.column));
    for (std::size_t row = 0; row < result.rows(); ++row) {
      const double* values = result.values.data() + row * result.columns.size();
      const double x = values[indices.front()];
      if ((spec.x_range.low && !(x >= *spec.x_range.low)) || (spec.x_range.high && !(x <= *spec.x_range.high)))
        continue;
      out += csv_cell(run.label) + ',' + csv_cell(run.panel);
      for (const std::size_t index : indices) out += ',' + csv_number(values[index]);
      out += '\n';
    }
  }
  return out;
}

void write_history_svg(const std::filesystem::path& path, std::span<const HistoryRun> runs, const HistoryChart& chart) {
  write_text_file(path, history_svg(runs, chart));
}

void write_history_multiples_svg(const std::filesystem::path& path, std::span<const HistoryRun> runs,
                                 const HistoryChart& chart) {
  write_text_file(path, history_multiples_svg(runs, chart));
}

void write_history_chart_csv(const std::filesystem::path& path, std::span<const HistoryRun> runs,
                             const HistoryChart& chart) {
  write_text_file(path, history_chart_csv(runs, chart));
}

namespace {

constexpr double kWidest = 3.0, kNarrowest = 1.3;  // [px]
constexpr const char* kDashes = "7 3.5";

using Point = std::array<double, 2>;

bool finite(const Point& point) { return std::isfinite(point[0]) && std::isfinite(point[1]); }

Point between(const Point& a, const Point& b, double x) {
  return {x, std::lerp(a[1], b[1], (x - a[0]) / (b[0] - a[0]))};
}

/// Parts of a curve, put together with a NaN between them.
class Parts {
 public:
  void part() { parted_ = !out.empty(); }
  void add(const Point& point) {
    if (parted_) out.push_back({kNone, kNone});
    parted_ = false;
    if (out.empty() || out.back() != point) out.push_back(point);
  }
  Curve out;

 private:
  bool parted_ = false;
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace

Curve cut_curve(const Curve& curve, const Range& x) {
  const double low = x.low.value_or(-std::numeric_limits<double>::infinity());
  const double high = x.high.value_or(std::numeric_limits<double>::infinity());
  const auto inside = [&](const Point& point) { return point[0] >= low && point[0] <= high; };
  Parts parts;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Point& here = curve[i];
    if (!finite(here)) {
      parts.part();
      continue;
    }
    const bool joined = i > 0 && finite(curve[i - 1]);
    if (joined && !(inside(here) && inside(curve[i - 1]))) {
      const Point& before = curve[i - 1];
      const bool forward = before[0] < here[0];
      const double first = forward ? low : high, last = forward ? high : low;
      const auto crosses = [&](double end) {
        return (before[0] < end) != (here[0] < end) && before[0] != end && here[0] != end;
      };
      if (!inside(before)) parts.part();
      if (!inside(before) && crosses(first)) parts.add(between(before, here, first));
      if (!inside(here) && crosses(last)) parts.add(between(before, here, last));
    }
    if (inside(here)) parts.add(here);
  }
  return std::move(parts.out);
}

Curve history_curve(const SimulationResult& result, const std::string& x, const std::string& y) {
  const std::size_t of_x = column_index(result, x), of_y = column_index(result, y), width = result.columns.size();
  Curve out;
  out.reserve(result.rows());
  for (std::size_t row = 0; row < result.rows(); ++row)
    out.push_back({result.values[row * width + of_x], result.values[row * width + of_y]});
  return out;
}

void set_look(ChartSeries& series, std::size_t index, std::size_t count) {
  series.style = static_cast<int>(index);
  series.width =
      count < 2 ? 1.6 : std::lerp(kWidest, kNarrowest, static_cast<double>(index) / static_cast<double>(count - 1));
  if (index % 2 != 0) series.dashes = kDashes;
}

double legend_width(const std::vector<ChartSeries>& series) {
  double widest = 0.0;
  for (const ChartSeries& one : series) widest = std::max(widest, text_width(one.name, kChartFont));
  return series.empty() ? 0.0 : widest + 46.0;
}

}  // namespace treadmark::io
