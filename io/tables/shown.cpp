// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/tables/shown.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::io {
std::string shown_number(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  std::string text = decimals < 0              ? fmt::format("{:.5g}", value)
                     : std::fabs(value) >= 1e9 ? fmt::format("{:.4g}", value)
                                               : fmt::format("{:.{}f}", value, decimals);
  if (text.front() == '-' && text.find_first_not_of("-0.") == text.npos) text.erase(0, 1);
  return text;
}

std::string significant(double value, int digits, double least) {
  const double size = std::abs(value);
  if (!(size >= least && size < 1e9)) return fmt::format("{:.{}g}", value, digits);
  return fmt::format("{:.{}f}", value, decimals_of(value, digits));
}

std::string in_short(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  return size >= 99.95 && size < 1e9 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::string with_unit(const std::string& value, double uncertainty, std::string_view unit) {
  std::string out = value;
  if (uncertainty > 0.0) out += fmt::format(" +- {:.2g}", uncertainty);
  return unit == "1" ? out : fmt::format("{} {}", out, unit);
}

std::string text_line(std::string_view label, std::size_t width, const std::string& text) {
  return fmt::format("{:<{}} {}\n", label, width - 1, text);
}

void add_column(std::vector<std::string>& lines, const std::vector<std::string>& cells, bool texts) {
  std::size_t width = 0;
  for (const std::string& cell : cells) width = std::max(width, characters_of(cell));
  const std::string gap(lines.front().empty() ? 0 : 2, ' ');
  for (std::size_t i = 0; i < lines.size(); ++i)
    lines[i] += gap + (texts ? fmt::format("{:<{}}", cells[i], width) : fmt::format("{:>{}}", cells[i], width));
}

std::string table_text(const std::vector<std::vector<std::string>>& lines, const std::vector<std::size_t>& blocks) {
  constexpr std::size_t kWidest = 80;
  const auto with = [&](std::vector<std::string> block, std::size_t column) {
    std::vector<std::string> cells;
    cells.reserve(lines.size());
    for (const std::vector<std::string>& line : lines) cells.push_back(line[column]);
    add_column(block, cells, column == 0);
    return block;
  };
  std::vector<std::string> keys(lines.size());
  for (std::size_t column = 0; column < blocks.front(); ++column) keys = with(keys, column);
  std::string text;
  const auto written = [&](std::vector<std::string> block) {
    std::erase_if(block, [](const std::string& line) { return line.find_first_not_of(' ') == std::string::npos; });
    text += joined_lines(block);
  };
  std::vector<std::string> block = keys;
  for (std::size_t column = blocks.front(); column < lines.front().size(); ++column) {
    std::vector<std::string> wider = with(block, column);
    if (column > blocks.front() && (ranges::count(blocks, column) > 0 || characters_of(wider.front()) > kWidest)) {
      written(block);
      text += '\n';
      wider = with(keys, column);
    }
    block = std::move(wider);
  }
  written(block);
  return text;
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
