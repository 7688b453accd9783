// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/imports/import_map.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "treadmark/io/imports/import_words.hpp"

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

}  // namespace treadmark::io
