// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/map_picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/io/results/chart_draw.hpp"
#include "treadmark/io/results/colour_map.hpp"
#include "treadmark/io/results/svg_text.hpp"

namespace treadmark::app::report {
namespace {

constexpr double kMapLeft = 78.0, kMapTop = 44.0, kWidth = 640.0, kHeight = 260.0, kMapBottom = 50.0,
                 kBar = 14.0;  // [px]
constexpr int kMostMapColumns = 240, kMostRows = 100, kMapSteps = 20;

struct MapRange {
  double low = 0.0, high = 1.0;
};

MapRange range_of(const MapView& map) {
  double low = INFINITY, high = -INFINITY;
  for (const double value : map.values)
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  if (!(low <= high)) return {};
  if (map.diverging) {
    const double end = std::max(std::fabs(low), std::fabs(high));
    low = -end, high = end;
  }
  return high > low ? MapRange{low, high} : MapRange{low - 0.5, low + 0.5};
}

/// Mean of the values in a block; NaN where there is none.
double mean(const MapView& map, int ix0, int ix1, int iy0, int iy1) {
  double sum = 0.0;
  int count = 0;
  for (int iy = iy0; iy < iy1; ++iy)
    for (int ix = ix0; ix < ix1; ++ix) {
      const double value =
          map.values[static_cast<std::size_t>(iy) * static_cast<std::size_t>(map.nx) + static_cast<std::size_t>(ix)];
      if (!std::isfinite(value)) continue;
      sum += value;
      ++count;
    }
  return count > 0 ? sum / count : NAN;
}

std::string cells(const MapView& map, const MapRange& range) {
  std::string out;
  const int columns = std::min(map.nx, kMostMapColumns), rows = std::min(map.ny, kMostRows);
  const double width = kWidth / columns, height = kHeight / rows;
  for (int row = 0; row < rows; ++row) {
    const int iy0 = row * map.ny / rows, iy1 = (row + 1) * map.ny / rows;
    int from = 0, last = -1;
    const auto flush = [&](int to) {
      if (last >= 0)
        out += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                           kMapLeft + from * width, kMapTop + kHeight - (row + 1) * height, (to - from) * width + 0.05,
                           height + 0.05, io::colour((last + 0.5) / kMapSteps));
      from = to;
    };
    for (int column = 0; column < columns; ++column) {
      const double value = mean(map, column * map.nx / columns, (column + 1) * map.nx / columns, iy0, iy1);
      const int step = std::isnan(value)
                           ? -1
                           : std::clamp(static_cast<int>(kMapSteps * (value - range.low) / (range.high - range.low)), 0,
                                        kMapSteps - 1);
      if (step == last) continue;
      flush(column);
      last = step;
    }
    flush(columns);
  }
  return out;
}

std::string bar(const MapView& map, const MapRange& range) {
  std::string out;
  const double x = kMapLeft + kWidth + 20.0, step = kHeight / kMapSteps;
  for (int k = 0; k < kMapSteps; ++k)
    out += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x,
                       kMapTop + kHeight - (k + 1) * step, kBar, step + 0.05, io::colour((k + 0.5) / kMapSteps));
  for (const double part : {0.0, 0.5, 1.0})
    out += io::svg_text(x + kBar + 6.0, kMapTop + kHeight * (1.0 - part) + 4.0,
                        io::three_digits(range.low + part * (range.high - range.low)), "start");
  return out + io::svg_text(x, kMapTop - 10.0, fmt::format("{} [{}]", map.label, map.unit), "middle");
}

}  // namespace

std::string map_svg(const MapView& map, const std::string& title) {
  std::string out =
      io::svg_head(kMapLeft + kWidth + 100.0, kMapTop + kHeight + kMapBottom, io::kChartFont, io::kChartStyle);
  out += io::svg_text(kMapLeft, 20.0, title, "start", " class=\"title\"");
  if (map.nx < 1 || map.ny < 1) return out + "</svg>\n";
  const MapRange range = range_of(map);
  out += cells(map, range) + bar(map, range);
  io::Chart frame;
  frame.x_label = fmt::format("{} [{}]", map.x.label, map.x.unit);
  frame.y_label = fmt::format("{} [{}]", map.y.label, map.y.unit);
  frame.x_range = {map.x0 - 0.5 * map.dx, map.x0 + (map.nx - 0.5) * map.dx};
  frame.y_range = {map.y0 - 0.5 * map.dy, map.y0 + (map.ny - 0.5) * map.dy};
  for (const MapView::Mark& mark : map.marks) {
    io::ChartSeries series;
    series.style = 4;  // black
    series.curve = mark.points;
    series.curve_label = mark.label;
    frame.series.push_back(std::move(series));
  }
  return out + io::draw_chart(frame, {kMapLeft, kMapTop, kWidth, kHeight}) + "</svg>\n";
}

}  // namespace treadmark::app::report
