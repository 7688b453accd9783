// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/chart_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace treadmark::io {
namespace {

/// With at most two decimals.
std::string short_number(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace

std::vector<Pixel> thin_curve(std::span<const Pixel> line) {
  std::vector<Pixel> out;
  for (std::size_t first = 0; first < line.size();) {
    const double column = std::floor(line[first][0]);
    std::size_t last = first;
    while (last + 1 < line.size() && std::floor(line[last + 1][0]) == column) ++last;
    const auto by_y = [](const Pixel& a, const Pixel& b) { return a[1] < b[1]; };
    const auto begin = line.begin() + static_cast<std::ptrdiff_t>(first),
               end = line.begin() + static_cast<std::ptrdiff_t>(last) + 1;
    const auto [low, high] = std::minmax_element(begin, end, by_y);
    std::array<std::size_t, 4> kept{first, static_cast<std::size_t>(low - line.begin()),
                                    static_cast<std::size_t>(high - line.begin()), last};
    std::sort(kept.begin(), kept.end());
    const auto different = std::unique(kept.begin(), kept.end());
    for (auto one = kept.begin(); one != different; ++one) out.push_back(line[*one]);
    first = last + 1;
  }
  return out;
}

std::string curve_path(std::span<const Pixel> line) {
  std::string path;
  for (const Pixel& point : line)
    fmt::format_to(std::back_inserter(path), "{}{} {}", path.empty() ? 'M' : 'L', short_number(point[0]),
                   short_number(point[1]));
  return path;
}

}  // namespace treadmark::io
