// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/chart_labels.hpp"

#include <algorithm>
#include <array>

namespace treadmark::io {
namespace {

double overlap(const ChartBox& a, const ChartBox& b) {
  const double width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const double height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  return width > 0.0 && height > 0.0 ? width * height : 0.0;
}

double outside(const ChartBox& a, const ChartBox& frame) { return a.width * a.height - overlap(a, frame); }

constexpr double kNothing = 1e-6;  // [px^2], the rounding of areas

/// Places to try, the best first: where the text's middle lies from the point's, in half widths and half heights.
constexpr std::array<std::array<double, 2>, 16> kSides{{{1, 0},
                                                        {-1, 0},
                                                        {0, -1},
                                                        {0, 1},
                                                        {1, -1},
                                                        {1, 1},
                                                        {-1, -1},
                                                        {-1, 1},
                                                        {0, -2.2},
                                                        {0, 2.2},
                                                        {1, -2.2},
                                                        {1, 2.2},
                                                        {-1, -2.2},
                                                        {-1, 2.2},
                                                        {0, -3.4},
                                                        {0, 3.4}}};

}  // namespace

double text_width(const std::string& text, double font_size) {
  return 0.56 * font_size * static_cast<double>(text.size());
}

std::vector<LabelPlace> place_labels(std::span<const LabelPoint> points, const ChartBox& box, double font_size) {
  std::vector<ChartBox> taken;
  for (const LabelPoint& point : points)
    taken.push_back({point.x - point.radius, point.y - point.radius, 2.0 * point.radius, 2.0 * point.radius});

  std::vector<LabelPlace> places;
  for (const LabelPoint& point : points) {
    const double width = text_width(point.text, font_size), gap = 3.0;
    ChartBox best;
    double least = -1.0;
    for (const auto& side : kSides) {
      const double reach_x = side[1] == 0.0 ? point.radius + gap : 0.7 * point.radius;
      const double reach_y = side[0] == 0.0 ? point.radius + gap : 0.7 * point.radius;
      const double x = point.x + side[0] * (0.5 * width + reach_x);
      const double y = point.y + side[1] * 0.5 * font_size + (side[1] > 0.0 ? reach_y : side[1] < 0.0 ? -reach_y : 0.0);
      const ChartBox trial{x - 0.5 * width, y - 0.5 * font_size, width, font_size};
      double cost = 3.0 * outside(trial, box);
      for (const ChartBox& other : taken) cost += overlap(trial, other);
      if (least >= 0.0 && cost >= least - kNothing) continue;
      least = cost;
      best = trial;
      if (cost <= kNothing) break;
    }
    places.push_back({best.x, best.y + 0.83 * font_size});
    if (!point.text.empty()) taken.push_back(best);
  }
  return places;
}

}  // namespace treadmark::io
