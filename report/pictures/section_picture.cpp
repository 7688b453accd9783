// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/section_picture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/constants.hpp"

namespace treadmark::pictures {

std::string section_svg(SectionPicture picture) {
  constexpr double kAround = 4.0;  // what is shown beyond the curves [mm]
  Chart chart;
  chart.x_label = "y [mm], to the right";
  chart.y_label = "height, -z [mm]";
  AxisRange y{kInfinity, -kInfinity}, z = y;
  const auto add = [&](const char* name, Curve curve, int style) {
    if (curve.empty()) return;
    ChartSeries series{name, style};
    series.width = 2.0;
    series.curve = std::move(curve);
    for (const auto& [y_here, z_here] : series.curve)
      if (std::isfinite(y_here) && std::isfinite(z_here)) {
        y = {std::min(y[0], y_here), std::max(y[1], y_here)};
        z = {std::min(z[0], z_here), std::max(z[1], z_here)};
      }
    chart.series.push_back(std::move(series));
  };
  add("rail", std::move(picture.rail), 0);
  add("wheel", std::move(picture.wheel), 1);
  if (!picture.marks_name.empty()) {
    ChartSeries marks{picture.marks_name, kBlack, false};
    marks.points = std::move(picture.marks);
    chart.series.push_back(std::move(marks));
  }
  if (!(y[0] < y[1])) y = z = {-1.0, 1.0};
  chart.x_range = {y[0] - kAround, y[1] + kAround};
  chart.y_range = {z[0] - kAround, z[1] + kAround};
  ChartSheet sheet;
  sheet.title = std::move(picture.title);
  sheet.legend = ChartSheet::Legend::each;
  sheet.height = std::clamp(sheet.width * (z[1] - z[0] + 2.0 * kAround) / (y[1] - y[0] + 2.0 * kAround), 80.0, 900.0);
  sheet.charts = {std::move(chart)};
  return draw_sheet(sheet);
}

}  // namespace treadmark::pictures
