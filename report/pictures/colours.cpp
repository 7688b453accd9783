// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/colours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/report/pictures/chart.hpp"

namespace treadmark::pictures {
namespace {

using Rgb = std::array<double, 3>;

constexpr std::array<Rgb, 7> kSequential{
    {{46, 14, 82}, {62, 54, 128}, {50, 96, 144}, {32, 136, 142}, {58, 174, 116}, {146, 208, 76}, {250, 230, 52}}};
constexpr std::array<Rgb, 9> kDiverging{{{16, 48, 106},
                                         {38, 98, 172},
                                         {96, 156, 206},
                                         {174, 208, 230},
                                         {250, 250, 250},
                                         {252, 212, 164},
                                         {240, 158, 80},
                                         {204, 96, 20},
                                         {112, 44, 4}}};
constexpr std::array<std::string_view, 7> kSeries{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                  "#000000", "#e69f00", "#56b4e9"};

}  // namespace

std::array<std::uint8_t, 4> map_colour(double part, Palette palette) {
  const std::span<const Rgb> anchors = palette == Palette::sequential ? std::span<const Rgb>(kSequential) : kDiverging;
  const double clamped = std::isnan(part) ? 0.5 : std::clamp(part, 0.0, 1.0);
  const double position =
      (palette == Palette::from_white ? 0.5 + 0.5 * clamped : clamped) * static_cast<double>(anchors.size() - 1);
  const auto lower = std::min(to_whole<std::size_t>(position), anchors.size() - 2);
  const double mix = position - static_cast<double>(lower);
  std::array<std::uint8_t, 4> out{0, 0, 0, 255};
  for (std::size_t i = 0; i < 3; ++i)
    out[i] = to_whole<std::uint8_t>(std::round(anchors[lower][i] + mix * (anchors[lower + 1][i] - anchors[lower][i])));
  return out;
}

std::string colour(double part, Palette palette) {
  if (std::isnan(part)) return "#999999";
  const auto rgb = map_colour(part, palette);
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

std::size_t ColourScale::step(double value, std::size_t steps) const {
  const double part = (value - low) / (high - low);
  if (!(part > 0.0)) return 0;
  return std::min(to_whole<std::size_t>(std::min(part, 1.0) * static_cast<double>(steps)), steps - 1);
}

ColourScale colour_scale(double low, double high, bool diverging) {
  if (diverging) high = std::max(std::abs(low), std::abs(high)), low = -high;
  if (!(high > low)) high = low + 1.0;
  return {low, high, diverging ? Palette::diverging : Palette::sequential};
}

std::string step_colour(std::size_t step, std::size_t steps, Palette palette) {
  return colour((static_cast<double>(step) + 0.5) / static_cast<double>(steps), palette);
}

std::string draw_colour_bar(const ColourScale& scale, const Box& box, std::size_t steps, int parts) {
  std::string out;
  const double height = box.height / static_cast<double>(steps);
  for (std::size_t step = 0; step < steps; ++step)
    out += fmt::format("<rect x=\"{}\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\" fill=\"{}\"/>\n", box.x,
                       box.bottom() - static_cast<double>(step + 1) * height, box.width, height + 0.2,
                       step_colour(step, steps, scale.palette));
  const double length = scale.high - scale.low, part = parts > 0 ? length / parts : tick_step(length);
  if (!(length > 0.0)) return out;
  for (int i = 0; parts > 0 ? i <= parts : i * part <= length; ++i) {
    const double value = scale.low + i * part, y = box.y + box.height * (1.0 - i * part / length);
    const char* sign = i == 0 && scale.below ? "\u2264 " : i == parts && scale.above ? "\u2265 " : "";
    out += fmt::format("<path class=\"tick\" d=\"M{} {:.1f}h4\"/>\n", box.right(), y);
    out += svg_text(box.right() + 7.0, y + 3.5, fmt::format("{}{:.4g}", sign, value + 0.0), "start");
  }
  return out;
}

std::string_view chart_colour(int style) { return kSeries[static_cast<std::size_t>(style) % kSeries.size()]; }

}  // namespace treadmark::pictures
