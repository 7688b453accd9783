// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/graph_bounds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "treadmark/core/constants.hpp"

namespace treadmark {
namespace {

/// A rail with steep sides and waves along it, and the same round a wheel.
SteepestGraph wavy(bool wheel) {
  const auto z = [](double u, double y) {
    return y * y / 0.6 + 2e-4 * std::cos(60.0 * u) + 4e-3 * (1.0 + std::tanh(400.0 * (std::fabs(y) - 0.03)));
  };
  if (!wheel) return {z, {-0.2, 0.2, -0.036, 0.036}, -2e-4, 1.1e-2, std::hypot(0.12 + 1.6, 0.012)};
  const auto r = [z](double u, double y) { return 0.46 - z(u, y); };
  return {r, {0.0, 0.0, -0.036, 0.036}, 0.449, 0.4602, std::hypot(0.12 + 1.6, 0.012 / 0.449)};
}

constexpr double kFine = 1e-4;  // [m]

/// The first change of sign along a line from outside, in fine steps.
double first_hit(bool wheel, const SteepestGraph& g, const Pose& X, double x, double y) {
  constexpr double kFar = 0.06;
  double before = kNaN;
  for (double t = kFar; t > -kFar; t -= kFine) {
    const Vec3 p = X.apply({x, y, wheel ? t : -t});
    const bool there = std::fabs(p.y()) <= g.domain.y_max && (wheel || std::fabs(p.x()) <= g.domain.x_max);
    const double value = g.value(wheel ? std::atan2(p.x(), p.z()) : p.x(), p.y());
    const double now = !there ? kNaN : wheel ? std::hypot(p.x(), p.z()) - value : value - p.z();
    if (before > 0.0 && now <= 0.0) return wheel ? t : -t;
    before = now;
  }
  return kNaN;
}

TEST(GraphBounds, HoldEveryHeightAndAreOfTheSizeOfTheRectangle) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const bool wheel : {false, true}) {
    const SteepestGraph graph = wavy(wheel);
    int small = 0, loose = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const double u = 0.15 * unit(random), y = 0.03 * unit(random), value = graph.value(u, y);
      Pose X{{u, y, value}, Mat3::Identity()};
      if (wheel) X = {{value * std::sin(u), y, value * std::cos(u)}, rotation_y(u)};
      const double roll = 0.8 * unit(random), yaw = unit(random), pitch = 0.2 * unit(random);
      X.rotation = X.rotation * rotation({roll, yaw, pitch});
      const double width = std::pow(10.0, -3.0 + unit(random)), length = std::pow(10.0, -3.0 + unit(random));
      const double x0 = 0.01 * unit(random), y0 = 0.01 * unit(random);
      const HeightBounds b =
          height_bounds(wheel ? Facing::down : Facing::up, graph, X, {x0, x0 + length, y0, y0 + width});
      double low = kInfinity, high = -kInfinity;
      int found = 0;
      for (int i = 0; i < 25; ++i) {
        const int column = i % 5, row = i / 5;
        const double z = first_hit(wheel, graph, X, x0 + 0.25 * length * column, y0 + 0.25 * width * row);
        if (std::isnan(z)) continue;
        ++found;
        ASSERT_TRUE(!b.empty && z >= b.z_min - kFine && z <= b.z_max + kFine) << trial << ": " << z;
        low = std::min(low, z), high = std::max(high, z);
      }
      const double size = width + length;
      if (found < 25 || size > 2e-3 || high - low > 2.0 * size) continue;
      ++small;  // as conformance asks, towards the other body
      if ((wheel ? b.z_max - high : low - b.z_min) > 3.0 * size + 1e-4) ++loose;
    }
    EXPECT_LE(loose, small / 10);
    EXPECT_GT(small, 20);
  }
}

TEST(GraphBounds, BesideTheSurfaceThereIsNothing) {
  EXPECT_TRUE(height_bounds(Facing::up, wavy(false), {}, {0.21, 0.22, 0.0, 0.001}).empty);
  for (const bool wheel : {false, true})
    EXPECT_TRUE(height_bounds(wheel ? Facing::down : Facing::up, wavy(wheel), {}, {0.0, 0.004, 0.037, 0.041}).empty);
}

}  // namespace
}  // namespace treadmark
