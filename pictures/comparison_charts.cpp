// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/pictures/chart_draw.hpp"
#include "treadmark/pictures/comparison_pictures.hpp"
#include "treadmark/pictures/svg_text.hpp"

namespace treadmark::io {
namespace {

constexpr double kFloor = 1e-3;      // of errors [%] and heights [um]: less is rounding
constexpr double kTimeFloor = 1e-3;  // [ms]
constexpr double kLegendIndent = 28.0, kLegendLeast = 216.0;
constexpr double kLeft = 70.0, kTop = 40.0, kBottom = 66.0;
constexpr double kRemark = 10.0, kRemarkLine = 14.0;  // of the lowest remark, from the end of the picture

/// A style for each backend's name, in the order of first appearance.
class Styles {
 public:
  explicit Styles(const Comparison& comparison) {
    for (const ComparisonCandidate& candidate : comparison.candidates)
      styles_.try_emplace(candidate.name, static_cast<int>(styles_.size()));
  }
  int of(const std::string& name) const { return styles_.at(name); }

  /// Wide lines and large markers below narrow and small ones, so that equal series show.
  void nest(ChartSeries& series) const {
    const double part =
        static_cast<double>(series.style) / std::max<double>(1.0, static_cast<double>(styles_.size()) - 1.0);
    series.width = std::lerp(kWidest, kNarrowest, part);
    if (series.style % 2 != 0) series.dashes = kDashes;
    for (ChartPoint& point : series.points) point.radius = std::lerp(kLargest, kSmallest, part);
  }

