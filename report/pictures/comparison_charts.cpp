// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/report/pictures/chart.hpp"
#include "treadmark/report/pictures/comparison_pictures.hpp"

namespace treadmark::pictures {
namespace {

constexpr double kFloor = 1e-3;      // of errors [%] and heights [um]: less is rounding
constexpr double kTimeFloor = 1e-3;  // [ms]

/// A style for each backend's name, in the order of first appearance.
class Styles {
 public:
  explicit Styles(const io::Comparison& comparison) {
    for (const io::ComparisonCandidate& candidate : comparison.candidates)
      styles_.try_emplace(candidate.name, static_cast<int>(styles_.size()));
  }

  /// That of a backend, at first without points.
  ChartSeries& series(std::vector<ChartSeries>& all, const std::string& name) const {
    const auto found = std::find_if(all.begin(), all.end(), [&](const ChartSeries& s) { return s.name == name; });
    if (found != all.end()) return *found;
    all.push_back({name, styles_.at(name)});
    return all.back();
  }

  /// Wide lines and large markers below narrow and small ones, so that equal series show.
  void nest(ChartSeries& series) const {
    constexpr double kLargestMark = 7.0, kSmallestMark = 3.2;  // [px]
    set_look(series, static_cast<std::size_t>(series.style), styles_.size());
    const double part = series.style / std::max(1.0, static_cast<double>(styles_.size()) - 1.0);
    for (ChartPoint& point : series.points) point.radius = std::lerp(kLargestMark, kSmallestMark, part);
  }

 private:
  std::map<std::string, int> styles_;
};

/// A series a backend of value over resolution, from fine to coarse.
template <class Value>
std::vector<ChartSeries> over_resolution(const io::Comparison& comparison, const Styles& styles, const char* unit,
                                         Value value) {
  std::vector<ChartSeries> out;
  for (std::size_t i = 1; i < comparison.candidates.size(); ++i) {
    const io::ComparisonCandidate& candidate = comparison.candidates[i];
    const double error = value(io::digest(candidate));
    if (!std::isfinite(error)) continue;
    ChartSeries& series = styles.series(out, candidate.name);
    if (candidate.has_resolution())
      series.points.push_back({candidate.resolution * 1e3,
                               error,
                               4.5,
                               {},
                               fmt::format("{}: {:.4g} {}", io::candidate_label(candidate), error, unit)});
    else
      series.levels.push_back(error);
  }
  for (ChartSeries& series : out) {
    std::stable_sort(series.points.begin(), series.points.end(),
                     [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; });
    styles.nest(series);
  }
  return out;
}

/// The backends of some charts, each once.
std::vector<ChartSeries> joined(const std::vector<Chart>& charts) {
  std::vector<ChartSeries> out;
  for (const Chart& chart : charts)
    for (const ChartSeries& series : chart.series) {
      const auto same = std::find_if(out.begin(), out.end(), [&](const auto& s) { return s.name == series.name; });
      if (same == out.end())
        out.push_back(series);
      else if (same->points.empty())
        same->points = series.points;
    }
  return out;
}

ChartSheet comparison_sheet(const io::Comparison& comparison) {
  ChartSheet out;
  out.left = 70.0, out.top = 40.0, out.bottom = 66.0, out.gap_x = 90.0;
  out.legend = ChartSheet::Legend::common, out.legend_x = 28.0, out.legend_y = 8.0, out.legend_width = 216.0;
  out.remarks = {"reference: " + (comparison.truth.empty() ? "none" : comparison.truth)};
  return out;
}

/// Why a candidate has no marker: nothing to compare, or the reason it failed.
std::string not_drawn(const io::ComparisonCandidate& candidate) {
  return io::candidate_label(candidate) + (candidate.failure.empty() ? " (nothing to compare)" : " (failed)");
}

/// Three circles that show what the area of a marker means.
std::string memory_legend(double largest_bytes, double largest_radius, double x, double y) {
  if (!(largest_bytes > 0.0)) return {};
  std::string out = svg_text(x, y, "area of a marker: memory", "start");
  for (const double part : {1.0, 0.25, 0.05}) {
    const double radius = largest_radius * std::sqrt(part);
    y += 12.0 + 2.0 * radius * 0.75;
    out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.2f}\" fill=\"#bbbbbb\" stroke=\"#666666\"/>\n",
                       x + largest_radius, y, radius);
    out += svg_text(x + 2.0 * largest_radius + 10.0, y + 4.0, fmt::format("{:.3g} MB", largest_bytes * part * 1e-6),
                    "start");
  }
  return out;
}

}  // namespace

