// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/static_figure.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "treadmark/app/report/field_catalogue.hpp"
#include "treadmark/app/report/field_picture.hpp"
#include "treadmark/app/report/map_picture.hpp"
#include "treadmark/app/report/section_picture.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/histories/history_curves.hpp"
#include "treadmark/io/results/chart_draw.hpp"
#include "treadmark/io/results/picture_svg.hpp"
#include "treadmark/io/results/svg_text.hpp"

namespace treadmark::app::report {
namespace {

// Sizes in pixels.
constexpr double kFigureLeft = 78.0, kFigureTop = 44.0, kFigureRight = 24.0, kFigureBottom = 50.0;
constexpr double kFigureWidth = 640.0, kFigureHeight = 200.0, kBetween = 18.0, kFigureLegend = 24.0;
constexpr std::size_t kMostPanels = 24;  // of contact patches in a picture

std::string axis_label(const std::string& label, const std::string& unit) {
  return unit.empty() ? label : fmt::format("{} [{}]", label, unit);
}

const Axis* axis_of(const ChartView& view, const Page& page) {
  if (view.linked && page.timeline && !page.timeline->axes.empty()) return &page.timeline->axes.front();
  return view.x ? &*view.x : nullptr;
}

io::ChartSeries drawn(const Series& series, const std::vector<double>& x, const std::vector<double>& y) {
  io::ChartSeries out;
  out.name = series.name;
  const std::size_t count = std::min(x.size(), y.size());
  if (series.marks == Series::Marks::line) {
    for (std::size_t i = 0; i < count; ++i) out.curve.push_back({x[i], y[i]});
  } else {
    out.joined = series.marks == Series::Marks::both;
    for (std::size_t i = 0; i < count; ++i)
      out.points.push_back({x[i], y[i], 3.5, "", i < series.texts.size() ? series.texts[i] : ""});
  }
  return out;
}

io::Chart drawn(const ChartView& view, std::size_t which, const Axis* axis, std::size_t step) {
  const Panel& panel = view.panels[which];
  io::Chart chart;
  chart.y_label = axis_label(panel.label, panel.unit);
  chart.y_scale = panel.logarithmic ? io::AxisScale::log : io::AxisScale::linear;
  chart.x_scale = axis && axis->logarithmic ? io::AxisScale::log : io::AxisScale::linear;
  for (std::size_t k = 0; k < panel.series.size(); ++k) {
    const Series& series = panel.series[k];
    const bool changing = step < view.by_step.size();
    const std::vector<double>& x = changing            ? view.by_step[step].x
                                   : !series.x.empty() ? series.x
                                   : axis              ? axis->values
                                                       : series.x;
    chart.series.push_back(drawn(series, x, changing ? view.by_step[step].y[which][k] : series.y));
    io::set_look(chart.series.back(), k, panel.series.size());
    if (series.dashed) chart.series.back().dashes = "6 4";
  }
  if (!panel.levels.empty()) {
    io::ChartSeries levels;
    levels.style = 4;  // black
    for (const Level& level : panel.levels) {
      levels.levels.push_back(level.value);
      if (!level.label.empty()) levels.name += (levels.name.empty() ? "" : ", ") + level.label;
    }
    chart.series.push_back(std::move(levels));
  }
  return chart;
}

const FrameSet& set_of(const Page& page, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= page.sets.size())
    throw Error(ErrorKind::configuration, fmt::format("the report has no contact fields number {}", index));
  return page.sets[static_cast<std::size_t>(index)];
}

constexpr double kTilt = 35.0;  // of the names of categories [degrees]
constexpr double kSine = 0.574;

/// Room for the names of categories below a chart [px].
double category_height(const Axis* axis) {
  double widest = 0.0;
  if (axis)
    for (const std::string& label : axis->labels) widest = std::max(widest, io::text_width(label, io::kChartFont));
  return widest > 0.0 ? kSine * widest + 8.0 : 0.0;
}

/// Names of categories below the place where each is.
std::string category_names(const Axis& axis, double y) {
  std::string out;
  const double each = kFigureWidth / static_cast<double>(axis.labels.size());
  for (std::size_t i = 0; i < axis.labels.size(); ++i) {
    const double x = kFigureLeft + (static_cast<double>(i) + 0.5) * each + 4.0;
    out += io::svg_text(x, y, axis.labels[i], "end",
                        fmt::format(" transform=\"rotate(-{} {:.1f} {:.1f})\"", kTilt, x, y).c_str());
  }
  return out;
}

bool has_pressure(const io::CaseResult& result) {
  return std::ranges::any_of(result.patches,
                             [](const io::PatchResult& patch) { return !patch.fields.pressure.empty(); });
}

/// All frames or, of many, some at equal distances.
std::string contact_svg(const FrameSet& set) {
  io::RunResult some;
  const std::size_t every = (set.frames.size() + kMostPanels - 1) / kMostPanels;
  for (std::size_t i = 0; i < set.frames.size(); i += std::max<std::size_t>(1, every))
    some.cases.push_back(*set.frames[i].result);
  some.cases_total = static_cast<int>(some.cases.size());
  return io::pressure_svg(some);
}

}  // namespace