 private:
  static constexpr double kWidest = 4.0, kNarrowest = 1.2;  // [px]
  static constexpr double kLargest = 7.0, kSmallest = 3.2;  // [px]
  static constexpr const char* kDashes = "9 5";
  std::map<std::string, int> styles_;
};

/// A series a backend of value over resolution, from fine to coarse.
template <class Value>
std::vector<ChartSeries> over_resolution(const Comparison& comparison, const Styles& styles, const char* unit,
                                         Value value) {
  std::vector<ChartSeries> out;
  for (std::size_t i = 1; i < comparison.candidates.size(); ++i) {
    const ComparisonCandidate& candidate = comparison.candidates[i];
    const double error = value(digest(candidate));
    if (!std::isfinite(error)) continue;
    auto series = std::find_if(out.begin(), out.end(), [&](const ChartSeries& s) { return s.name == candidate.name; });
    if (series == out.end()) {
      ChartSeries fresh;
      fresh.name = candidate.name;
      fresh.style = styles.of(candidate.name);
      series = out.insert(out.end(), std::move(fresh));
    }
    if (candidate.has_resolution()) {
      ChartPoint point;
      point.x = candidate.resolution * 1e3;
      point.y = error;
      point.details = fmt::format("{}: {:.4g} {}", candidate_label(candidate), error, unit);
      series->points.push_back(std::move(point));
    } else {
      series->levels.push_back(error);
    }
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

double legend_width(const std::vector<ChartSeries>& series) {
  double widest = 0.0;
  for (const ChartSeries& item : series) widest = std::max(widest, text_width(item.name, kChartFont));
  return std::max(kLegendLeast, kLegendIndent + 46.0 + widest);
}

std::string truth_words(const Comparison& comparison) {
  return "truth: " + (comparison.truth.empty() ? "none" : comparison.truth);
}

/// Why a candidate has no marker: nothing to compare, or the reason it failed.
std::string not_drawn(const ComparisonCandidate& candidate) {
  return candidate_label(candidate) + (candidate.failure.empty() ? " (nothing to compare)" : " (failed)");
}

std::string remark(double x, double y, const std::string& words) {
  return svg_text(x, y, words, "start", " class=\"remark\"");
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

std::string error_svg(const Comparison& comparison) {
  const Styles styles(comparison);
  std::vector<Chart> charts(2);
  charts[0].title = "largest pressure";
  charts[0].y_label = "largest error of pmax over the cases [%]";
  charts[0].series =
      over_resolution(comparison, styles, "%", [](const CandidateDigest& d) { return d.pmax_error * 1e2; });
  charts[1].title = "surface";
  charts[1].y_label = "largest deviation from the truth [µm]";
  charts[1].series =
      over_resolution(comparison, styles, "µm", [](const CandidateDigest& d) { return d.height_max * 1e6; });

  constexpr double kSize = 330.0, kGap = 90.0;
  const std::vector<ChartSeries> legend = joined(charts);
  const double legend_height = kTop + kLegendLine * static_cast<double>(legend.size() + 3);
  const double width = kLeft + 2.0 * kSize + kGap + legend_width(legend);
  const double height = std::max(kTop + kSize + kBottom, legend_height);
  std::string out = svg_head(width, height, kChartFont, kChartStyle);
  double x = kLeft;
  for (Chart& chart : charts) {
    chart.x_label = "resolution [mm]";
    chart.x_scale = chart.y_scale = AxisScale::log;
    chart.y_floor = kFloor;
    out += draw_chart(chart, {x, kTop, kSize, kSize});
    x += kSize + kGap;
  }
  x += kLegendIndent - kGap;
  double y = kTop + 8.0;
  out += draw_chart_legend(legend, x, y);
  y += kLegendLine * static_cast<double>(legend.size()) + 8.0;
  out += remark(x, y, "dotted: data as given");
  out += remark(x, y + 16.0, fmt::format("hollow: {} or less", kFloor));
  out += remark(kLeft, height - kRemark, truth_words(comparison));
  return out + "</svg>\n";
}

std::string cost_svg(const Comparison& comparison) {
  constexpr double kWidth = 560.0, kHeight = 400.0, kLargestRadius = 16.0, kLeastRadius = 3.0;
  const Styles styles(comparison);
  double largest_memory = 0.0;
  for (const ComparisonCandidate& candidate : comparison.candidates)
    largest_memory = std::max(largest_memory, static_cast<double>(digest(candidate).memory_bytes));

  Chart chart;
  chart.title = "accuracy against cost";
  chart.x_label = "search and distance, mean time per case [ms]";
  chart.y_label = "largest error of pmax over the cases [%]";
  chart.x_scale = chart.y_scale = AxisScale::log;
  chart.x_floor = kTimeFloor;
  chart.y_floor = kFloor;
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < comparison.candidates.size(); ++i) {
    const ComparisonCandidate& candidate = comparison.candidates[i];
    const CandidateDigest all = digest(candidate);
    ChartPoint point;
    point.x = (all.search_s + all.distance_s) * 1e3;
    point.y = all.pmax_error * 1e2;
    if (i == 0 && !candidate.rows.empty()) point.y = 0.0;  // by definition, also where no case has contact
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
      missing.push_back(not_drawn(candidate));
      continue;
    }
    const double memory = static_cast<double>(all.memory_bytes);
    if (largest_memory > 0.0)
      point.radius = std::max(kLeastRadius, kLargestRadius * std::sqrt(memory / largest_memory));
    point.label = candidate_label(comparison, i);
    point.details = fmt::format("{}: {:.4g} ms, {:.4g} %, {:.3g} MB", point.label, point.x, point.y, memory * 1e-6);
    auto series = std::find_if(chart.series.begin(), chart.series.end(),
                               [&](const ChartSeries& s) { return s.name == candidate.name; });
    if (series == chart.series.end()) {
      ChartSeries fresh;
      fresh.name = candidate.name;
      fresh.style = styles.of(candidate.name);
      fresh.joined = false;
      series = chart.series.insert(chart.series.end(), std::move(fresh));
    }
    series->points.push_back(std::move(point));
  }
  // Large markers first, so that small ones are not hidden under them.
  for (ChartSeries& series : chart.series)
    std::stable_sort(series.points.begin(), series.points.end(),
                     [](const ChartPoint& a, const ChartPoint& b) { return a.radius > b.radius; });

  const double legend_x = kLeft + kWidth + kLegendIndent;
  const double legend_height = kLegendLine * static_cast<double>(chart.series.size()) + 8.0;
  const double below = kRemarkLine * static_cast<double>(missing.size());
  const double height = std::max(kTop + kHeight + kBottom + below, kTop + legend_height + 200.0);
  std::string out = svg_head(kLeft + kWidth + legend_width(chart.series), height, kChartFont, kChartStyle);
  out += draw_chart(chart, {kLeft, kTop, kWidth, kHeight});
  out += draw_chart_legend(chart.series, legend_x, kTop + 8.0);
  double y = kTop + 8.0 + legend_height;
  out += remark(legend_x, y, fmt::format("hollow: {} % or less", kFloor));
  out += memory_legend(largest_memory, kLargestRadius, legend_x, y + 30.0);
  y = kTop + kHeight + kBottom - kRemark;
  out += remark(kLeft, y, truth_words(comparison));
  for (const std::string& words : missing) {
    y += kRemarkLine;
    out += remark(kLeft, y, "not drawn: " + words);
  }
  return out + "</svg>\n";
}

void write_error_svg(const std::filesystem::path& path, const Comparison& comparison) {
  write_text_file(path, error_svg(comparison));
}

void write_cost_svg(const std::filesystem::path& path, const Comparison& comparison) {
  write_text_file(path, cost_svg(comparison));
}

}  // namespace treadmark::io
