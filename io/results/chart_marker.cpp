// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/chart_marker.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace treadmark::io {
namespace {

constexpr std::array<std::string_view, 7> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                   "#000000", "#e69f00", "#56b4e9"};
constexpr int kShapes = 8;

using Corners = std::vector<std::array<double, 2>>;

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

std::string_view chart_colour(int style) { return kColours[static_cast<std::size_t>(style) % kColours.size()]; }

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

}  // namespace treadmark::io
