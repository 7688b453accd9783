// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/report/pictures/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace treadmark::pictures {

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

namespace {

constexpr int kShapes = 8;

using Corners = std::vector<Pixel>;

/// Corners on a circle, from the angle start [turns] on; every second one at the inner radius.
Corners on_circle(int count, double start, double inner = 1.0) {
  Corners out;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * (start + static_cast<double>(i) / count);
    const double radius = i % 2 == 0 ? 1.0 : inner;
    out.push_back({radius * std::sin(angle), -radius * std::cos(angle)});
  }
  return out;
}

Corners shape(int number) {
  switch (number) {
    case 0:
      return on_circle(32, 0.0);
    case 1:
      return on_circle(4, 0.125);  // square
    case 2:
      return on_circle(3, 0.0);  // triangle
    case 3:
      return on_circle(4, 0.0);  // diamond
    case 4:
      return on_circle(3, 0.5);  // triangle upside down
    case 5:
      return on_circle(10, 0.0, 0.4);  // star of five points
    case 6:
      return on_circle(8, 0.125, 0.35);  // of four
    default:
      return on_circle(6, 0.0);
  }
}

}  // namespace

Corners chart_marker_corners(int style, double radius) {
  Corners corners = shape(style % kShapes);
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  const double factor = radius * std::sqrt(std::numbers::pi / std::abs(area));
  for (auto& corner : corners)
    for (double& x : corner) x *= factor;
  return corners;
}

std::string chart_marker_path(int style, double x, double y, double radius) {
  std::string out;
  for (const auto& corner : chart_marker_corners(style, radius))
    out += fmt::format("{}{:.2f} {:.2f}", out.empty() ? 'M' : 'L', x + corner[0], y + corner[1]);
  return out + 'z';
}

}  // namespace treadmark::pictures
