// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/report/pictures/colours.hpp"

namespace treadmark::pictures {

/// Maps as pictures of pixels. All functions are thread-safe.

/// A picture whose pixels name colours of a palette, row after row from the top.
struct PaletteImage {
  std::size_t width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 4>> palette;  ///< red, green, blue, opacity; at most 256
  std::vector<std::uint8_t> index;                   ///< width * height, each below the size of the palette
};

/// The bytes of a PNG file (ISO/IEC 15948). The same image gives the same bytes.
/// Errors: Error(numerical) for an image without pixels or colours, or one whose sizes do not match.
std::vector<std::byte> to_png(const PaletteImage& image);

/// The picture stretched over a box.
std::string image_element(const PaletteImage& image, const Box& box);

/// Grey stripes as a pattern "holes" for what is not there.
std::string hole_pattern();

/// Values of the cells of a rectangle: of nx to the right and ny upwards, by strides in the array; NaN = not known.
struct Raster {
  std::span<const float> values;
  std::size_t nx = 0, ny = 0, stride_x = 1, stride_y = 1;

  float at(std::size_t ix, std::size_t iy) const { return values[ix * stride_x + iy * stride_y]; }
};

/// How much of a pixel must be known for it to have a colour.
enum class PixelRule {
  any,   ///< some: maps of points
  half,  ///< half of it: maps of the surface
};

/// Steps of colour in a map; the index of a colour is its step, the last colour is the transparent one.
inline constexpr std::size_t kImageSteps = 64;

/// Picture of a map, averaged where the map is finer than the picture; what is not known is transparent.
PaletteImage map_image(const Raster& map, const ColourScale& colours, PixelRule rule, std::size_t most_columns,
                       std::size_t most_rows);

/// The finest such picture that is not too large for an SVG file: noise cannot be compressed.
PaletteImage small_image(const Raster& map, const ColourScale& colours, PixelRule rule);

}  // namespace treadmark::pictures
