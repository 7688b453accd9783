// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/colour_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace treadmark::io {

std::string colour(double value) {
  if (std::isnan(value)) return "#999999";
  struct Anchor {
    double red, green, blue;
  };
  static constexpr std::array<Anchor, 7> kAnchors{
      {{46, 14, 82}, {62, 54, 128}, {50, 96, 144}, {32, 136, 142}, {58, 174, 116}, {146, 208, 76}, {250, 230, 52}}};
  const double position = std::clamp(value, 0.0, 1.0) * (kAnchors.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(position), kAnchors.size() - 2);
  const double part = position - static_cast<double>(lower);
  const Anchor &a = kAnchors[lower], &b = kAnchors[lower + 1];
  const auto mix = [part](double from, double to) { return static_cast<int>(std::lround(from + part * (to - from))); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue));
}

}  // namespace treadmark::io
