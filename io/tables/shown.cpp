// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/tables/shown.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace treadmark::io {

std::string shown_number(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  std::string text = decimals < 0 ? fmt::format("{:.5g}", value) : fmt::format("{:.{}f}", value, decimals);
  if (text.front() == '-' && text.find_first_not_of("-0.") == text.npos) text.erase(0, 1);
  return text;
}

std::string with_unit(const std::string& value, double uncertainty, std::string_view unit) {
  std::string out = value;
  if (uncertainty > 0.0) out += fmt::format(" +- {:.2g}", uncertainty);
  return unit == "1" ? out : fmt::format("{} {}", out, unit);
}

std::string text_line(std::string_view label, std::size_t width, const std::string& text) {
  return fmt::format("{:<{}}{}\n", label, width, text);
}

void add_column(std::vector<std::string>& lines, const std::vector<std::string>& cells, bool texts) {
  std::size_t width = 0;
  for (const std::string& cell : cells) width = std::max(width, cell.size());
  const std::string gap(lines.front().empty() ? 0 : 2, ' ');
  for (std::size_t i = 0; i < lines.size(); ++i)
    lines[i] += gap + (texts ? fmt::format("{:<{}}", cells[i], width) : fmt::format("{:>{}}", cells[i], width));
}

std::string joined_lines(const std::vector<std::string>& lines) {
  std::string out;
  for (std::string line : lines) {
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  }
  return out;
}

}  // namespace treadmark::io
