// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/histories/summary_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::pictures {
namespace {

constexpr double kStudyMargin = 0.04;  // of x, beyond the values

[[noreturn]] void refuse_study(const std::string& message) {
  throw Error(ErrorKind::configuration, "chart of a study: " + message);
}

double number(const std::string& text, const std::string& key, int run) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value))
    refuse_study(fmt::format("\"{}\", {} of run {}, is no number", text, key, run));
  return value;
}

struct SummaryPoint {
  int run = 0;
  double x = 0.0, y = 0.0;  ///< in units of the study
};

struct SummaryLine {
  std::string name;
  std::vector<SummaryPoint> points;
};

struct SummaryLines {
  std::vector<SummaryLine> lines;
  std::vector<const io::SimulationRun*> missing;
};

std::string line_name(const io::SimulationRun& run, const io::StudyTable& table, const std::string& key) {
  std::string name;
  for (const std::string& other : table.keys) {
    const std::string* value = io::swept_value(run, other);
    if (other != key && value != nullptr) name += fmt::format("{}{} = {}", name.empty() ? "" : ", ", other, *value);
  }
  return name;
}

SummaryLines make_lines(const io::StudyResult& study, const SummaryChart& spec) {
  const io::StudyTable table = io::study_table(study);
  if (!(spec.x_factor > 0.0) || !(spec.y_factor > 0.0)) refuse_study("a factor is not positive");
  if (std::find(table.keys.begin(), table.keys.end(), spec.key) == table.keys.end())
    refuse_study("no run has the swept key " + spec.key);
  const auto same = [&](const io::NamedValue& one) { return one.name == spec.quantity; };
  if (std::none_of(table.quantities.begin(), table.quantities.end(), same))
    refuse_study("no run has the quantity " + spec.quantity);
  SummaryLines out;
  for (const io::SimulationRun* run : table.runs) {
    const std::string* at = io::swept_value(*run, spec.key);
    const double x = at != nullptr ? number(*at, spec.key, run->number) : NAN,
                 y = io::summary_value(*run, spec.quantity);
    if (!std::isfinite(x) || !std::isfinite(y)) {
      out.missing.push_back(run);
      continue;
    }
    const std::string name = line_name(*run, table, spec.key);
    auto line =
        std::find_if(out.lines.begin(), out.lines.end(), [&](const SummaryLine& one) { return one.name == name; });
    if (line == out.lines.end()) line = out.lines.insert(out.lines.end(), {name, {}});
    line->points.push_back({run->number, x, y});
  }
  for (SummaryLine& line : out.lines)
    std::stable_sort(line.points.begin(), line.points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  return out;
}

/// Around the values with a little room, but not below zero where none of them is.
std::optional<AxisRange> with_room(const Chart& chart) {
  const auto range = chart.x_scale == AxisScale::log ? std::nullopt : range_of_x({chart});
  if (!range) return {};
  const auto [low, high] = *range;
  const double room = kStudyMargin * (high - low), begin = low - room;
  return AxisRange{low >= 0.0 ? std::max(0.0, begin) : begin, high + room};
}

Chart make_chart(const SummaryLines& all, const SummaryChart& spec) {
  Chart chart;
  chart.title = spec.title;
  chart.x_label = spec.x_label.empty() ? spec.key : spec.x_label;
  chart.y_label = spec.y_label.empty() ? spec.quantity : spec.y_label;
  chart.x_scale = spec.x_scale;
  for (const SummaryLine& line : all.lines) {
    ChartSeries series;
    series.name = line.name.empty() ? chart.y_label : line.name;
    set_look(series, chart.series.size(), all.lines.size());
    if (series.style >= kBlack) ++series.style;  // black is for references
    for (const SummaryPoint& one : line.points)
      series.points.push_back({one.x * spec.x_factor, one.y * spec.y_factor, 3.2, {}, fmt::format("run {}", one.run)});
    chart.series.push_back(std::move(series));
  }
  if (spec.level) {
    ChartSeries level;
    level.name = spec.level_label;
    level.style = kBlack;
    level.levels = {*spec.level * spec.y_factor};
    chart.series.push_back(std::move(level));
  }
  ChartSeries references;
  references.name = "reference";
  references.style = kBlack;
  references.joined = false;
  for (const SummaryReference& one : spec.references)
    references.points.push_back({one.x * spec.x_factor, one.y * spec.y_factor, 4.5, one.label, one.label});
  if (!references.points.empty()) chart.series.push_back(std::move(references));
  chart.x_range = with_room(chart);
  return chart;
}

std::string not_drawn(const io::SimulationRun& run) {
  std::string out = fmt::format("not drawn: run {}", run.number);
  if (!run.label.empty()) out += ", " + run.label;
  return out + (run.status.empty() ? "" : " (" + run.status + ")");
}

}  // namespace

std::string summary_svg(const io::StudyResult& study, const SummaryChart& spec) {
  const SummaryLines all = make_lines(study, spec);
  ChartSheet sheet;
  sheet.charts = {make_chart(all, spec)};
  sheet.series = sheet.charts.front().series;
  sheet.legend = ChartSheet::Legend::common, sheet.legend_y = 12.0;
  sheet.top = 46.0, sheet.width = 560.0, sheet.height = 380.0;
  for (const io::SimulationRun* run : all.missing) sheet.remarks.push_back(not_drawn(*run));
  sheet.bottom = sheet.remarks.empty() ? 56.0 : 62.0;
  return draw_sheet(sheet);
}

std::string summary_chart_csv(const io::StudyResult& study, const SummaryChart& spec) {
  const SummaryLines all = make_lines(study, spec);
  std::string out = "kind,line,run," + io::csv_cell(spec.key) + ',' + io::csv_cell(spec.quantity) + '\n';
  for (const SummaryLine& line : all.lines)
    for (const SummaryPoint& one : line.points)
      out += fmt::format("run,{},{},{},{}\n", io::csv_cell(line.name), one.run, io::csv_number(one.x),
                         io::csv_number(one.y));
  for (const SummaryReference& one : spec.references)
    out += fmt::format("reference,{},,{},{}\n", io::csv_cell(one.label), io::csv_number(one.x), io::csv_number(one.y));
  if (spec.level) out += fmt::format("level,{},,,{}\n", io::csv_cell(spec.level_label), io::csv_number(*spec.level));
  return out;
}

}  // namespace treadmark::pictures