std::string error_svg(const io::Comparison& comparison) {
  const Styles styles(comparison);
  std::vector<Chart> charts(2);
  const io::JudgedPressure pressure = io::judged_pressure(comparison);
  charts[0].title = pressure.words;
  charts[0].y_label = fmt::format("largest error of {} over the cases [%]", pressure.name);
  charts[0].series =
      over_resolution(comparison, styles, "%", [&](const io::CandidateDigest& d) { return d.*pressure.error * 1e2; });
  charts[1].title = "surface";
  charts[1].y_label = "largest deviation from the reference [µm]";
  charts[1].series =
      over_resolution(comparison, styles, "µm", [](const io::CandidateDigest& d) { return d.height_max * 1e6; });

  ChartSheet sheet = comparison_sheet(comparison);
  sheet.columns = 2, sheet.width = sheet.height = 330.0;
  sheet.series = joined(charts);
  for (Chart& chart : charts) {
    chart.x_label = "resolution [mm]";
    chart.x_scale = chart.y_scale = AxisScale::log;
    chart.y_floor = kFloor;
  }
  sheet.charts = std::move(charts);
  sheet.beside =
      remark(0.0, 8.0, "dotted: data as given") + remark(0.0, 24.0, fmt::format("hollow: {} or less", kFloor));
  sheet.beside_height = 52.0;
  return draw_sheet(sheet);
}

std::string cost_svg(const io::Comparison& comparison) {
  constexpr double kLargestRadius = 16.0, kLeastRadius = 3.0;
  ChartSheet sheet = comparison_sheet(comparison);
  const Styles styles(comparison);
  double largest_memory = 0.0;
  for (const io::ComparisonCandidate& candidate : comparison.candidates)
    largest_memory = std::max(largest_memory, static_cast<double>(io::digest(candidate).memory_bytes));

  Chart chart;
  chart.title = "accuracy against cost";
  chart.x_label = "search and distance, mean time per case [ms]";
  const io::JudgedPressure pressure = io::judged_pressure(comparison);
  chart.y_label = fmt::format("largest error of {} over the cases [%]", pressure.name);
  chart.x_scale = chart.y_scale = AxisScale::log;
  chart.x_floor = kTimeFloor;
  chart.y_floor = kFloor;
  for (std::size_t i = 0; i < comparison.candidates.size(); ++i) {
    const io::ComparisonCandidate& candidate = comparison.candidates[i];
    const io::CandidateDigest all = io::digest(candidate);
    ChartPoint point;
    point.x = (all.search_s + all.distance_s) * 1e3;
    point.y = all.*pressure.error * 1e2;
    if (i == 0 && !candidate.rows.empty()) point.y = 0.0;  // by definition, also where no case has contact
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
      sheet.remarks.push_back("not drawn: " + not_drawn(candidate));
      continue;
    }
    const double memory = static_cast<double>(all.memory_bytes);
    if (largest_memory > 0.0)
      point.radius = std::max(kLeastRadius, kLargestRadius * std::sqrt(memory / largest_memory));
    point.label = io::candidate_label(comparison, i);
    point.details = fmt::format("{}: {:.4g} ms, {:.4g} %, {:.3g} MB", point.label, point.x, point.y, memory * 1e-6);
    ChartSeries& series = styles.series(chart.series, candidate.name);
    series.joined = false;
    series.points.push_back(std::move(point));
  }
  // Large markers first, so that small ones are not hidden under them.
  for (ChartSeries& series : chart.series)
    std::stable_sort(series.points.begin(), series.points.end(),
                     [](const ChartPoint& a, const ChartPoint& b) { return a.radius > b.radius; });

  sheet.width = 560.0, sheet.height = 400.0;
  sheet.series = chart.series;
  sheet.charts = {std::move(chart)};
  sheet.beside = remark(0.0, 8.0, fmt::format("hollow: {} % or less", kFloor)) +
                 memory_legend(largest_memory, kLargestRadius, 0.0, 38.0);
  sheet.beside_height = 200.0;
  return draw_sheet(sheet);
}

}  // namespace treadmark::pictures
