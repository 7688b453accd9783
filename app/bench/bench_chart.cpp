// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/pictures/chart_axis.hpp"
#include "treadmark/pictures/chart_draw.hpp"
#include "treadmark/pictures/chart_marks.hpp"
#include "treadmark/pictures/svg_text.hpp"

namespace treadmark::app {
namespace {

// [px]
constexpr double kNames = 170.0, kPanel = 290.0, kGap = 26.0, kTop = 34.0, kLine = 23.0, kBelow = 50.0, kLegend = 46.0;
constexpr double kRadius = 5.0;

/// One quantity of a panel.
struct Quantity {
  const char* name;
  int style;
  double BenchRow::*value;
};

struct Panel {
  const char* title;
  const char* unit;
  double scale;
  Body body;  ///< whose rows are drawn
  std::vector<Quantity> quantities;
};

const std::array<Panel, 3>& panels() {
  static const std::vector<Quantity> heights{{"level", 0, &BenchRow::height},
                                             {"tilted", 1, &BenchRow::height_tilted},
                                             {"tilted, with slopes", 2, &BenchRow::normal},
                                             {"what the offsets lie on", 3, &BenchRow::base_height}};
  static const std::array<Panel, 3> all{{{"a height on the wheel", "ns", 1e9, Body::wheel, heights},
                                         {"a height on the rail", "ns", 1e9, Body::rail, heights},
                                         {"wheel on rail",
                                          "ms",
                                          1e3,
                                          Body::wheel,
                                          {{"contact search", 4, &BenchRow::search_cold},
                                           {"after a small move", 5, &BenchRow::search_warm},
                                           {"undeformed distance", 6, &BenchRow::distance}}}}};
  return all;
}

std::string label(const BenchRow& row) {
  return row.resolution > 0.0 ? fmt::format("{} {:g} mm", row.backend, 1e3 * row.resolution) : row.backend;
}

std::string marker(const Quantity& q, double x, double y, const std::string& title) {
  const std::string_view colour = io::chart_colour(q.style);
  return fmt::format(
      "<path class=\"mark\" stroke=\"{0}\" fill=\"{0}\" fill-opacity=\"0.85\" d=\"{1}\"><title>{2}</title></path>\n",
      colour, io::chart_marker_path(q.style, x, y, kRadius), io::xml_text(title));
}

std::string draw(const Panel& panel, const std::vector<BenchRow>& all, double left, double height) {
  std::vector<const BenchRow*> rows;
  std::vector<double> values;
  for (const BenchRow& row : all) {
    if (row.body != panel.body) continue;
    rows.push_back(&row);
    for (const Quantity& q : panel.quantities) values.push_back(panel.scale * row.*q.value);
  }
  const io::ChartAxis axis(io::AxisScale::log, values);
  std::string out = io::svg_text(left + 0.5 * kPanel, kTop - 14.0, panel.title, "middle", " class=\"title\"");
  for (const io::AxisTick& tick : axis.ticks()) {
    const double x = left + tick.at * kPanel;
    out += fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}v{:.1f}\"/>\n", tick.label.empty() ? "minor" : "grid", x,
                       kTop, height);
    if (!tick.label.empty()) out += io::svg_text(x, kTop + height + 16.0, tick.label);
  }
  out += io::svg_text(left + 0.5 * kPanel, kTop + height + 34.0, fmt::format("[{}]", panel.unit));
  out += fmt::format("<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", left,
                     kTop, kPanel, height);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double y = kTop + kLine * (static_cast<double>(i) + 0.5);
    double least = 2.0, most = -1.0;
    std::string marks;
    for (const Quantity& q : panel.quantities) {
      const double value = panel.scale * rows[i]->*q.value;
      const auto at = axis.place(value);
      if (!at) continue;
      least = std::min(least, *at);
      most = std::max(most, *at);
      marks += marker(q, left + *at * kPanel, y,
                      fmt::format("{}, {}: {:.3g} {}", label(*rows[i]), q.name, value, panel.unit));
    }
    if (most > least)
      out += fmt::format("<path class=\"line\" stroke=\"#999999\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n",
                         left + least * kPanel, y, left + most * kPanel);
    out += marks;
    if (!rows[i]->agrees) out += io::svg_text(left + 6.0, y + 4.0, "does not agree", "start", " class=\"remark\"");
  }
  return out;
}

std::string legend(const Panel& panel, double left, double y) {
  std::string out;
  double x = left;
  for (const Quantity& q : panel.quantities) {
    const double width = 18.0 + io::text_width(q.name, io::kChartFont);
    if (x > left && x + width > left + kPanel) x = left, y += 18.0;
    out += marker(q, x + 6.0, y - 4.0, q.name) + io::svg_text(x + 16.0, y, q.name, "start");
    x += width + 14.0;
  }
  return out;
}

}  // namespace

std::string bench_svg(const BenchReport& report) {
  std::vector<std::string> names;
  for (const BenchRow& row : report.rows)
    if (row.body == Body::wheel) names.push_back(label(row));
  const double height = kLine * static_cast<double>(std::max<std::size_t>(1, names.size()));
  const double width = kNames + static_cast<double>(panels().size()) * (kPanel + kGap);
  const double end = kTop + height + kBelow + kLegend + 18.0;
  std::string out = io::svg_head(width, end, io::kChartFont, io::kChartStyle);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double y = kTop + kLine * static_cast<double>(i);
    if (i % 2 == 1)
      out += fmt::format("<rect x=\"0\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#f5f5f5\"/>\n", y,
                         width - kGap, kLine);
    out += io::svg_text(kNames - 10.0, y + 0.5 * kLine + 4.0, names[i], "end");
  }
  double left = kNames;
  for (const Panel& panel : panels()) {
    out += draw(panel, report.rows, left, height);
    out += legend(panel, left, kTop + height + kBelow + 8.0);
    left += kPanel + kGap;
  }
  out += io::svg_text(10.0, end - 10.0, fmt::format("{}, {}, {}", report.machine, report.compiler, report.date),
                      "start", " class=\"remark\"");
  return out + "</svg>\n";
}

}  // namespace treadmark::app
