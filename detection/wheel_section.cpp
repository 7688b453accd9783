// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/wheel_section.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/lateral_data.hpp"

namespace treadmark::detection {
namespace {

std::vector<double> equal_steps(double low, double high, double step) {
  const int n = 1 + static_cast<int>(std::floor((high - low) / step));
  std::vector<double> y;
  for (int i = 0; i <= n; ++i) y.push_back(low + (high - low) * i / n);
  return y;
}

/// Where v takes certain values along a section, v linear between close points.
std::vector<double> where(const Surface& wheel, double angle, double low, double high, const std::vector<double>& wanted_v) {
  constexpr double kStep = 0.1e-3;
  constexpr std::ptrdiff_t kHidden = 10;  // more values than that between close points: something lies behind the rest
  const int n = std::max(2, static_cast<int>(std::ceil((high - low) / kStep)));
  std::vector<Vec2> points;
  for (int i = 0; i <= n; ++i) points.emplace_back(0.0, low + (high - low) * i / n);
  std::vector<SurfacePoint> found(points.size());
  wheel.locate({Vec3::Zero(), rotation_y(angle)}, points, found);
  std::vector<double> y;
  for (std::size_t i = 0; i + 1 < found.size(); ++i) {
    const SurfacePoint &a = found[i], &b = found[i + 1];
    if (a.status == LocateStatus::outside || b.status == LocateStatus::outside) continue;
    const auto begin = std::ranges::lower_bound(wanted_v, std::min(a.v, b.v)), end = std::ranges::lower_bound(wanted_v, std::max(a.v, b.v));
    if (end - begin > kHidden) continue;
    std::vector<double> here;
    for (auto v = begin; v != end; ++v) here.push_back(points[i].y() + (points[i + 1].y() - points[i].y()) * (*v - a.v) / (b.v - a.v));
    if (b.v < a.v) std::ranges::reverse(here);
    y.insert(y.end(), here.begin(), here.end());
  }
  return y;
}

}  // namespace

double lowest_angle(const Pose& X_TW) { return -std::atan2(X_TW.rotation(0, 2), X_TW.rotation(0, 0)); }

std::vector<double> lateral_nodes(const Surface& wheel, double angle, double step) {
  const Box3 box = wheel.bounds();
  const auto* data = dynamic_cast<const LateralData*>(&wheel);
  std::vector<double> y;
  if (data != nullptr) y = where(wheel, angle, box.min.y(), box.max.y(), data->data_v());
  constexpr std::size_t kFewest = 4;
  return y.size() >= kFewest ? y : equal_steps(box.min.y(), box.max.y(), step);
}

std::vector<double> section_radius(const Surface& wheel, double angle, std::span<const double> y) {
  std::vector<Vec2> points;
  points.reserve(y.size());
  for (const double at : y) points.emplace_back(0.0, at);
  std::vector<double> radius(y.size());
  wheel.heights_at({Vec3::Zero(), rotation_y(angle)}, points, {radius, {}, {}});
  return radius;
}

}  // namespace treadmark::detection
