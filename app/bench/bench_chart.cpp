// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/report/pictures/chart.hpp"

namespace treadmark::app {
namespace {

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

/// A row for each representation, from the least to the largest of its quantities.
pictures::Chart chart_of(const Panel& panel, const std::vector<BenchRow>& rows) {
  pictures::Chart chart;
  chart.title = panel.title;
  chart.x_label = fmt::format("[{}]", panel.unit);
  chart.x_scale = pictures::AxisScale::log;
  chart.y_numbers = &panel == &panels().front();
  chart.series.resize(1 + panel.quantities.size());
  chart.series[0].colour = "#999999";
  for (std::size_t k = 0; k < panel.quantities.size(); ++k) {
    chart.series[k + 1].name = panel.quantities[k].name;
    chart.series[k + 1].style = panel.quantities[k].style;
    chart.series[k + 1].joined = false;
  }
  for (const BenchRow& row : rows) {
    if (row.body != panel.body) continue;
    const std::string name =
        row.resolution > 0.0 ? fmt::format("{} {:g} mm", row.backend, 1e3 * row.resolution) : row.backend;
    const double y = static_cast<double>(chart.y_names.size());
    chart.y_names.push_back(name);
    chart.y_notes.push_back(row.agrees ? "" : "does not agree");
    for (std::size_t k = 0; k < panel.quantities.size(); ++k) {
      const Quantity& q = panel.quantities[k];
      const double value = panel.scale * row.*q.value;
      if (!(value > 0.0)) continue;
      chart.series[k + 1].points.push_back(
          {value, y, 5.0, {}, fmt::format("{}, {}: {:.3g} {}", name, q.name, value, panel.unit)});
      chart.series[0].curve.push_back({value, y});
    }
    chart.series[0].curve.push_back({NAN, NAN});
  }
  std::erase_if(chart.series, [](const auto& series) { return !series.name.empty() && series.points.empty(); });
  return chart;
}

}  // namespace

std::string bench_svg(const BenchReport& report) {
  pictures::ChartSheet sheet;
  for (const Panel& panel : panels()) sheet.charts.push_back(chart_of(panel, report.rows));
  sheet.columns = panels().size();
  sheet.left = 170.0, sheet.top = 34.0, sheet.right = 26.0, sheet.bottom = 114.0, sheet.gap_x = 26.0;
  sheet.width = 290.0;
  sheet.height = 23.0 * static_cast<double>(std::max<std::size_t>(1, sheet.charts.front().y_names.size()));
  sheet.legend = pictures::ChartSheet::Legend::below;
  sheet.remarks = {fmt::format("{}, {}, {}", report.machine, report.compiler, report.date)};
  return pictures::draw_sheet(sheet);
}

}  // namespace treadmark::app
