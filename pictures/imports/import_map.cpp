// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/pictures/imports/import_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>

#include "treadmark/io/files/text.hpp"
#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/pictures/picture_patch.hpp"
#include "treadmark/pictures/svg_text.hpp"

namespace treadmark::io {

namespace {

constexpr double kFewTimes = 3.0;  // greatest value over the one that a thousandth is beyond
constexpr double kFew = 1e-3;
constexpr std::size_t kMostCells = std::size_t{1} << 32;

/// Share of every cell of a line of `cells` in pixel `pixel` of `pixels`: first and last cell, by whole cells.
struct CellRange {
  std::size_t first = 0, last = 0;
};

CellRange cells_of(std::size_t pixel, std::size_t pixels, std::size_t cells) {
  const std::size_t first = pixel * cells / pixels;
  return {first, std::max(first + 1, (pixel + 1) * cells / pixels)};
}

}  // namespace

bool is_drawable(const BandMap& map) {
  return map.rows > 0 && map.columns > 0 && map.rows < kMostCells && map.columns < kMostCells &&
         map.value.size() == map.rows * map.columns && PlotRange{map.a_min, map.a_max}.usable() &&
         PlotRange{map.s_min, map.s_max}.usable();
}

std::optional<MapExtent> map_extent(const BandMap& map, double outside) {
  std::vector<float> known;
  if (is_drawable(map))
    std::copy_if(map.value.begin(), map.value.end(), std::back_inserter(known),
                 [](float v) { return std::isfinite(v); });
  if (known.empty()) return {};
  const auto [least, greatest] = std::minmax_element(known.begin(), known.end());
  MapExtent out{*least, *greatest, 0.0, 0.0};
  const auto rank = static_cast<std::size_t>(outside * static_cast<double>(known.size() - 1));
  const auto low = known.begin() + static_cast<std::ptrdiff_t>(rank),
             high = known.end() - 1 - static_cast<std::ptrdiff_t>(rank);
  std::nth_element(known.begin(), low, known.end());
  out.low = *low;
  std::nth_element(known.begin(), high, known.end());
  out.high = *high;
  return out;
}

MapColours diverging_colours(const BandMap& map) {
  MapColours out;
  out.palette = Palette::diverging;
  const auto extent = map_extent(map, kFew);
  if (!extent) return out.low = -1.0, out.unit = "mm", out.factor = 1e3, out;
  const double greatest = std::max(-extent->least, extent->greatest);
  const double usual = std::max(-extent->low, extent->high);
  const double limit = greatest > kFewTimes * usual && usual > 0.0 ? usual : greatest;
  const LengthUnit unit = picture_unit(limit);
  out.unit = unit.name;
  out.factor = unit.factor;
  out.high = round_limit(limit * unit.factor);
  out.low = -out.high;
  out.below = extent->least * unit.factor < out.low;
  out.above = extent->greatest * unit.factor > out.high;
  return out;
}

MapColours sequential_colours(const BandMap& map, const std::string& unit, double factor, Palette palette) {
  MapColours out;
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

PaletteImage map_image(const BandMap& map, const MapColours& colours, PixelRule rule, std::size_t most_columns,
                       std::size_t most_rows) {
  PaletteImage image;
  image.width = std::clamp<std::size_t>(map.rows, 1, most_columns);
  image.height = std::clamp<std::size_t>(map.columns, 1, most_rows);
  for (std::size_t step = 0; step < kMapColours; ++step)
    image.palette.push_back(map_colour((static_cast<double>(step) + 0.5) / kMapColours, colours.palette));
  image.palette.push_back({153, 153, 153, 0});
  image.index.assign(image.width * image.height, static_cast<std::uint8_t>(kMapColours));
  if (!is_drawable(map)) return image;
  for (std::size_t j = 0; j < image.height; ++j) {
    const CellRange across = cells_of(image.height - 1 - j, image.height, map.columns);
    for (std::size_t i = 0; i < image.width; ++i) {
      const CellRange along = cells_of(i, image.width, map.rows);
      double sum = 0.0;
      std::size_t known = 0, all = 0;
      for (std::size_t row = along.first; row < along.last; ++row)
        for (std::size_t column = across.first; column < across.last; ++column, ++all)
          if (const float v = map.value[row * map.columns + column]; std::isfinite(v)) {
            sum += v;
            ++known;
          }
      if (known == 0 || (rule == PixelRule::half && 2 * known < all)) continue;
      image.index[j * image.width + i] =
          static_cast<std::uint8_t>(map_step(sum / static_cast<double>(known) * colours.factor, colours));
    }
  }
  return image;
}

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

namespace {

using Rgb = std::array<double, 3>;

/// Dark blue over white to dark brown.
constexpr std::array<Rgb, 9> kDiverging{{{16, 48, 106},
                                         {38, 98, 172},
                                         {96, 156, 206},
                                         {174, 208, 230},
                                         {250, 250, 250},
                                         {252, 212, 164},
                                         {240, 158, 80},
                                         {204, 96, 20},
                                         {112, 44, 4}}};

}  // namespace

std::array<std::uint8_t, 4> map_colour(double part, Palette palette) {
  const double clamped = std::isnan(part) ? 0.5 : std::clamp(part, 0.0, 1.0);
  std::array<std::uint8_t, 4> out{0, 0, 0, 255};
  if (palette == Palette::sequential) {
    const std::string text = colour(clamped);
    for (std::size_t i = 0; i < 3; ++i) std::from_chars(text.data() + 1 + 2 * i, text.data() + 3 + 2 * i, out[i], 16);
    return out;
  }
  const double position = (palette == Palette::from_white ? 0.5 + 0.5 * clamped : clamped) * (kDiverging.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(position), kDiverging.size() - 2);
  const double mix = position - static_cast<double>(lower);
  for (std::size_t i = 0; i < 3; ++i)
    out[i] = static_cast<std::uint8_t>(
        std::lround(kDiverging[lower][i] + mix * (kDiverging[lower + 1][i] - kDiverging[lower][i])));
  return out;
}

double round_limit(double value) {
  if (!(value > 1e-30 && value < 1e30)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (factor * power >= value * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

std::size_t map_step(double value, const MapColours& colours) {
  const double part = (value - colours.low) / (colours.high - colours.low);
  if (!(part > 0.0)) return 0;
  return std::min(static_cast<std::size_t>(std::min(part, 1.0) * kMapColours), kMapColours - 1);
}

}  // namespace treadmark::io
