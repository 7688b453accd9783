// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "treadmark/report/pictures/svg_text.hpp"

namespace treadmark::pictures {

/// Colours of values. All functions are thread-safe.

/// Rows of colours. Their order survives in grey print and for colour-blind readers: lightness grows or falls evenly.
enum class Palette {
  sequential,  ///< dark violet over blue and green to yellow
  diverging,   ///< dark blue, white in the middle, orange to dark brown
  from_white,  ///< the upper half of the diverging one, for what is rare
};

/// Colour at 0 (low) .. 1 (high): red, green, blue, opaque. Values outside are clamped, NaN is the middle.
std::array<std::uint8_t, 4> map_colour(double part, Palette palette);

/// The same as "#rrggbb"; NaN is grey.
std::string colour(double part, Palette palette = Palette::sequential);

/// What the colours of a quantity mean. Values beyond the ends have the colours of the ends.
struct ColourScale {
  double low = 0.0, high = 1.0;  ///< [shown unit]
  Palette palette = Palette::sequential;
  bool below = false, above = false;  ///< values lie beyond the ends
  std::string unit = {};              ///< the shown one
  double factor = 1.0;                ///< from the values to the shown unit

  /// Step of colour of a value in the shown unit: 0 .. steps - 1.
  std::size_t step(double value, std::size_t steps) const;
};

/// Widens a range that is none; with diverging colours it becomes symmetric about 0.
ColourScale colour_scale(double low, double high, bool diverging);

/// Colour of one of many steps: that of its middle.
std::string step_colour(std::size_t step, std::size_t steps, Palette palette = Palette::sequential);

/// Steps of colour in panels of contact patches.
inline constexpr std::size_t kPatchSteps = 20;

/// The colours as an upright bar with words above it and numbers to its right: round ones where the scale begins at
/// zero, else in equal parts, of which there are `parts`.
std::string draw_colour_bar(const ColourScale& scale, const Box& box, std::size_t steps, int parts);
inline constexpr double kBarWidth = 14.0;  // [px]

/// Colours of the series of a chart: those of Okabe and Ito (2008), which colour-blind readers tell apart, without
/// yellow, too light for paper.
std::string_view chart_colour(int style);
inline constexpr int kBlack = 4;  ///< the style for levels and references

}  // namespace treadmark::pictures
