// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/raster.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::pictures {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::size_t kLargestPng = 1u << 16;  // pixels along a side

void add_number(Bytes& out, std::size_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::byte>(value >> shift & 0xFFu));
}

/// Length, name, data, and the CRC of name and data.
void add_chunk(Bytes& out, const char (&name)[5], std::span<const std::byte> data) {
  add_number(out, data.size());
  const std::size_t start = out.size();
  for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::byte>(name[i]));
  out.insert(out.end(), data.begin(), data.end());
  const auto* checked = reinterpret_cast<const Bytef*>(out.data() + start);
  add_number(out, ::crc32(::crc32(0L, Z_NULL, 0), checked, static_cast<uInt>(out.size() - start)));
}

Bytes deflated(const Bytes& raw) {
  uLongf length = ::compressBound(static_cast<uLong>(raw.size()));
  Bytes out(length);
  const int status = ::compress2(reinterpret_cast<Bytef*>(out.data()), &length,
                                 reinterpret_cast<const Bytef*>(raw.data()), static_cast<uLong>(raw.size()), 9);
  if (status != Z_OK) throw Error(ErrorKind::numerical, "a picture could not be compressed");
  out.resize(length);
  return out;
}

}  // namespace

std::vector<std::byte> to_png(const PaletteImage& image) {
  const bool whole = image.width > 0 && image.height > 0 && image.width <= kLargestPng && image.height <= kLargestPng &&
                     image.index.size() == image.width * image.height && !image.palette.empty() &&
                     image.palette.size() <= 256 &&
                     *std::max_element(image.index.begin(), image.index.end()) < image.palette.size();
  if (!whole) throw Error(ErrorKind::numerical, "a picture whose pixels and colours do not match its size");

  Bytes out;
  for (const int c : {0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A}) out.push_back(static_cast<std::byte>(c));
  Bytes header;
  add_number(header, image.width);
  add_number(header, image.height);
  for (const int c : {8, 3, 0, 0, 0}) header.push_back(static_cast<std::byte>(c));  // 8 bits, palette, not interlaced
  add_chunk(out, "IHDR", header);

  Bytes colours, opacity;
  for (const auto& colour : image.palette) {
    for (int i = 0; i < 3; ++i) colours.push_back(static_cast<std::byte>(colour[static_cast<std::size_t>(i)]));
    opacity.push_back(static_cast<std::byte>(colour[3]));
  }
  add_chunk(out, "PLTE", colours);
  add_chunk(out, "tRNS", opacity);

  Bytes raw;
  raw.reserve((image.width + 1) * image.height);
  for (std::size_t row = 0; row < image.height; ++row) {
    raw.push_back(std::byte{0});  // rows are not filtered
    for (std::size_t i = 0; i < image.width; ++i)
      raw.push_back(static_cast<std::byte>(image.index[row * image.width + i]));
  }
  add_chunk(out, "IDAT", deflated(raw));
  add_chunk(out, "IEND", {});
  return out;
}

std::string image_element(const PaletteImage& image, const Box& box) {
  return fmt::format(
      "<image x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" preserveAspectRatio=\"none\" "
      "style=\"image-rendering:pixelated\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "xlink:href=\"data:image/png;base64,{}\"/>\n",
      box.x, box.y, box.width, box.height, io::to_base64(to_png(image)));
}

std::string hole_pattern() {
  return "<pattern id=\"holes\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\">"
         "<rect width=\"6\" height=\"6\" fill=\"#cfcfcf\"/>"
         "<path d=\"M-1 1l2 -2M0 6l6 -6M5 7l2 -2\" stroke=\"#8c8c8c\" stroke-width=\"1\"/></pattern>\n";
}

namespace {

constexpr std::size_t kMostPixelColumns = 1600, kMostPixelRows = 300;  // pixels of an image
constexpr std::size_t kMostBytes = 150000;  // of an image; two of them stay below 500 kB as base64

/// Share of every cell of a line of `cells` in pixel `pixel` of `pixels`: first and last cell, by whole cells.
struct CellRange {
  std::size_t first = 0, last = 0;
};

CellRange cells_of(std::size_t pixel, std::size_t pixels, std::size_t cells) {
  const std::size_t first = pixel * cells / pixels;
  return {first, std::max(first + 1, (pixel + 1) * cells / pixels)};
}

}  // namespace

PaletteImage map_image(const Raster& map, const ColourScale& colours, PixelRule rule, std::size_t most_columns,
                       std::size_t most_rows) {
  PaletteImage image;
  image.width = std::clamp<std::size_t>(map.nx, 1, most_columns);
  image.height = std::clamp<std::size_t>(map.ny, 1, most_rows);
  for (std::size_t step = 0; step < kImageSteps; ++step)
    image.palette.push_back(map_colour((static_cast<double>(step) + 0.5) / kImageSteps, colours.palette));
  image.palette.push_back({153, 153, 153, 0});
  image.index.assign(image.width * image.height, static_cast<std::uint8_t>(kImageSteps));
  if (map.nx == 0 || map.ny == 0 || map.values.size() < map.nx * map.ny) return image;
  for (std::size_t j = 0; j < image.height; ++j) {
    const CellRange across = cells_of(image.height - 1 - j, image.height, map.ny);
    for (std::size_t i = 0; i < image.width; ++i) {
      const CellRange along = cells_of(i, image.width, map.nx);
      double sum = 0.0;
      std::size_t known = 0, all = 0;
      for (std::size_t row = along.first; row < along.last; ++row)
        for (std::size_t column = across.first; column < across.last; ++column, ++all)
          if (const float v = map.at(row, column); std::isfinite(v)) {
            sum += v;
            ++known;
          }
      if (known == 0 || (rule == PixelRule::half && 2 * known < all)) continue;
      const double mean = sum / static_cast<double>(known);
      image.index[j * image.width + i] = static_cast<std::uint8_t>(colours.step(mean * colours.factor, kImageSteps));
    }
  }
  return image;
}

PaletteImage small_image(const Raster& map, const ColourScale& colours, PixelRule rule) {
  double part = 1.0;
  for (;; part *= 0.8) {
    const auto limit = [part](std::size_t most) { return to_whole<std::size_t>(part * static_cast<double>(most)); };
    PaletteImage image = map_image(map, colours, rule, limit(kMostPixelColumns), limit(kMostPixelRows));
    if (part < 0.2 || to_png(image).size() <= kMostBytes) return image;
  }
}

}  // namespace treadmark::pictures
