// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace treadmark::io {

/// Rows of colours. Their order survives for colour-blind readers: lightness grows or falls evenly.
enum class Palette {
  sequential,  ///< as colour(): dark violet to yellow
  diverging,   ///< dark blue, white in the middle, orange to dark brown
  from_white,  ///< the upper half of the diverging one, for what is rare
};

/// What the colours of a map mean. Values beyond the ends have the colours of the ends.
struct MapColours {
  double low = 0.0, high = 1.0;  ///< [shown unit]
  Palette palette = Palette::sequential;
  bool below = false, above = false;  ///< values lie beyond the ends
  std::string unit;                   ///< the shown one
  double factor = 1.0;                ///< from SI to the shown unit
};

/// Colour at 0 (low) .. 1 (high): red, green, blue, opaque.
std::array<std::uint8_t, 4> map_colour(double part, Palette palette);

/// Smallest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not below a value > 0; 1 for others.
double round_limit(double value);

/// Steps of colour in a map; step 0 .. kMapColours - 1 of a value in the shown unit.
inline constexpr std::size_t kMapColours = 64;
std::size_t map_step(double value, const MapColours& colours);

}  // namespace treadmark::io
