// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Where the points of a virtual scan lie and how densely.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/scans/virtual/virtual_scanner.hpp"
#include "treadmark/tests/scans/virtual/sample_scans.hpp"

namespace treadmark::scans {
namespace {

using namespace scans::testing;

constexpr double kExact = 1e-9;  // [m] what is asked of points without noise
constexpr double kCount = 5e-3;  // of the number of points: ends of lines are random
constexpr double kEven =
    0.025;  // of the points of a bin: a line more or less among 90, a point more or less at its ends

/// Largest relative deviation of the counts of n bins from even.
double unevenness(const std::vector<double>& at, double low, double high, int n) {
  std::vector<int> count(static_cast<std::size_t>(n), 0);
  for (const double x : at)
    ++count[static_cast<std::size_t>(std::clamp(static_cast<int>((x - low) / (high - low) * n), 0, n - 1))];
  double worst = 0.0;
  for (const int c : count) worst = std::max(worst, std::fabs(c * n / static_cast<double>(at.size()) - 1.0));
  return worst;
}

TEST(VirtualScanner, RailPointsLieOnTheCylinderEvenly) {
  const VirtualScan scan = scan_surface(*round_rail(), rail_settings(200'000));
  EXPECT_NEAR(static_cast<double>(scan.cloud.points.size()) / 200'000.0, 1.0, kCount);
  EXPECT_EQ(scan.cloud.points.size(), scan.truth.on_surface);
  EXPECT_NEAR(scan.truth.area / rail_area(), 1.0, 1e-4);
  EXPECT_NEAR(scan.truth.spacing, std::sqrt(rail_area() / 200'000.0), 1e-7);
  EXPECT_TRUE(scan.cloud.passes.empty());
  std::vector<double> angle, x;
  for (const Vec3& p : scan.cloud.points) {
    ASSERT_NEAR(off_rail(p), 0.0, kExact);
    angle.push_back(std::atan2(p.y(), kHeadRadius - p.z()));
    x.push_back(p.x());
  }
  EXPECT_LT(unevenness(angle, -kHeadAngle, kHeadAngle, 24), kEven);
  EXPECT_LT(unevenness(x, -kRailHalf, kRailHalf, 10), kEven);
}

TEST(VirtualScanner, RailAlongACircle) {
  static constexpr double kRadius = 20.0, kCant = 0.1;
  ScannerSettings settings = rail_settings(50'000);
  settings.line = [](double s) {
    const double psi = s / kRadius;
    return Pose{kRadius * Vec3(std::sin(psi), 1.0 - std::cos(psi), 0.0), rotation_z(psi) * rotation_x(kCant)};
  };
  settings.X_CS = {Vec3(1.0, 2.0, 3.0), rotation_x(0.3) * rotation_z(-0.8)};
  const VirtualScan scan = scan_surface(*round_rail(), settings), straight = [&] {
    settings.line = {};
    return scan_surface(*round_rail(), settings);
  }();
  ASSERT_EQ(scan.cloud.points.size(), straight.cloud.points.size()) << "the same places along and across";
  for (std::size_t i = 0; i < scan.cloud.points.size(); ++i) {
    // unbent by the circle in closed form
    const Vec3 p = settings.X_CS.apply_inverse(scan.cloud.points[i]);
    const double psi = std::atan2(p.x(), kRadius - p.y());
    const Vec3 radial(0.0, kRadius - std::hypot(p.x(), kRadius - p.y()), p.z()),
        on_rail = rotation_x(kCant).transpose() * radial;
    ASSERT_NEAR(off_rail(on_rail), 0.0, kExact);
    ASSERT_NEAR(kRadius * psi, settings.X_CS.apply_inverse(straight.cloud.points[i]).x(), kExact);
  }
  settings = wheel_settings(1000);
  settings.line = [](double s) { return Pose{Vec3(s, 0.0, 0.0), Mat3::Identity()}; };
  EXPECT_THROW(scan_surface(*ball_wheel(), settings), Error);
}

TEST(VirtualScanner, WheelPointsLieOnTheBallEvenly) {
  const VirtualScan scan = scan_surface(*ball_wheel(), wheel_settings(200'000));
  EXPECT_NEAR(static_cast<double>(scan.cloud.points.size()) / 200'000.0, 1.0, kCount);
  EXPECT_NEAR(scan.truth.area / wheel_area(), 1.0, 1e-4);
  std::vector<double> theta, y;
  for (const Vec3& p : scan.cloud.points) {
    ASSERT_NEAR(p.norm(), kBallRadius, kExact);
    theta.push_back(std::atan2(p.x(), p.z()));
    y.push_back(p.y());  // zones of equal width of a sphere have equal area; lines come closer by 1 - cos(0.15) = 1 %
  }
  EXPECT_LT(unevenness(theta, -std::numbers::pi, std::numbers::pi, 30), kEven);
  EXPECT_LT(unevenness(y, -kBallRadius * std::sin(kBallAngle), kBallRadius * std::sin(kBallAngle), 20), kEven);
}

TEST(VirtualScanner, NeighboursAreASpacingApart) {
  ScannerSettings settings = rail_settings(0);
  settings.spacing = 2e-3;
  const VirtualScan scan = scan_surface(*round_rail(), settings);
  EXPECT_EQ(scan.truth.spacing, 2e-3);
  EXPECT_NEAR(static_cast<double>(scan.cloud.points.size()) * 4e-6 / rail_area(), 1.0, 0.01);
  // brute force: nearest neighbours along a line are 0.5 to 1.5 steps apart, lines exactly one
  std::size_t compared = 0;
  for (std::size_t i = 0; i < scan.cloud.points.size(); i += 37) {
    double nearest = 1.0;
    for (std::size_t k = 0; k < scan.cloud.points.size(); ++k)
      if (k != i) nearest = std::min(nearest, (scan.cloud.points[k] - scan.cloud.points[i]).norm());
    EXPECT_GT(nearest, 0.49 * 2e-3);
    EXPECT_LT(nearest, 1.52 * 2e-3);
    ++compared;
  }
  EXPECT_GT(compared, 100u);
}

TEST(VirtualScanner, LinesGoAcrossInOrder) {
  const VirtualScan scan = scan_surface(*round_rail(), rail_settings(20'000));
  std::size_t lines = 1;
  for (std::size_t i = 1; i < scan.cloud.points.size(); ++i) {
    const Vec3 &a = scan.cloud.points[i - 1], &b = scan.cloud.points[i];
    if (a.x() == b.x()) {
      ASSERT_LT(a.y(), b.y());
    } else {
      ASSERT_LT(a.x(), b.x());
      ++lines;
    }
  }
  ASSERT_EQ(scan.truth.passes.size(), 1u);
  EXPECT_EQ(scan.truth.passes[0].lines, lines);
  EXPECT_EQ(scan.truth.passes[0].points, scan.cloud.points.size());
}

TEST(VirtualScanner, SteepFlanksHaveAsManyPointsAsTheirAreaTakes) {
  // a slope of 200 to 1 over 0.1 mm of y, 20 mm high, between two level halves of 20 mm each
  constexpr double kSlope = 200.0, kWidth = 1e-4, kHalf = 0.02;
  const auto z = [&](double, double y) {
    if (std::fabs(y) > kHalf) return std::numeric_limits<double>::quiet_NaN();
    return kSlope * std::clamp(y, 0.0, kWidth);
  };
  const FormulaRail rail(z, {{-0.05, -kHalf, 0.0}, {0.05, kHalf, kSlope * kWidth}});
  ScannerSettings settings;
  settings.points = 60'000;
  const VirtualScan scan = scan_surface(rail, settings);
  std::size_t flank = 0;
  for (const Vec3& p : scan.cloud.points) {
    ASSERT_NEAR(p.z(), z(0.0, p.y()), kExact);
    if (p.y() > 0.0 && p.y() < kWidth) ++flank;
  }
  const double flank_length = std::hypot(kWidth, kSlope * kWidth), length = 2.0 * kHalf - kWidth + flank_length;
  EXPECT_NEAR(scan.truth.area, 0.1 * length, 1e-3 * 0.1 * length);
  EXPECT_NEAR(static_cast<double>(flank) / static_cast<double>(scan.cloud.points.size()), flank_length / length, 0.01);
}

TEST(VirtualScanner, JumpsAndGapsHaveNoPoints) {
  // a step without a flank at y = 5 mm, nothing for 0 < y < 3 mm, nothing for x > 40 mm + y
  const auto z = [](double x, double y) {
    if (x < -0.05 || std::fabs(y) > 0.02 || (y > 0.0 && y < 3e-3) || x > 0.04 + y)
      return std::numeric_limits<double>::quiet_NaN();
    return y < 5e-3 ? 0.0 : 8e-3;
  };
  const FormulaRail rail(z, {{-0.05, -0.02, 0.0}, {0.07, 0.02, 8e-3}});
  ScannerSettings settings;
  settings.points = 80'000;
  const VirtualScan scan = scan_surface(rail, settings);
  const double area = (0.09 * 0.04) - (0.09 + 1.5e-3) * 3e-3;  // the slanted end is at x = 40 mm on average
  EXPECT_NEAR(scan.truth.area / area, 1.0, 2e-3);
  EXPECT_NEAR(static_cast<double>(scan.cloud.points.size()) / 80'000.0, 1.0, kCount);
  std::size_t at_the_step = 0, left = 0;
  for (const Vec3& p : scan.cloud.points) {
    ASSERT_EQ(p.z(), z(p.x(), p.y()));
    if (std::fabs(p.y() - 5e-3) < 1e-5) ++at_the_step;
    if (p.y() < 0.0) ++left;
  }
  EXPECT_LT(at_the_step, 80u);  // 32 by area; those on the jump would be 13,000
  EXPECT_NEAR(static_cast<double>(left) / static_cast<double>(scan.cloud.points.size()), 0.02 * 0.08 / area, 0.01);
}

TEST(VirtualScanner, OnlyTheRangeIsScanned) {
  ScannerSettings settings = wheel_settings(20'000);
  settings.u_min = 3.0;  // across the seam at pi
  settings.u_max = 3.5;
  settings.y_min = -0.01;
  settings.y_max = 0.03;
  const VirtualScan scan = scan_surface(*ball_wheel(), settings);
  EXPECT_NEAR(scan.truth.area, 0.5 * kBallRadius * 0.04, 1e-3 * 0.5 * kBallRadius * 0.04);
  EXPECT_NEAR(static_cast<double>(scan.cloud.points.size()), 20'000.0, 200.0);
  for (const Vec3& p : scan.cloud.points) {
    double theta = std::atan2(p.x(), p.z());
    if (theta < 0.0) theta += 2.0 * std::numbers::pi;
    ASSERT_GE(theta, 3.0 - 1e-12);
    ASSERT_LE(theta, 3.5 + 1e-12);
    ASSERT_GE(p.y(), -0.01 - kExact);
    ASSERT_LE(p.y(), 0.03 + kExact);
  }
}

TEST(VirtualScanner, StandardWheelIsScannedFromBackToFace) {
  const auto wheel = analytic::make_standard_surface({"S1002"}, Body::wheel, 0.46);
  const VirtualScan scan = scan_surface(*wheel, wheel_settings(100'000));
  double low = 1.0, high = -1.0, greatest = 0.0;
  for (const Vec3& p : scan.cloud.points) {
    low = std::min(low, p.y());
    high = std::max(high, p.y());
    greatest = std::max(greatest, std::hypot(p.x(), p.z()));
  }
  EXPECT_NEAR(low, -70e-3, 2e-4);
  EXPECT_NEAR(high, 60e-3, 2e-3);
  EXPECT_NEAR(greatest, 0.488, 1e-4);  // flange tip
}

}  // namespace
}  // namespace treadmark::scans
