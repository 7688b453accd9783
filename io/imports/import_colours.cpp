// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/imports/import_colours.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "treadmark/io/results/colour_map.hpp"

namespace treadmark::io {
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
