// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/wheel_section.hpp"

#include <cmath>

#include "treadmark/detection/lateral_nodes.hpp"

namespace treadmark::detection {
namespace {

std::vector<double> equal_steps(double low, double high, double step) {
  const int n = 1 + static_cast<int>(std::floor((high - low) / step));
  std::vector<double> y;
  for (int i = 0; i <= n; ++i) y.push_back(low + (high - low) * i / n);
  return y;
}

}  // namespace

double lowest_angle(const Pose& X_TW) { return -std::atan2(X_TW.rotation(0, 2), X_TW.rotation(0, 0)); }

std::vector<double> mesh_lines(const Surface& wheel, double angle, double step) {
  const Box3 box = wheel.bounds();
  const std::vector<double> y =
      lateral_nodes(wheel, {Vec3::Zero(), rotation_y(angle)}, 0.0, {box.min.y(), box.max.y()});
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
