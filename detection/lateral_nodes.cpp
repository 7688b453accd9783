// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/lateral_nodes.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::detection {

std::vector<double> lateral_nodes(const Surface& surface, const Pose& X_SP, double x_P, const LateralInterval& y_P) {
  constexpr double kStep = 0.1e-3;        // of points between which v is taken as linear [m]
  constexpr std::ptrdiff_t kHidden = 10;  // more data than that between two points: something lies behind the rest
  const std::vector<double> data_v = surface.data_v();
  if (data_v.empty()) return {};
  const int n = std::max(2, static_cast<int>(std::ceil((y_P.high - y_P.low) / kStep)));
  std::vector<Vec2> points;
  for (int i = 0; i <= n; ++i) points.emplace_back(x_P, y_P.low + (y_P.high - y_P.low) * i / n);
  std::vector<SurfacePoint> found(points.size());
  surface.locate(X_SP, points, found);

  std::vector<double> y;
  for (std::size_t i = 0; i + 1 < found.size(); ++i) {
    const SurfacePoint &a = found[i], &b = found[i + 1];
    if (a.status == LocateStatus::outside || b.status == LocateStatus::outside) continue;
    const auto begin = std::ranges::lower_bound(data_v, std::min(a.v, b.v)),
               end = std::ranges::lower_bound(data_v, std::max(a.v, b.v));
    if (end - begin > kHidden) continue;
    const auto first = static_cast<std::ptrdiff_t>(y.size());
    for (auto v = begin; v != end; ++v)
      y.push_back(points[i].y() + (points[i + 1].y() - points[i].y()) * (*v - a.v) / (b.v - a.v));
    if (b.v < a.v) std::reverse(y.begin() + first, y.end());
  }
  return y;
}

}  // namespace treadmark::detection
