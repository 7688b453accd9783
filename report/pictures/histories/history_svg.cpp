// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/report/pictures/histories/history_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/error.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::pictures {

namespace {

[[noreturn]] void refuse_chart(const std::string& message) {
  throw Error(ErrorKind::configuration, "chart of histories: " + message);
}

void check(std::span<const HistoryRun> runs, const HistoryChart& chart) {
  if (chart.y.empty()) refuse_chart("no axis y");
  for (const HistoryRun& run : runs) {
    if (run.result == nullptr) refuse_chart(fmt::format("run \"{}\" has no result", run.label));
    io::check_simulation(*run.result);
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
  series.style = kBlack;
  for (const double level : y.levels) series.levels.push_back(level * y.factor);
  return series;
}

/// Ends of the shown range: those asked for, else those of the curves.
void show_x(std::vector<Chart>& charts, const HistoryChart& spec) {
  const auto shown = range_of_x(charts);
  const double low = spec.x_range.low ? *spec.x_range.low * spec.x.factor : shown ? (*shown)[0] : INFINITY;
  const double high = spec.x_range.high ? *spec.x_range.high * spec.x.factor : shown ? (*shown)[1] : -INFINITY;
  for (Chart& chart : charts)
    if (low < high && std::isfinite(high - low)) chart.x_range = {low, high};
}

/// Round ends around everything in the charts.
AxisRange shown_y(const std::vector<Chart>& charts) {
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
std::vector<std::string> level_remark(const HistoryChart& spec) {
  std::string words;
  for (const HistoryAxis& y : spec.y)
    if (!y.levels.empty() && !y.level_label.empty() && words.find(y.level_label) == std::string::npos)
      words += (words.empty() ? "dotted: " : ", ") + y.level_label;
  return words.empty() ? std::vector<std::string>() : std::vector{words};
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
  ChartSheet sheet;
  sheet.title = spec.title;
  sheet.top = 40.0, sheet.bottom = 66.0;
  sheet.legend = ChartSheet::Legend::common, sheet.legend_y = 12.0;
  for (const HistoryAxis& y : spec.y) {
    Chart& chart = sheet.charts.emplace_back();
    chart.y_label = label_of(y);
    chart.x_numbers = &y == &spec.y.back();
    if (chart.x_numbers) chart.x_label = label_of(spec.x);
    for (const HistoryRun& run : runs) {
      chart.series.push_back(make_series(run, spec.x, y, spec.x_range));
      set_look(chart.series.back(), chart.series.size() - 1, runs.size());
    }
    if (&y == &spec.y.front()) sheet.series = chart.series;
    if (!y.levels.empty()) chart.series.push_back(make_levels(y));
  }
  show_x(sheet.charts, spec);
  sheet.remarks = level_remark(spec);
  return draw_sheet(sheet);
}

std::string history_multiples_svg(std::span<const HistoryRun> runs, const HistoryChart& spec) {
  check(runs, spec);
  if (spec.y.size() != 1) refuse_chart(fmt::format("small panels show one axis y, not {}", spec.y.size()));
  ChartSheet sheet;
  sheet.title = spec.title;
  for (const std::string& name : panel_names(runs)) sheet.charts.push_back(make_small(runs, spec, name));
  if (sheet.charts.empty()) sheet.charts.emplace_back();
  const std::size_t count = sheet.charts.size();
  sheet.columns = count > 4 ? 3 : std::min<std::size_t>(count, 2);
  sheet.top = 56.0, sheet.gap_x = 26.0, sheet.gap_y = 64.0;
  sheet.width = count == 1 ? 640.0 : 400.0, sheet.height = count == 1 ? 340.0 : 260.0;
  sheet.remarks = level_remark(spec);
  if (!sheet.remarks.empty()) sheet.bottom = 66.0;
  show_x(sheet.charts, spec);
  const AxisRange y_range = shown_y(sheet.charts);
  for (std::size_t i = 0; i < count; ++i) {
    Chart& chart = sheet.charts[i];
    chart.y_range = y_range;
    chart.y_numbers = i % sheet.columns == 0;
    if (chart.y_numbers) chart.y_label = label_of(spec.y.front());
    if (i + sheet.columns >= count) chart.x_label = label_of(spec.x);
  }
  return draw_sheet(sheet);
}

std::string history_chart_csv(std::span<const HistoryRun> runs, const HistoryChart& spec) {
  check(runs, spec);
  std::string out = "run,panel," + io::csv_cell(spec.x.column);
  for (const HistoryAxis& y : spec.y) out += ',' + io::csv_cell(y.column);
  out += '\n';
  for (const HistoryRun& run : runs) {
    const io::SimulationResult& result = *run.result;
    std::vector<std::size_t> indices{io::column_index(result, spec.x.column)};
    for (const HistoryAxis& y : spec.y) indices.push_back(io::column_index(result, y.column));
    for (std::size_t row = 0; row < result.rows(); ++row) {
      const double* values = result.values.data() + row * result.columns.size();
      const double x = values[indices.front()];
      if ((spec.x_range.low && !(x >= *spec.x_range.low)) || (spec.x_range.high && !(x <= *spec.x_range.high)))
        continue;
      out += io::csv_cell(run.label) + ',' + io::csv_cell(run.panel);
      for (const std::size_t index : indices) out += ',' + io::csv_number(values[index]);
      out += '\n';
    }
  }
  return out;
}

namespace {

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

Curve history_curve(const io::SimulationResult& result, const std::string& x, const std::string& y) {
  const std::size_t of_x = io::column_index(result, x), of_y = io::column_index(result, y),
                    width = result.columns.size();
  Curve out;
  out.reserve(result.rows());
  for (std::size_t row = 0; row < result.rows(); ++row)
    out.push_back({result.values[row * width + of_x], result.values[row * width + of_y]});
  return out;
}

}  // namespace treadmark::pictures
