// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/html_text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/io/files/text.hpp"
#include "treadmark/report/pictures/svg_text.hpp"

namespace treadmark::report {

std::string html_text(std::string_view words) {
  const std::string safe = pictures::xml_text(words);
  std::string out;
  for (const char c : safe) {
    if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else
      out += c;
  }
  return out;
}

std::string shown(const Number& number) {
  const double value = number.value;
  if (!std::isfinite(value)) return "–";
  constexpr double kLarge = 1e7, kSmall = 1e-4;
  if (std::fabs(value) < io::kShownAsZero) return "0";
  const double size = std::fabs(value);
  // whole numbers in full, if that takes no more digits than asked for: counts
  if (size >= kLarge && value == std::round(value) && size < std::pow(10.0, std::min(number.digits, 15)))
    return fmt::format("{:.0f}", value);
  if (size >= kLarge || size < kSmall) return fmt::format("{:.{}e}", value, number.digits - 1);
  if (std::fabs(value - std::round(value)) < 1e-12 * size) return fmt::format("{:.0f}", value);
  // Halves are rounded away from zero, as browsers do: tables and charts have one number.
  constexpr double kJustBeyond = 1.0 + 4e-16;
  return fmt::format("{:.{}f}", value * kJustBeyond, io::decimals_of(value, number.digits));
}

std::string html_id(std::string_view words) {
  std::string out;
  for (const char c : words) {
    const auto letter = static_cast<unsigned char>(c);
    if (letter < 0x80 && std::isalnum(letter) != 0)
      out += static_cast<char>(std::tolower(letter));
    else if (!out.empty() && out.back() != '-')
      out += '-';
  }
  while (!out.empty() && out.back() == '-') out.pop_back();
  return out.empty() ? "part" : out;
}

}  // namespace treadmark::report
