// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/report/pictures/svg_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "treadmark/io/files/text.hpp"

namespace treadmark::pictures {

std::string xml_text(std::string_view words) {
  std::string safe;
  while (!words.empty()) {
    const std::size_t length = io::utf8_length(words);
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

std::string turned_text(double x, double y, std::string_view words, const char* anchor, int degrees) {
  return svg_text(x, y, words, anchor, fmt::format(" transform=\"rotate({} {:.1f} {:.1f})\"", degrees, x, y).c_str());
}

std::string svg_box(const char* name, const Box& box, std::string_view more) {
  return fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"{}/>\n", name,
                     box.x, box.y, box.width, box.height, more);
}

std::string svg_cell(const Box& box, std::string_view fill) {
  return fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", box.x, box.y,
                     box.width, box.height, fill);
}

std::string svg_group(std::string_view name, double x, double y, const std::string& elements) {
  const std::string of_class = name.empty() ? "" : fmt::format(" class=\"{}\"", name);
  return fmt::format("<g{} transform=\"translate({:.1f} {:.1f})\">\n{}</g>\n", of_class, x, y, elements);
}

std::string with_unit(std::string_view label, std::string_view unit) {
  return unit.empty() ? std::string(label) : fmt::format("{} [{}]", label, unit);
}

double text_width(const std::string& text, double font_size) {
  return 0.56 * font_size * static_cast<double>(text.size());
}

std::string svg_head(double width, double height, int font_size, std::string_view style) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"{2}\" fill=\"#222222\">\n<style>{3}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      width, height, font_size, style);
}

}  // namespace treadmark::pictures
