// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/report/static_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/report/field_catalogue.hpp"
#include "treadmark/report/pictures/chart.hpp"
#include "treadmark/report/pictures/patch_picture.hpp"
#include "treadmark/report/pictures/pressure_svg.hpp"

namespace treadmark::report {

namespace {

constexpr std::size_t kMostPanels = 24;  // of contact patches in a picture

const Axis* axis_of(const ChartView& view, const Page& page) {
  if (view.linked && page.timeline && !page.timeline->axes.empty()) return &page.timeline->axes.front();
  return view.x ? &*view.x : nullptr;
}

pictures::ChartSeries drawn(const Series& series, const std::vector<double>& x, const std::vector<double>& y) {
  pictures::ChartSeries out;
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

pictures::Chart drawn(const ChartView& view, std::size_t which, const Axis* axis, std::size_t step) {
  const Panel& panel = view.panels[which];
  pictures::Chart chart;
  chart.y_label = pictures::with_unit(panel.label, panel.unit);
  chart.y_scale = panel.logarithmic ? pictures::AxisScale::log : pictures::AxisScale::linear;
  chart.x_scale = axis && axis->logarithmic ? pictures::AxisScale::log : pictures::AxisScale::linear;
  for (std::size_t k = 0; k < panel.series.size(); ++k) {
    const Series& series = panel.series[k];
    const bool changing = step < view.by_step.size();
    const std::vector<double>& x = changing            ? view.by_step[step].x
                                   : !series.x.empty() ? series.x
                                   : axis              ? axis->values
                                                       : series.x;
    chart.series.push_back(drawn(series, x, changing ? view.by_step[step].y[which][k] : series.y));
    pictures::set_look(chart.series.back(), k, panel.series.size());
    constexpr std::array<const char*, 4> kDashes{"6 4", "6 4", "2 3", "10 3 2 3"};  // told apart as in live charts
    if (series.dashed) chart.series.back().dashes = kDashes[k % kDashes.size()];
  }
  if (!panel.levels.empty()) {
    pictures::ChartSeries levels;
    levels.style = pictures::kBlack;
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

bool has_pressure(const io::CaseResult& result) {
  return ranges::any_of(result.patches, [](const io::PatchResult& patch) { return !patch.fields.pressure.empty(); });
}

/// All frames or, of many, some at equal distances.
std::vector<Frame> some_of(const std::vector<Frame>& frames) {
  std::vector<Frame> some;
  const std::size_t every = std::max<std::size_t>(1, (frames.size() + kMostPanels - 1) / kMostPanels);
  for (std::size_t i = 0; i < frames.size(); i += every) some.push_back(frames[i]);
  return some;
}

std::string contact_svg(const FrameSet& set) {
  io::RunResult some;
  for (const Frame& frame : some_of(set.frames)) some.cases.push_back(*frame.result);
  some.cases_total = static_cast<int>(some.cases.size());
  return pictures::pressure_svg(some);
}

}  // namespace

std::string chart_svg(const ChartView& view, const Page& page, const std::string& title, std::size_t step) {
  const Axis* axis = axis_of(view, page);
  pictures::ChartSheet sheet;
  sheet.title = title;
  sheet.top = 34.0, sheet.bottom = 60.0;
  sheet.legend = pictures::ChartSheet::Legend::each;
  for (std::size_t i = 0; i < view.panels.size(); ++i) sheet.charts.push_back(drawn(view, i, axis, step));
  std::vector<double> all_x;
  for (const pictures::Chart& chart : sheet.charts)
    for (const pictures::ChartSeries& series : chart.series) {
      for (const auto& point : series.curve) all_x.push_back(point[0]);
      for (const auto& point : series.points) all_x.push_back(point.x);
    }
  if (view.to_scale) {
    std::vector<double> all_y;
    for (const pictures::ChartSeries& series : sheet.charts.front().series) {
      for (const auto& point : series.curve) all_y.push_back(point[1]);
      for (const auto& point : series.points) all_y.push_back(point.y);
    }
    const pictures::ChartAxis across(pictures::AxisScale::linear, all_x), up(pictures::AxisScale::linear, all_y);
    sheet.charts.front().y_range = {up.low(), up.high()};
    sheet.height = sheet.width * (up.high() - up.low()) / (across.high() - across.low());
  }
  const pictures::ChartAxis range(axis && axis->logarithmic ? pictures::AxisScale::log : pictures::AxisScale::linear,
                                  all_x);
  for (pictures::Chart& chart : sheet.charts) {
    chart.x_numbers = &chart == &sheet.charts.back();
    if (axis && !axis->labels.empty())
      chart.x_names = axis->labels;
    else
      chart.x_range = {range.low(), range.high()};
    if (chart.x_numbers && axis && axis->labels.empty()) chart.x_label = pictures::with_unit(axis->label, axis->unit);
  }
  return draw_sheet(sheet);
}

std::vector<std::string> static_figure(const Figure& figure, const Page& page, std::optional<std::size_t> step) {
  if (const auto* picture = std::get_if<PictureView>(&figure.view)) return {picture->svg};
  const std::size_t shown = step.value_or(page.timeline ? page.timeline->start : 0);
  if (const auto* chart = std::get_if<ChartView>(&figure.view)) return {chart_svg(*chart, page, figure.title, shown)};
  if (const auto* map = std::get_if<MapView>(&figure.view)) return {map_svg(*map, figure.title, shown)};
  if (const auto* section = std::get_if<SectionView>(&figure.view)) {
    std::vector<std::string> pictures{section_svg(set_of(page, section->set), page.surfaces)};
    for (const int other : section->over) pictures.push_back(section_svg(set_of(page, other), page.surfaces));
    return pictures;
  }
  if (!std::holds_alternative<ContactView>(figure.view)) return {};
  std::vector<std::string> pictures;
  const std::vector<int>& sets = std::get<ContactView>(figure.view).sets;
  for (const int index : sets) {
    const FrameSet& set = set_of(page, index);
    const bool named =
        sets.size() > 1 && ranges::any_of(set.frames, [](const Frame& frame) { return has_pressure(*frame.result); });
    pictures.push_back(named ? field_svg(set.frames, *find_field("pressure"), set.name) : contact_svg(set));
  }
  return pictures;
}

namespace {

constexpr double kPanel = 210.0;  // longest side [px]
constexpr std::array<const char*, 3> kStateColours{"#2b6ca3", "#e8a33d", "#8c2d5a"};
constexpr std::array<const char*, 3> kStateNames{"adhesion", "slip", "plastic shear"};

/// The patches of a case that have the quantity and are in contact.
std::vector<pictures::PatchPicture> pictures_of(const io::CaseResult& result, const FieldInfo& field) {
  std::vector<pictures::PatchPicture> out;
  for (const io::PatchResult& patch : result.patches) {
    const bool states = field.kind == FieldInfo::Kind::state;
    const std::vector<double> values =
        states ? std::vector<double>(patch.fields.state.begin(), patch.fields.state.end()) : field.values(patch);
    if (auto picture = pictures::make_patch_picture(patch.fields, values, states); picture.nx > 0)
      out.push_back(std::move(picture));
  }
  return out;
}

/// Colours and legend of the values in the panels.
void explain(pictures::PatchSheet& sheet, const FieldInfo& field) {
  sheet.legend.label = pictures::with_unit(field.label, field.unit);
  if (field.kind == FieldInfo::Kind::state) {
    for (std::size_t k = 0; k < kStateColours.size(); ++k) {
      sheet.steps.emplace_back(static_cast<double>(k + 1), kStateColours[k]);
      sheet.legend.lines.push_back({"", kStateNames[k], kStateColours[k]});
    }
    return;
  }
  double low = INFINITY, high = -INFINITY;
  for (const pictures::PatchPanel& panel : sheet.panels)
    for (const pictures::PatchPicture& one : panel.patches)
      for (std::size_t i = 0; i < one.values.size(); ++i)
        if (one.contact[i] != 0) low = std::min(low, one.values[i]), high = std::max(high, one.values[i]);
  const bool diverging = field.kind == FieldInfo::Kind::diverging;
  sheet.legend.bar = pictures::colour_scale(diverging ? low : std::min(low, 0.0), high, diverging);
  sheet.legend.parts = 4;
  sheet.legend.lines = pictures::pressure_legend(0.0).lines;
  sheet.steps = pictures::colour_steps(*sheet.legend.bar);
  if (!diverging) return;
  sheet.style = ".adhesion{stroke:#1a1a2e;stroke-dasharray:3 2}";  // white is a colour of the values
  sheet.legend.lines[1].fill.clear();
}

}  // namespace

std::string field_svg(const std::vector<Frame>& frames, const FieldInfo& field, const std::string& title) {
  pictures::PatchSheet sheet;
  sheet.title = title;
  for (const Frame& frame : some_of(frames)) {
    pictures::PatchPanel& panel = sheet.panels.emplace_back();
    panel.patches = pictures_of(*frame.result, field);
    panel.titles = {frame.name};
    panel.title_y = -8.0;
    if (panel.patches.empty()) panel.words = pictures::reason_without_patches(*frame.result);
    sheet.least_step = std::max(sheet.least_step, pictures::text_width(frame.name, pictures::kChartFont));
  }
  if (ranges::all_of(sheet.panels, [](const auto& panel) { return panel.patches.empty(); }))
    throw Error(ErrorKind::configuration, fmt::format("these results have no {}", field.label));
  place_windows(sheet, kPanel);
  explain(sheet, field);
  return draw_patch_sheet(std::move(sheet));
}

}  // namespace treadmark::report
