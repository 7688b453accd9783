// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/svg_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "treadmark/io/files/utf8.hpp"

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

}  // namespace treadmark::io
