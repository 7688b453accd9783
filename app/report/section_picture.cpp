// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/report/section_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/pictures/chart_draw.hpp"
#include "treadmark/pictures/picture_patch.hpp"
#include "treadmark/pictures/svg_text.hpp"

namespace treadmark::app::report {

namespace {

constexpr double kLeft = 70.0, kTop = 44.0, kWidth = 640.0, kBottom = 50.0;  // [px]
constexpr double kSectionMargin = 0.004;                                     // around what is shown [m]

using Line = std::vector<std::array<double, 2>>;

/// Where the lines along the body, from station to station, pass x of the track: (y, -z) [mm]. NaN where they do not.
Line cut(const io::SampledSurface& surface, const Pose& X_TB, double x) {
  Line out;
  for (int iv = 0; iv < surface.nv; ++iv) {
    std::array<double, 2> best{NAN, NAN};
    double lowest = -INFINITY;
    for (int iu = 0; iu + 1 < surface.nu + (surface.closed ? 1 : 0); ++iu) {
      const auto point = [&](int station) {
        const std::size_t k = surface.index(station % surface.nu, iv);
        return X_TB.apply({surface.x[k], surface.y[k], surface.z[k]});
      };
      const Vec3 a = point(iu), b = point(iu + 1);
      if (!((a.x() - x) * (b.x() - x) <= 0.0) || a.x() == b.x()) continue;
      const Vec3 p = a + (x - a.x()) / (b.x() - a.x()) * (b - a);
      if (p.z() <= lowest) continue;  // the lower one of a wheel's two
      lowest = p.z();
      best = {kMilli * p.y(), -kMilli * p.z()};
    }
    out.push_back(best);
  }
  return out;
}

const io::SampledSurface* find(const std::vector<io::SampledSurface>& surfaces, const std::string& name) {
  const int index = io::surface_index(surfaces, name);
  return index < 0 ? nullptr : &surfaces[static_cast<std::size_t>(index)];
}

const io::CaseResult* most_loaded(const FrameSet& set, const io::PatchResult*& main) {
  const io::CaseResult* best = nullptr;
  for (const Frame& frame : set.frames)
    for (const io::PatchResult& patch : frame.result->patches)
      if (patch.has_reference && (main == nullptr || patch.fn > main->fn)) {
        main = &patch;
        best = frame.result.get();
      }
  return best;
}

}  // namespace

std::string section_svg(const FrameSet& set, const std::vector<io::SampledSurface>& surfaces) {
  const io::PatchResult* main = nullptr;
  const io::CaseResult* result = most_loaded(set, main);
  if (result == nullptr || !result->bodies)
    return io::svg_head(kLeft + kWidth, 60.0, io::kChartFont, io::kChartStyle) +
           io::svg_text(12.0, 34.0, "These results hold no surfaces of wheel and rail.", "start") + "</svg>\n";
  io::Chart chart;
  chart.x_label = "y [mm], to the right";
  chart.y_label = "height, -z [mm]";
  double y_low = INFINITY, y_high = -INFINITY, z_low = INFINITY, z_high = -INFINITY;
  const auto add = [&](const char* name, const std::string& surface, const Pose& X, int style, bool bounds) {
    const io::SampledSurface* sampled = find(surfaces, surface);
    if (sampled == nullptr) return;
    io::ChartSeries series;
    series.name = name;
    series.style = style;
    series.width = 2.0;
    series.curve = cut(*sampled, X, main->x_tr);
    for (const auto& [y, z] : series.curve)
      if (bounds && std::isfinite(y)) {
        y_low = std::min(y_low, y), y_high = std::max(y_high, y);
        z_low = std::min(z_low, z), z_high = std::max(z_high, z);
      }
    chart.series.push_back(std::move(series));
  };
  add("rail", result->rail_surface, result->bodies->X_TS, 0, true);
  add("wheel", result->wheel_surface, result->bodies->X_TA, 1, true);
  io::ChartSeries references;
  references.name = "contact reference";
  references.style = 4;
  references.joined = false;
  for (const io::PatchResult& patch : result->patches)
    if (patch.has_reference)
      references.points.push_back(
          {kMilli * patch.y_tr, -kMilli * patch.z_tr, 4.5, fmt::format("{:.1f} kN", 1e-3 * patch.fn), ""});
  chart.series.push_back(std::move(references));
  if (!(y_low < y_high)) y_low = -1.0, y_high = 1.0, z_low = -1.0, z_high = 1.0;
  const double margin = kMilli * kSectionMargin;
  chart.x_range = {y_low - margin, y_high + margin};
  chart.y_range = {z_low - margin, z_high + margin};
  const double height =
      std::clamp(kWidth * (z_high - z_low + 2.0 * margin) / (y_high - y_low + 2.0 * margin), 80.0, 900.0);
  std::string out = io::svg_head(kLeft + kWidth + 180.0, kTop + height + kBottom, io::kChartFont, io::kChartStyle);
  out += io::svg_text(kLeft + 0.5 * kWidth, 22.0,
                      fmt::format("Wheel and rail at x = {:.1f} mm, case {}", kMilli * main->x_tr, result->number),
                      "middle", " class=\"title\"");
  out += io::draw_chart(chart, {kLeft, kTop, kWidth, height});
  out += io::draw_chart_legend(chart.series, kLeft + kWidth + 24.0, kTop + 10.0);
  return out + "</svg>\n";
}

namespace {

constexpr double kMapLeft = 78.0, kMapTop = 44.0, kHeight = 260.0, kMapBottom = 50.0,
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
