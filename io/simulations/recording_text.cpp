// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/recording_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/points/fields.hpp"

namespace treadmark::io::recording {

std::string as_utf8(std::string_view text) {
  std::string out = profiles::from_utf16(text);
  if (out.empty()) {
    bool valid = true;
    for (std::size_t at = 0; at < text.size() && valid;) {
      const std::size_t length = utf8_length(text.substr(at));
      valid = length > 0;
      at += length;
    }
    if (valid) {
      out = text;
    } else {
      for (const char c : text) {  // Latin-1
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x80u) {
          out += c;
        } else {
          out += static_cast<char>(0xC0u | code >> 6);
          out += static_cast<char>(0x80u | (code & 0x3Fu));
        }
      }
    }
  }
  for (const auto& [sign, plain] : {std::pair{std::string_view("\xE2\x88\x92"), '-'}, {"\xC2\xA0", ' '}})
    for (std::size_t at = out.find(sign); at != std::string::npos; at = out.find(sign, at))
      out.replace(at, sign.size(), 1, plain);
  return out;
}

std::vector<Cell> cells_of(std::string_view line, char separator) {
  std::vector<Cell> cells;
  std::size_t at = 0;
  const auto skip_blanks = [&] {
    while (at < line.size() && (line[at] == ' ' || (line[at] == '\t' && separator != '\t'))) ++at;
  };
  for (;;) {
    skip_blanks();
    if (separator == ' ' && at == line.size()) return cells;
    Cell cell{{}, static_cast<int>(at) + 1};
    const std::size_t close = at < line.size() && line[at] == '"' ? line.find('"', at + 1) : std::string_view::npos;
    if (close != std::string_view::npos) {
      cell.text = line.substr(at + 1, close - at - 1);
      cell.quoted = true;
      at = close + 1;
      skip_blanks();
    } else {
      const std::size_t start = at;
      at =
          std::min(line.find_first_of(separator == ' ' ? std::string_view(" \t") : std::string_view(&separator, 1), at),
                   line.size());
      cell.text = line.substr(start, at - start);
      while (!cell.text.empty() && profiles::is_blank(cell.text.back())) cell.text.remove_suffix(1);
    }
    cells.push_back(cell);
    if (separator == ' ') continue;
    if (at >= line.size()) return cells;
    at = line[at] == separator ? at + 1 : line.size();
  }
}

void trim(std::vector<Cell>& cells) {
  while (!cells.empty() && cells.back().text.empty()) cells.pop_back();
}

bool is_mark(std::string_view text) {
  static constexpr std::string_view kMarks[] = {
      "",  "n/a", "na",  "n.a.", "#n/a", "nan",     "null", "none", "nil",    "-",       "--",      "---",
      "*", "**",  "***", "?",    "void", "invalid", "k.a.", "n.v.", "nodata", "no data", "#value!", "missing"};
  return ranges::find(kMarks, profiles::lower(text)) != std::end(kMarks);
}

bool is_mark(std::string_view text, double value) {
  for (const double end : {32767.0, 32768.0, 65535.0, 2147483647.0, 2147483648.0})
    if (std::abs(value) == end) return true;
  constexpr double kFar = 1e9;
  if (std::abs(value) >= kFar) return true;
  std::size_t nines = 0, whole = 0;
  bool point = false;
  for (const char c : text) {
    if (c == '9') {
      ++nines;
      if (!point) ++whole;
    } else if (c == '.' || c == ',') {
      point = true;
    } else if (c != '-' && c != '+' && !(c == '0' && point)) {
      return false;
    }
  }
  return whole >= 3 || (whole == 2 && nines >= 4);
}

std::optional<double> with_plus(std::string_view text, double base) {
  const std::size_t start = text.find_first_of("0123456789-");
  if (start == std::string_view::npos) return std::nullopt;
  for (const char c : text.substr(0, start))
    if (!profiles::is_blank(c) && c != '.' && !(c >= 'A' && c <= 'Z') && !(c >= 'a' && c <= 'z')) return std::nullopt;
  text.remove_prefix(start);
  const std::size_t plus = text.find('+');
  if (plus == std::string_view::npos || plus == 0) return std::nullopt;
  std::string_view left = text.substr(0, plus), right = text.substr(plus + 1);
  while (!left.empty() && profiles::is_blank(left.back())) left.remove_suffix(1);
  while (!right.empty() && profiles::is_blank(right.front())) right.remove_prefix(1);
  double whole = 0.0, rest = 0.0;
  if (right.empty() || right.front() < '0' || right.front() > '9' || !points::parse_number(left, false, whole) ||
      !points::is_whole(whole) || !points::parse_number(right, true, rest))
    return std::nullopt;
  return left.starts_with('-') ? whole * base - rest : whole * base + rest;
}

}  // namespace treadmark::io::recording
