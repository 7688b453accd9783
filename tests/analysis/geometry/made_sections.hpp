// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "treadmark/analysis/geometry/wheelset_on_track.hpp"

namespace treadmark::geometry {

inline constexpr double kRadius = 0.46;

/// A section from a formula and its derivative.
inline std::shared_ptr<const Section> section(Body body, double low, double high,
                                              const std::function<double(double)>& z,
                                              const std::function<double(double)>& slope) {
  std::vector<double> values, slopes;
  const int n = static_cast<int>(std::lround((high - low) / kSectionStep));
  for (int k = 0; k <= n; ++k) {
    values.push_back(z(low + k * kSectionStep));
    slopes.push_back(slope(low + k * kSectionStep));
  }
  return std::make_shared<const Section>(body, low, kSectionStep, values, slopes);
}

inline std::shared_ptr<const Section> round_rail(double radius, double half_width = 30e-3) {
  return section(
      Body::rail, -half_width, half_width, [=](double y) { return radius - std::sqrt(radius * radius - y * y); },
      [=](double y) { return y / std::sqrt(radius * radius - y * y); });
}

inline std::shared_ptr<const Section> cone(double tan_gamma) {
  return section(
      Body::wheel, -60e-3, 60e-3, [=](double y) { return kRadius - tan_gamma * y; },
      [=](double) { return -tan_gamma; });
}

/// A hollow tread: a circle of this radius about (y_c, beyond the surface), down to kRadius at its deepest... upside
/// down.
inline std::shared_ptr<const Section> hollow(double radius, double y_c) {
  return section(
      Body::wheel, y_c - 0.7 * radius, y_c + 0.7 * radius,
      [=](double y) { return kRadius + radius - std::sqrt(radius * radius - (y - y_c) * (y - y_c)); },
      [=](double y) { return (y - y_c) / std::sqrt(radius * radius - (y - y_c) * (y - y_c)); });
}

/// A made-up wheel with a flange: cone, fillet as a cubic, flange as a cosine.
inline double flanged(double y) {
  const double t = -y - 30e-3;
  return kRadius - 0.05 * y +
         (t > 0.0 && t < 36e-3 ? 14e-3 * (1.0 - std::cos(2.0 * std::numbers::pi * t / 36e-3)) : 0.0);
}
inline double flanged_slope(double y) {
  const double t = -y - 30e-3, w = 2.0 * std::numbers::pi / 36e-3;
  return -0.05 - (t > 0.0 && t < 36e-3 ? 14e-3 * w * std::sin(w * t) : 0.0);
}
inline std::shared_ptr<const Section> flanged_wheel() {
  return section(Body::wheel, -66e-3, 60e-3, flanged, flanged_slope);
}

inline WheelsetOnTrack wheelset(std::shared_ptr<const Section> wheel, std::shared_ptr<const Section> rail,
                                Roll roll = Roll::none, double yaw = 0.0) {
  const SideInput side{std::move(wheel), std::move(rail), 0.75, 0.75, 0.0};
  return {side, side, kRadius, roll, yaw};
}

}  // namespace treadmark::geometry
