// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/io/files/base64.hpp"
#include "treadmark/io/imports/import_map.hpp"
#include "treadmark/io/results/svg_text.hpp"

namespace treadmark::io {
namespace {

constexpr std::size_t kMostColumns = 1600, kMostRows = 300;  // pixels of an image
constexpr std::size_t kMostBytes = 150000;                   // of an image; two of them stay below 500 kB as base64
constexpr double kUsualHeight = 150.0, kMostHeight = 260.0;  // of a map [px]
constexpr double kLeastWidth = 240.0;
constexpr double kBarWidth = 14.0;

/// Round factors for the stretching of s.
double round_stretch(double wanted) {
  double best = 1.0;
  for (const double factor :
       {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 15.0, 20.0, 30.0, 50.0, 100.0, 200.0, 500.0})
    if (factor <= wanted * 1.001) best = factor;
  return best;
}

std::string image_element(const PaletteImage& image, const ChartBox& box) {
  return fmt::format(
      "<image x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" preserveAspectRatio=\"none\" "
      "style=\"image-rendering:pixelated\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "xlink:href=\"data:image/png;base64,{}\"/>\n",
      box.x, box.y, box.width, box.height, to_base64(to_png(image)));
}

/// The finest image that is not too large: noise cannot be compressed.
PaletteImage small_image(const BandMap& map, const MapColours& colours, PixelRule rule) {
  double part = 1.0;
  for (;; part *= 0.8) {
    const auto limit = [part](std::size_t most) { return static_cast<std::size_t>(part * static_cast<double>(most)); };
    PaletteImage image = map_image(map, colours, rule, limit(kMostColumns), limit(kMostRows));
    if (part < 0.2 || to_png(image).size() <= kMostBytes) return image;
  }
}

std::string colour_bar(const MapColours& colours, const ChartBox& box) {
  PaletteImage image;
  image.width = 1;
  image.height = kMapColours;
  for (std::size_t step = 0; step < kMapColours; ++step) {
    image.palette.push_back(map_colour((static_cast<double>(step) + 0.5) / kMapColours, colours.palette));
    image.index.push_back(static_cast<std::uint8_t>(kMapColours - 1 - step));
  }
  const PlotFrame bar(box, {0.0, 1.0}, {colours.low, colours.high});
  std::string out = image_element(image, box) + bar.border();
  const double right = box.x + box.width;
  const int parts = box.height < 60.0 ? 2 : 4;
  for (int i = 0; i <= parts; ++i) {
    const double value = colours.low + (colours.high - colours.low) * i / parts;
    const char* sign = i == 0 && colours.below ? "\u2264 " : i == parts && colours.above ? "\u2265 " : "";
    out += fmt::format("<path class=\"tick\" d=\"M{:.1f} {:.1f}h4\"/>\n", right, bar.py(value));
    out += svg_text(right + 7.0, bar.py(value) + 4.0, fmt::format("{}{:.4g}", sign, value + 0.0), "start",
                    " class=\"number\"");
  }
  return out + svg_text(right + 7.0, box.y - 9.0, colours.unit, "start", " class=\"number\"");
}

/// Degrees of a wheel above the frame.
std::string degrees(const PlotFrame& frame, double radius_mm) {
  if (!(radius_mm > 0.0)) return {};
  const double per_mm = 180.0 / std::numbers::pi / radius_mm;
  const PlotRange range{frame.x().low * per_mm, frame.x().high * per_mm};
  if (!range.usable()) return {};
  const double most = std::max(2.0, frame.box().width / 60.0);
  double step = 0.0;
  for (const double trial : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0, 360.0})
    if (step == 0.0 && range.length() / trial <= most) step = trial;
  if (step == 0.0) return {};
  std::string out;
  for (double i = std::ceil(range.low / step - 1e-6); i * step <= range.high + 1e-6 * step; ++i) {
    const double x = frame.px(i * step / per_mm);
    out += fmt::format("<path class=\"tick\" d=\"M{:.1f} {:.1f}v-4\"/>\n", x, frame.box().y);
    out += svg_text(x, frame.box().y - 7.0, fmt::format("{:.4g}\u00b0", i * step + 0.0), "middle", " class=\"number\"");
  }
  return out;
}

}  // namespace

MapPanel place_map(const ImportReport& report, const BandMap& map, double y) {
  const double top = y + (report.body == Body::wheel ? 32.0 : 12.0);
  if (!is_drawable(map)) {
    const ChartBox box{kPlotLeft, y + 12.0, kPlotWidth, 60.0};
    return {PlotFrame(box, {}, {}), 1.0, y + 90.0};
  }
  const PlotRange a{map.a_min * 1e3, map.a_max * 1e3}, s{map.s_min * 1e3, map.s_max * 1e3};
  double scale = kPlotWidth / a.length();  // px/mm along a
  double stretch = 1.0;
  if (scale * s.length() > kMostHeight) {
    scale = kMostHeight / s.length();
    if (a.length() * scale < kLeastWidth) {
      const double wider = round_stretch(kLeastWidth / (a.length() * scale));
      scale *= wider;
      stretch = 1.0 / wider;
    }
  } else {
    stretch = round_stretch(kUsualHeight / (scale * s.length()));
  }
  const double width = std::min(kPlotWidth, a.length() * scale);
  const double height = std::clamp(s.length() * scale * stretch, 20.0, kMostHeight);
  return {PlotFrame({kPlotLeft, top, width, height}, a, s), stretch, top + height + 44.0};
}

std::string draw_map(const ImportReport& report, const BandMap& map, const MapColours& colours, const MapPanel& panel,
                     const std::string& title, PixelRule rule) {
  const PlotFrame& frame = panel.frame;
  const ChartBox& box = frame.box();
  const bool wheel = report.body == Body::wheel;
  if (!is_drawable(map))
    return svg_text(box.x, box.y - 12.0, title, "start", " class=\"title\"") + frame.border() +
           svg_text(box.x + 0.5 * box.width, box.y + 0.5 * box.height + 4.0, "no values");
  std::string out = svg_text(box.x, box.y - (wheel ? 26.0 : 10.0), title, "start", " class=\"title\"");
  out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"url(#holes)\"/>\n",
                     box.x, box.y, box.width, box.height);
  out += image_element(small_image(map, colours, rule), box);
  std::string along = wheel ? "along the circumference [mm]" : "x along the track [mm]";
  if (panel.stretch > 1.0) along += fmt::format("; s is drawn {:g} times as long as a", panel.stretch);
  if (panel.stretch < 1.0) along += fmt::format("; a is drawn {:g} times as long as s", 1.0 / panel.stretch);
  out += frame.axes(along, "s [mm]", false);
  if (wheel) out += degrees(frame, report.nominal_radius * 1e3);
  out += frame.border();
  return out + colour_bar(colours, {box.x + box.width + 16.0, box.y, kBarWidth, box.height});
}

}  // namespace treadmark::io
