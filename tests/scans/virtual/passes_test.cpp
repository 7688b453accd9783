// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Passes, registration errors and frames of a virtual scan.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "treadmark/scans/virtual/virtual_scanner.hpp"
#include "treadmark/tests/scans/virtual/sample_scans.hpp"

namespace treadmark::scans {
namespace {

using namespace scans::testing;

constexpr double kPassExact = 1e-9;  // [m]

void expect_rigid(const Pose& X) {
  EXPECT_LT((X.rotation.transpose() * X.rotation - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(X.rotation.determinant(), 0.0);
}

TEST(ScannerPasses, OfARailLieBesideEachOther) {
  ScannerSettings settings = rail_settings(100'000);
  settings.passes = 3;
  const VirtualScan scan = scan_surface(*round_rail(), settings);
  ASSERT_EQ(scan.truth.passes.size(), 3u);
  ASSERT_EQ(scan.cloud.passes.size(), scan.cloud.points.size());
  EXPECT_NEAR(static_cast<double>(scan.cloud.points.size()), 100'000.0, 500.0);
  // widths of arc: w + 2 * 0.75 w is the whole
  const double width = 2.0 * kHeadAngle / 2.5;
  std::vector<double> low(3, 9.0), high(3, -9.0), count(3, 0.0);
  for (std::size_t i = 0; i < scan.cloud.points.size(); ++i) {
    const Vec3& p = scan.cloud.points[i];
    ASSERT_NEAR(off_rail(p), 0.0, kPassExact);
    const std::size_t k = scan.cloud.passes[i];
    ASSERT_LT(k, 3u);
    if (i > 0) {
      ASSERT_GE(k, scan.cloud.passes[i - 1]);
    }
    const double angle = std::atan2(p.y(), kHeadRadius - p.z());
    low[k] = std::min(low[k], angle);
    high[k] = std::max(high[k], angle);
    count[k] += 1.0;
  }
  constexpr double kAngle = 1e-3;
  for (std::size_t k = 0; k < 3; ++k) {
    const double from = -kHeadAngle + 0.75 * width * static_cast<double>(k);
    EXPECT_NEAR(low[k], from, kAngle);
    EXPECT_NEAR(high[k], from + width, kAngle);
    EXPECT_NEAR(scan.truth.passes[k].y_min, kHeadRadius * std::sin(from), 1e-4);
    EXPECT_NEAR(scan.truth.passes[k].y_max, kHeadRadius * std::sin(from + width), 1e-4);
    EXPECT_NEAR(count[k], 100'000.0 / 3.0, 500.0);
    EXPECT_EQ(static_cast<double>(scan.truth.passes[k].points), count[k]);
  }
  EXPECT_NEAR(scan.truth.area / rail_area(), 1.0, 1e-4);
  // overlaps are covered twice: the spacing belongs to 1.2 times the area
  EXPECT_NEAR(scan.truth.spacing / std::sqrt(1.2 * rail_area() / 100'000.0), 1.0, 3e-3);
}

TEST(ScannerPasses, OfAWheelGoRoundIt) {
  ScannerSettings settings = wheel_settings(120'000);
  settings.passes = 4;
  const VirtualScan scan = scan_surface(*ball_wheel(), settings);
  const double turn = 2.0 * std::numbers::pi, width = turn / 3.0;
  std::vector<int> covered(360, 0);
  for (std::size_t k = 0; k < 4; ++k) {
    const ScannerPass& pass = scan.truth.passes[k];
    EXPECT_NEAR(pass.u_max - pass.u_min, width, 1e-12);
    EXPECT_NEAR(pass.u_min, -std::numbers::pi + 0.75 * width * static_cast<double>(k), 1e-12);
    for (int i = 0; i < 360; ++i) {
      const double at = std::fmod(-std::numbers::pi + turn * (i + 0.5) / 360.0 - pass.u_min + 2.0 * turn, turn);
      if (at < width) ++covered[static_cast<std::size_t>(i)];
    }
  }
  EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), 240);  // half of each pass alone
  EXPECT_EQ(std::count(covered.begin(), covered.end(), 2), 120);
  std::vector<double> count(360, 0.0);
  for (const Vec3& p : scan.cloud.points) {
    const double theta = std::atan2(p.x(), p.z()) + std::numbers::pi;
    count[static_cast<std::size_t>(std::clamp(static_cast<int>(theta / turn * 360.0), 0, 359))] += 1.0;
  }
  for (std::size_t i = 0; i < 360; ++i)
    EXPECT_NEAR(count[i] / (120'000.0 / 480.0 * covered[i]), 1.0, 0.25) << i;  // a bin of 8 mm has 7 to 8 lines
}

TEST(ScannerPasses, DoNotRepeatPointsWhereTheyOverlap) {
  ScannerSettings settings = rail_settings(20'000);
  settings.passes = 2;
  const VirtualScan scan = scan_surface(*round_rail(), settings);
  std::vector<double> lines[2];
  for (std::size_t i = 0; i < scan.cloud.points.size(); ++i)
    lines[scan.cloud.passes[i]].push_back(scan.cloud.points[i].x());
  for (const double x : lines[0]) ASSERT_FALSE(std::binary_search(lines[1].begin(), lines[1].end(), x));
}

TEST(ScannerRegistration, IsTheRigidErrorThatTheTruthStates) {
  ScannerSettings settings = rail_settings(60'000);
  settings.passes = 3;
  settings.registration = 0.2e-3;
  settings.random_frame = true;
  const VirtualScan scan = scan_surface(*round_rail(), settings);
  ASSERT_EQ(scan.truth.X_pass.size(), 3u);
  for (const Pose& X : scan.truth.X_pass) expect_rigid(X);
  double off = 0.0;
  for (std::size_t i = 0; i < scan.cloud.points.size(); ++i) {
    const Vec3 right = scan.truth.X_pass[scan.cloud.passes[i]].apply_inverse(scan.cloud.points[i]);
    ASSERT_NEAR(off_rail(scan.truth.X_CS.apply_inverse(right)), 0.0, kPassExact);
    off = std::max(off, std::fabs(off_rail(scan.truth.X_CS.apply_inverse(scan.cloud.points[i]))));
  }
  EXPECT_GT(off, 0.05e-3);
  EXPECT_LT(off, 2e-3);
}

TEST(ScannerRegistration, MovesTheMiddleAndTheEndsByItsSize) {
  ScannerSettings settings = rail_settings(20'000);
  settings.passes = 400;
  settings.registration = 0.1e-3;
  const VirtualScan scan = scan_surface(*round_rail(), settings);
  double middle = 0.0, turn_z = 0.0;
  for (std::size_t k = 0; k < 400; ++k) {
    const Pose& X = scan.truth.X_pass[k];
    const Vec3& m = scan.truth.passes[k].middle_C;
    EXPECT_NEAR(m.x(), 0.0, 1e-3);
    middle += (X.apply(m) - m).squaredNorm() / 3.0;
    const Vec3 end = m + kRailHalf * Vec3::UnitX();
    turn_z += std::pow((X.apply(end) - end - (X.apply(m) - m)).y(), 2);
  }
  EXPECT_NEAR(std::sqrt(middle / 400.0) / 0.1e-3, 1.0, 0.1);   // 1200 numbers: a standard error of 2 %
  EXPECT_NEAR(std::sqrt(turn_z / 400.0) / 0.1e-3, 1.0, 0.15);  // 400: 3.5 %
}

TEST(ScannerFrame, IsRigidAndMapsBack) {
  ScannerSettings settings = wheel_settings(20'000);
  settings.random_frame = true;
  std::vector<Vec3> x_axes;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    settings.seed = seed;
    settings.points = seed == 1 ? 20'000 : 50;
    const VirtualScan scan = scan_surface(*ball_wheel(), settings);
    expect_rigid(scan.truth.X_CS);
    EXPECT_LE(scan.truth.X_CS.origin.norm(), 1.0);
    x_axes.emplace_back(scan.truth.X_CS.rotation.col(0));
    for (const Vec3& p : scan.cloud.points) {
      const Vec3 p_S = scan.truth.X_CS.apply_inverse(p);
      ASSERT_NEAR(p_S.norm(), kBallRadius, kPassExact);
      ASSERT_LE(std::fabs(p_S.y()), kBallRadius * std::sin(kBallAngle) + kPassExact);
    }
  }
  Vec3 mean = Vec3::Zero(), squares = Vec3::Zero();
  for (const Vec3& x : x_axes) {
    mean += x / 30.0;
    squares += x.cwiseProduct(x) / 30.0;
  }
  EXPECT_LT(mean.norm(), 0.5);  // even over the sphere: 1/sqrt(30) = 0.18 on average
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(squares[i], 1.0 / 3.0, 0.22);
}

TEST(ScannerFrame, MayBeGiven) {
  ScannerSettings settings = rail_settings(1'000);
  const VirtualScan plain = scan_surface(*round_rail(), settings);
  settings.X_CS = {Vec3(1.0, -2.0, 0.5), rotation({0.3, -0.4, 2.0})};
  const VirtualScan placed = scan_surface(*round_rail(), settings);
  ASSERT_EQ(placed.cloud.points.size(), plain.cloud.points.size());
  for (std::size_t i = 0; i < plain.cloud.points.size(); ++i)
    ASSERT_LT((settings.X_CS.apply(plain.cloud.points[i]) - placed.cloud.points[i]).norm(), kPassExact);
  EXPECT_EQ(placed.truth.X_CS.origin, settings.X_CS.origin);
}

}  // namespace
}  // namespace treadmark::scans
