// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/report/pictures/chart.hpp"

namespace treadmark::pictures {
namespace {

constexpr double kWidest = 3.0, kNarrowest = 1.3;  // [px]
constexpr const char* kDashes = "7 3.5";
constexpr double kTitleY = 22.0, kNameSlope = 0.574, kNameGap = 8.0;  // sine of 35 degrees
constexpr double kBelowChart = 58.0;                                  // of a legend

/// Legend of a chart that has one.
std::vector<ChartSeries> legend_of(const ChartSheet& sheet, const Chart& chart) {
  if (sheet.legend == ChartSheet::Legend::none) return {};
  std::vector<ChartSeries> out = named(sheet.legend == ChartSheet::Legend::common ? sheet.series : chart.series);
  if (out.size() == 1 && sheet.legend != ChartSheet::Legend::below && sheet.beside.empty()) out.clear();
  return out;
}

/// Room to the right of the charts, and for names below them.
double room_beside(const ChartSheet& sheet) {
  double room = sheet.beside.empty() ? sheet.right : sheet.legend_width;
  if (sheet.legend == ChartSheet::Legend::below) return room;
  for (const Chart& chart : sheet.charts)
    for (const ChartSeries& one : legend_of(sheet, chart))
      room = std::max({room, sheet.legend_width, sheet.legend_x + 46.0 + text_width(one.name, kChartFont)});
  return room;
}

double room_below(const ChartSheet& sheet) {
  double widest = 0.0;
  for (const Chart& chart : sheet.charts)
    for (const std::string& name : chart.x_names) widest = std::max(widest, text_width(name, kChartFont));
  return widest > 0.0 ? kNameSlope * widest + kNameGap : 0.0;
}

}  // namespace

std::vector<ChartSeries> named(const std::vector<ChartSeries>& series) {
  std::vector<ChartSeries> out;
  std::copy_if(series.begin(), series.end(), std::back_inserter(out),
               [](const auto& one) { return !one.name.empty(); });
  return out;
}

void set_look(ChartSeries& series, std::size_t index, std::size_t count) {
  series.style = static_cast<int>(index);
  series.width =
      count < 2 ? 1.6 : std::lerp(kWidest, kNarrowest, static_cast<double>(index) / static_cast<double>(count - 1));
  if (index % 2 != 0) series.dashes = kDashes;
}

std::optional<AxisRange> range_of_x(const std::vector<Chart>& charts) {
  double low = INFINITY, high = -INFINITY;
  const auto include = [&](double x) {
    if (std::isfinite(x)) low = std::min(low, x), high = std::max(high, x);
  };
  for (const Chart& chart : charts)
    for (const ChartSeries& series : chart.series) {
      for (const auto& point : series.curve) include(point[0]);
      for (const ChartPoint& point : series.points) include(point.x);
    }
  return low < high && std::isfinite(high - low) ? std::optional(AxisRange{low, high}) : std::nullopt;
}

std::string draw_sheet(const ChartSheet& sheet) {
  const std::size_t columns = std::max<std::size_t>(1, sheet.columns);
  const auto across = static_cast<double>(columns), down = std::ceil(static_cast<double>(sheet.charts.size()) / across);
  const double right = sheet.left + across * sheet.width + (across - 1.0) * sheet.gap_x;
  const double lowest = sheet.top + down * sheet.height + (down - 1.0) * sheet.gap_y;
  const auto common = sheet.legend == ChartSheet::Legend::common && !sheet.charts.empty()
                          ? legend_of(sheet, sheet.charts.front())
                          : std::vector<ChartSeries>();
  const double legend_end = kLegendLine * static_cast<double>(common.size());
  const double below = kRemarkLine * std::max(0.0, static_cast<double>(sheet.remarks.size()) - 1.0);
  const double height = std::max(lowest + sheet.bottom + room_below(sheet) + below,
                                 sheet.top + sheet.legend_y + legend_end + sheet.beside_height);
  const bool images = std::any_of(sheet.charts.begin(), sheet.charts.end(), [](const Chart& c) { return c.image; });
  std::string out = svg_head(right + room_beside(sheet), height, kChartFont,
                             std::string(kChartStyle).append(images ? kTickStyle : ""));
  if (images) out += hole_pattern();
  if (!sheet.title.empty())
    out += svg_text(0.5 * (sheet.left + right), kTitleY, sheet.title, "middle", " class=\"title\"");
  for (std::size_t i = 0; i < sheet.charts.size(); ++i) {
    const Box box{sheet.left + static_cast<double>(i % columns) * (sheet.width + sheet.gap_x),
                  sheet.top + static_cast<double>(i / columns) * (sheet.height + sheet.gap_y), sheet.width,
                  sheet.height};
    out += draw_chart(sheet.charts[i], box);
    if (const auto legend = legend_of(sheet, sheet.charts[i]); legend.empty() || !common.empty())
      continue;
    else if (sheet.legend == ChartSheet::Legend::below)
      out += draw_chart_legend(legend, box.x, box.bottom() + kBelowChart, box.width);
    else
      out += draw_chart_legend(legend, box.right() + sheet.legend_x, box.y + sheet.legend_y);
  }
  const double x = right + sheet.legend_x, y = sheet.top + sheet.legend_y;
  if (!common.empty()) out += draw_chart_legend(common, x, y);
  if (!sheet.beside.empty()) out += svg_group("", x, y + legend_end, sheet.beside);
  for (std::size_t i = 0; i < sheet.remarks.size(); ++i)
    out += remark(sheet.left, lowest + sheet.bottom - 10.0 + kRemarkLine * static_cast<double>(i), sheet.remarks[i]);
  return out + "</svg>\n";
}

}  // namespace treadmark::pictures
