// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/imports/import_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/io/files/text.hpp"
#include "treadmark/io/tables/shown.hpp"

namespace treadmark::io {

std::string grouped(std::size_t count) {
  const std::string digits = std::to_string(count);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ' ';
    text += digits[i];
  }
  return text;
}

std::string percent(double part) {
  if (!std::isfinite(part)) return "-";
  const double value = 100.0 * part;
  if (value == 0.0) return "0 %";
  if (std::abs(value) < 0.001) return fmt::format("{:.1g} %", value);
  return fmt::format("{:.{}f} %", value, std::abs(value) >= 10.0 ? 1 : std::abs(value) >= 1.0 ? 2 : 3);
}

std::string percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? "-" : percent(static_cast<double>(part) / static_cast<double>(whole));
}

std::string surface_error_text(const ImportReport& report, std::string_view micro) {
  if (report.errors)
    return fmt::format("{} rms, {} largest", length_text(report.errors->rms, micro),
                       length_text(report.errors->largest, micro));
  if (report.held_out_points == 0) return "not known";
  // The mean square of n residuals scatters by sqrt(2/n) of itself; two of these standard errors are told from nothing.
  const double squared = report.held_out_error * report.held_out_error,
               told = 2.0 * report.held_out_rms * report.held_out_rms *
                      std::sqrt(2.0 / static_cast<double>(report.held_out_points));
  if (squared > told) return length_text(report.held_out_error, micro);
  return "below " + length_text(std::sqrt(squared + told), micro);
}

std::string error_text(const ImportReport::ErrorPart& part) {
  std::string out = part.source;
  const auto add = [&](const std::string& more) { out += (out == part.source ? ": " : ", ") + more; };
  if (part.lateral != 0.0) add(length_text(std::abs(part.lateral)) + " across");
  if (part.vertical != 0.0) add(length_text(std::abs(part.vertical)) + " down");
  if (part.roll != 0.0) add(fmt::format("{:.2g} mrad", 1e3 * std::abs(part.roll)));
  if (part.heights != 0.0)
    add(fmt::format("heights up to {}, alike over {}", length_text(part.heights), length_text(part.length)));
  return out;
}

std::string length_text(double metres, std::string_view micro) {
  if (!std::isfinite(metres)) return "-";
  const double size = std::abs(metres);
  if (size == 0.0) return "0 mm";
  const auto three = [](double value) { return significant(value, 3, 1e-4); };
  if (size < 1e-4) return fmt::format("{} {}m", three(metres * 1e6), micro);
  if (size < 10.0) return three(metres * 1e3) + " mm";
  return three(metres) + " m";
}

PictureUnit picture_unit(double metres) {
  return std::abs(metres) < 2e-4 ? PictureUnit{"\u00b5m", 1e6} : PictureUnit{"mm", 1e3};
}

std::string place_text(const ImportReport& report, double u, std::string_view degree) {
  if (report.body == Body::wheel) return fmt::format("{}{}", shown_number(u * 180.0 / std::numbers::pi, 2), degree);
  return shown_number(u * 1e3, 1) + " mm";
}

std::string line_text(const ImportReport& report) {
  if (!report.line || report.line->places.empty()) return {};
  const ImportReport::Line& line = *report.line;
  const auto most = std::max_element(line.places.begin(), line.places.end(), [](const auto& a, const auto& b) {
    return std::fabs(a.curvature) < std::fabs(b.curvature);
  });
  if (!line.bent)
    return fmt::format("straight; a curvature of {:.2g} 1/m would not stand out of its error",
                       2.0 * most->curvature_error);
  const auto [least, greatest] = std::minmax_element(
      line.places.begin(), line.places.end(), [](const auto& a, const auto& b) { return a.curvature < b.curvature; });
  std::string radius;
  if (std::fabs(most->curvature) > 2.0 * most->curvature_error)
    radius = fmt::format(", R = {} m to the {} at {}", shown_number(1.0 / std::fabs(most->curvature), 1),
                         most->curvature > 0.0 ? "right" : "left", place_text(report, most->x));
  return fmt::format(
      "curvature {:.4g} to {:.4g} 1/m, known to {:.2g} (standard error){}; {} off a straight line: the "
      "surface is straightened along the rail",
      least->curvature, greatest->curvature, most->curvature_error, radius, length_text(line.deviation));
}

std::string shortened(std::string_view text, std::size_t letters) {
  std::string out;
  std::size_t count = 0;
  for (std::string_view rest = text; !rest.empty(); ++count) {
    const std::size_t length = std::max<std::size_t>(1, utf8_length(rest));
    if (count + 1 == letters && rest.size() > length) return out + "\u2026";
    out += rest.substr(0, length);
    rest.remove_prefix(length);
  }
  return out;
}

}  // namespace treadmark::io