std::string chart_svg(const ChartView& view, const Page& page, const std::string& title, std::size_t step) {
  const Axis* axis = axis_of(view, page);
  std::vector<io::Chart> charts;
  double beside = 0.0;
  for (std::size_t i = 0; i < view.panels.size(); ++i) {
    charts.push_back(drawn(view, i, axis, step));
    std::vector<io::ChartSeries> named;
    for (const io::ChartSeries& series : charts.back().series)
      if (!series.name.empty()) named.push_back(series);
    if (named.size() > 1) beside = std::max(beside, kFigureLegend + io::legend_width(named));
  }
  std::vector<double> all_x;
  for (const io::Chart& chart : charts)
    for (const io::ChartSeries& series : chart.series) {
      for (const auto& point : series.curve) all_x.push_back(point[0]);
      for (const auto& point : series.points) all_x.push_back(point.x);
    }
  const double count = static_cast<double>(charts.size());
  const double height =
      kFigureTop + count * kFigureHeight + (count - 1.0) * kBetween + kFigureBottom + category_height(axis);
  std::string out = io::svg_head(kFigureLeft + kFigureWidth + std::max(kFigureRight, beside), height, io::kChartFont,
                                 io::kChartStyle);
  out += io::svg_text(kFigureLeft + 0.5 * kFigureWidth, 22.0, title, "middle", " class=\"title\"");
  const io::ChartAxis range(axis && axis->logarithmic ? io::AxisScale::log : io::AxisScale::linear, all_x);
  double y = kFigureTop - 10.0;
  for (io::Chart& chart : charts) {
    const bool last = &chart == &charts.back();
    const bool categories = axis && !axis->labels.empty();
    chart.x_numbers = last && !categories;
    if (last && axis && !categories) chart.x_label = axis_label(axis->label, axis->unit);
    if (categories)
      chart.x_range = {-0.5, static_cast<double>(axis->labels.size()) - 0.5};
    else if (chart.x_scale == io::AxisScale::linear)
      chart.x_range = {range.low(), range.high()};
    out += io::draw_chart(chart, {kFigureLeft, y, kFigureWidth, kFigureHeight});
    std::vector<io::ChartSeries> named;
    for (const io::ChartSeries& series : chart.series)
      if (!series.name.empty()) named.push_back(series);
    if (named.size() > 1) out += io::draw_chart_legend(named, kFigureLeft + kFigureWidth + kFigureLegend, y + 10.0);
    if (last && categories) out += category_names(*axis, y + kFigureHeight + 16.0);
    y += kFigureHeight + kBetween;
  }
  return out + "</svg>\n";
}

std::vector<std::string> static_figure(const Figure& figure, const Page& page) {
  if (const auto* picture = std::get_if<PictureView>(&figure.view)) return {picture->svg};
  if (const auto* chart = std::get_if<ChartView>(&figure.view)) return {chart_svg(*chart, page, figure.title)};
  if (const auto* map = std::get_if<MapView>(&figure.view)) return {map_svg(*map, figure.title)};
  if (const auto* scene = std::get_if<SceneView>(&figure.view))
    return {section_svg(set_of(page, scene->set), page.surfaces)};
  std::vector<std::string> pictures;
  const std::vector<int>& sets = std::get<ContactView>(figure.view).sets;
  for (const int index : sets) {
    const FrameSet& set = set_of(page, index);
    const bool named = sets.size() > 1 &&
                       std::ranges::any_of(set.frames, [](const Frame& frame) { return has_pressure(*frame.result); });
    pictures.push_back(named ? field_svg(set.frames, *find_field("pressure"), set.name) : contact_svg(set));
  }
  return pictures;
}

}  // namespace treadmark::app::report
