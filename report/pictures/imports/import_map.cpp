// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/report/pictures/imports/import_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/imports/import_words.hpp"

namespace treadmark::pictures {

namespace {

constexpr double kLargestEnd = 1e9;  // of an axis
constexpr double kFewTimes = 3.0;    // greatest value over the one that a thousandth is beyond
constexpr double kFew = 1e-3;
constexpr std::size_t kMostCells = std::size_t{1} << 32;
constexpr double kUsualHeight = 150.0, kMostHeight = 260.0;  // of a map [px]
constexpr double kLeastWidth = 240.0;

/// Round factors for the stretching of s.
double round_stretch(double wanted) {
  double best = 1.0;
  for (const double factor :
       {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 15.0, 20.0, 30.0, 50.0, 100.0, 200.0, 500.0})
    if (factor <= wanted * 1.001) best = factor;
  return best;
}

/// Degrees of a wheel on an axis in millimetres.
std::vector<AxisTick> degree_ticks(const AxisRange& range_mm, double radius_mm, double width) {
  const double per_mm = 180.0 / std::numbers::pi / radius_mm, length = (range_mm[1] - range_mm[0]) * per_mm;
  if (!(radius_mm > 0.0) || !is_usable({range_mm[0] * per_mm, range_mm[1] * per_mm})) return {};
  const double most = std::max(2.0, width / 60.0);
  std::vector<AxisTick> out;
  for (const double step : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0, 360.0}) {
    if (length / step > most) continue;
    const double low = range_mm[0] * per_mm;
    for (double i = std::ceil(low / step - 1e-6); i * step <= low + length + 1e-6 * step; ++i)
      out.push_back({(i * step - low) / length, fmt::format("{:.4g}\u00b0", i * step + 0.0)});
    break;
  }
  return out;
}

}  // namespace

bool is_usable(const AxisRange& range) {
  const auto [low, high] = range;
  return std::abs(low) < kLargestEnd && std::abs(high) < kLargestEnd &&
         high - low > 1e-9 * std::max({std::abs(low), std::abs(high), 1e-12});
}

bool is_drawable(const io::BandMap& map) {
  return map.rows > 0 && map.columns > 0 && map.rows < kMostCells && map.columns < kMostCells &&
         map.value.size() == map.rows * map.columns && is_usable({map.a_min, map.a_max}) &&
         is_usable({map.s_min, map.s_max});
}

std::optional<MapExtent> map_extent(const io::BandMap& map, double outside) {
  std::vector<float> known;
  if (is_drawable(map))
    std::copy_if(map.value.begin(), map.value.end(), std::back_inserter(known),
                 [](float v) { return std::isfinite(v); });
  if (known.empty()) return {};
  const auto [least, greatest] = std::minmax_element(known.begin(), known.end());
  MapExtent out{*least, *greatest, 0.0, 0.0};
  const auto rank = to_whole<std::size_t>(outside * static_cast<double>(known.size() - 1));
  const auto low = known.begin() + static_cast<std::ptrdiff_t>(rank),
             high = known.end() - 1 - static_cast<std::ptrdiff_t>(rank);
  std::nth_element(known.begin(), low, known.end());
  out.low = *low;
  std::nth_element(known.begin(), high, known.end());
  out.high = *high;
  return out;
}

ColourScale diverging_colours(const io::BandMap& map) {
  ColourScale out;
  out.palette = Palette::diverging;
  const auto extent = map_extent(map, kFew);
  if (!extent) return out.low = -1.0, out.unit = "mm", out.factor = 1e3, out;
  const double greatest = std::max(-extent->least, extent->greatest);
  const double usual = std::max(-extent->low, extent->high);
  const double limit = greatest > kFewTimes * usual && usual > 0.0 ? usual : greatest;
  const io::PictureUnit unit = io::picture_unit(limit);
  out.unit = unit.name;
  out.factor = unit.factor;
  out.high = round_limit(limit * unit.factor);
  out.low = -out.high;
  out.below = extent->least * unit.factor < out.low;
  out.above = extent->greatest * unit.factor > out.high;
  return out;
}

ColourScale sequential_colours(const io::BandMap& map, const std::string& unit, double factor, Palette palette) {
  ColourScale out;
  out.palette = palette;
  out.unit = unit;
  out.factor = factor;
  if (const auto extent = map_extent(map, kFew)) {
    const bool few = extent->greatest > kFewTimes * extent->high && extent->high > 0.0;
    out.high = round_limit(factor * (few ? extent->high : extent->greatest));
    out.above = factor * extent->greatest > out.high;
  }
  return out;
}

double round_limit(double value) {
  if (!(value > 1e-30 && value < 1e30)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (factor * power >= value * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

Raster raster_of(const io::BandMap& map) { return {map.value, map.rows, map.columns, map.columns, 1}; }

ImportPanel map_panel(const io::ImportReport& report, const io::BandMap& map, const ColourScale& colours,
                      const std::string& title, PixelRule rule) {
  ImportPanel out{title, {}, kPlotWidth, 60.0};
  if (!is_drawable(map)) return out;
  const bool wheel = report.body == Body::wheel;
  const AxisRange a{map.a_min * 1e3, map.a_max * 1e3}, s{map.s_min * 1e3, map.s_max * 1e3};
  const double a_length = a[1] - a[0], s_length = s[1] - s[0];
  double scale = kPlotWidth / a_length, stretch = 1.0;  // px/mm along a, that of s over it
  if (scale * s_length > kMostHeight) {
    scale = kMostHeight / s_length;
    if (a_length * scale < kLeastWidth) {
      const double wider = round_stretch(kLeastWidth / (a_length * scale));
      scale *= wider;
      stretch = 1.0 / wider;
    }
  } else {
    stretch = round_stretch(kUsualHeight / (scale * s_length));
  }
  out.width = std::min(kPlotWidth, a_length * scale);
  out.height = std::clamp(s_length * scale * stretch, 20.0, kMostHeight);
  out.chart.x_label = wheel ? "along the circumference [mm]" : "x along the track [mm]";
  if (stretch > 1.0) out.chart.x_label += fmt::format("; s is drawn {:g} times as long as a", stretch);
  if (stretch < 1.0) out.chart.x_label += fmt::format("; a is drawn {:g} times as long as s", 1.0 / stretch);
  out.chart.y_label = "s [mm]";
  out.chart.x_range = a, out.chart.y_range = s;
  if (wheel) out.chart.top = degree_ticks(a, report.nominal_radius * 1e3, out.width);
  out.chart.image = ChartImage{small_image(raster_of(map), colours, rule), colours, colours.unit};
  return out;
}

}  // namespace treadmark::pictures
