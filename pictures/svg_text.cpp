// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/pictures/svg_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/io/files/text.hpp"

namespace treadmark::io {

std::string xml_text(std::string_view words) {
  std::string safe;
  while (!words.empty()) {
    const std::size_t length = utf8_length(words);
    const char c = words.front();
    if (length == 0)
      safe += '?';
    else if (words.starts_with("\xEF\xBF\xBE") || words.starts_with("\xEF\xBF\xBF"))
      safe += '?';  // U+FFFE and U+FFFF are no characters of XML
    else if (length > 1)
      safe += words.substr(0, length);
    else if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else
      safe += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
    words.remove_prefix(length == 0 ? 1 : length);
  }
  return safe;
}

std::string svg_text(double x, double y, std::string_view words, const char* anchor, const char* more) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                     xml_text(words));
}

std::string three_digits(double value) {
  return std::abs(value) >= 100.0 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

double tick_step(double length) {
  const double rough = length / 6.0, power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) return factor * power;
  return 10.0 * power;
}

std::string svg_head(double width, double height, int font_size, std::string_view style) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"{2}\" fill=\"#222222\">\n<style>{3}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      width, height, font_size, style);
}

std::string draw_panel_axes(const PanelScale& panel, bool numbers_of_y) {
  const Window& window = panel.window;
  const double width = window.width() * panel.scale_x, height = window.height() * panel.scale_y;
  std::string out;
  const auto ticks = [](double low, double high, auto&& mark) {
    const double step = tick_step(high - low);
    for (double i = std::ceil(low / step); i * step <= high; ++i) mark(i * step + 0.0);
  };
  ticks(window.x_low, window.x_high, [&](double value) {
    const double x = (value - window.x_low) * panel.scale_x;
    out += fmt::format("<path class=\"tick\" d=\"M{:.1f} {:.1f}v4\"/>\n", x, height);
    out += svg_text(x, height + 14.0, fmt::format("{:.6g}", value));
  });
  ticks(window.y_low, window.y_high, [&](double value) {
    const double y = (window.y_high - value) * panel.scale_y;
    out += fmt::format("<path class=\"tick\" d=\"M0 {:.1f}h-4\"/>\n", y);
    if (numbers_of_y) out += svg_text(-6.0, y + 3.5, fmt::format("{:.6g}", value), "end");
  });
  return out + fmt::format("<rect class=\"tick\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", width, height);
}

std::string force_and_pressure(const CaseResult& result) {
  double force = 0.0, pressure = 0.0;
  for (const PatchResult& patch : result.patches) {
    force += patch.fn;
    pressure = std::max(pressure, patch.pmax);
  }
  return three_digits(force * 1e-3) + " kN, " + three_digits(pressure * 1e-6) + " MPa";
}

std::string draw_pressure_bar(double top_pressure, double height) {
  std::string out;
  const double step_height = height / kPressureSteps;
  for (int step = 0; step < kPressureSteps; ++step)
    out += fmt::format("<rect x=\"0\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                       height - (step + 1) * step_height, kPressureBarWidth, step_height + 0.2, step_colour(step));
  const double top_mpa = top_pressure * 1e-6;
  if (!(top_mpa > 0.0)) return out;
  const double step = tick_step(top_mpa);
  for (double i = 0.0; i * step <= top_mpa; ++i) {
    const double y = height * (1.0 - i * step / top_mpa);
    out += fmt::format("<path class=\"tick\" d=\"M{} {:.1f}h4\"/>\n", kPressureBarWidth, y);
    out += svg_text(kPressureBarWidth + 7.0, y + 3.5, fmt::format("{:.4g}", i * step), "start");
  }
  return out;
}

}  // namespace treadmark::io
