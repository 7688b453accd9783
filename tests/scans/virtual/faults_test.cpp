// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Noise, outliers, holes, drop-outs and occlusion of a virtual scan.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "treadmark/scans/virtual/virtual_scanner.hpp"
#include "treadmark/tests/scans/virtual/sample_scans.hpp"

namespace treadmark::scans {
namespace {

using namespace scans::testing;

std::size_t seen(const ScannerTruth& t) {
  return t.on_surface + t.outliers + t.lost_holes + t.lost_drop_outs + t.lost_occlusion;
}
double part(std::size_t a, std::size_t b) { return static_cast<double>(a) / static_cast<double>(b); }

struct Moments {
  double sum = 0.0, squares = 0.0, fourth = 0.0, n = 0.0;
  void add(double x) {
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
    n += 1.0;
  }
  double mean() const { return sum / n; }
  double deviation() const { return std::sqrt(squares / n); }
  double kurtosis() const { return fourth / n / (squares / n * (squares / n)); }
};

TEST(ScannerNoise, HasItsLevelAlongAndAcrossTheBeam) {
  ScannerSettings settings = rail_settings(200'000);
  const auto rail = round_rail();
  const VirtualScan clean = scan_surface(*rail, settings);
  settings.noise = 20e-6;
  settings.noise_lateral = 50e-6;
  const VirtualScan noisy = scan_surface(*rail, settings);
  ASSERT_EQ(noisy.cloud.points.size(), clean.cloud.points.size());
  Moments along, across_x, across_y;
  for (std::size_t i = 0; i < noisy.cloud.points.size(); ++i) {
    const Vec3 &p = clean.cloud.points[i], d = noisy.cloud.points[i] - p;
    const Vec3 normal = Vec3(0.0, p.y(), p.z() - kHeadRadius) / kHeadRadius, across = normal.cross(Vec3::UnitX());
    along.add(d.dot(normal));
    across_x.add(d.x());
    across_y.add(d.dot(across));
  }
  const double n = along.n;  // tolerances: four standard errors
  EXPECT_NEAR(along.deviation() / 20e-6, 1.0, 4.0 / std::sqrt(2.0 * n));
  EXPECT_NEAR(across_x.deviation() / 50e-6, 1.0, 4.0 / std::sqrt(2.0 * n));
  EXPECT_NEAR(across_y.deviation() / 50e-6, 1.0, 4.0 / std::sqrt(2.0 * n));
  EXPECT_NEAR(along.mean(), 0.0, 4.0 * 20e-6 / std::sqrt(n));
  EXPECT_NEAR(along.kurtosis(), 3.0, 4.0 * std::sqrt(24.0 / n));
}

TEST(ScannerNoise, IsRadialOnAWheel) {
  ScannerSettings settings = wheel_settings(100'000);
  settings.noise = 30e-6;
  Moments along;
  for (const Vec3& p : scan_surface(*ball_wheel(), settings).cloud.points) along.add(p.norm() - kBallRadius);
  EXPECT_NEAR(along.deviation() / 30e-6, 1.0, 4.0 / std::sqrt(2.0 * along.n));
}

TEST(ScannerOutliers, AreAsManyAndOfTheKindsPromised) {
  ScannerSettings settings = rail_settings(300'000);
  settings.outliers = 0.05;
  const VirtualScan scan = scan_surface(*round_rail(), settings);
  const ScannerTruth& truth = scan.truth;
  ASSERT_EQ(scan.cloud.points.size(), truth.on_surface + truth.outliers);
  const double n = static_cast<double>(scan.cloud.points.size()), found = static_cast<double>(truth.outliers);
  EXPECT_NEAR(found / n, 0.05, 4.0 * std::sqrt(0.05 * 0.95 / n));
  std::size_t off = 0, along = 0, crowded = 0;
  std::vector<Vec3> far;
  for (const Vec3& p : scan.cloud.points) {
    const double d = std::fabs(off_rail(p));
    if (d <= 1e-9) continue;
    ++off;
    if (d <= 5e-3)
      ++along;
    else
      far.push_back(p);
    // surroundings: 50 mm round the surface
    const double deep = kHeadRadius * (1.0 - std::cos(kHeadAngle));
    EXPECT_LE(std::fabs(p.x()), kRailHalf + 0.0501);
    EXPECT_GE(p.z(), -0.0501);
    EXPECT_LE(p.z(), deep + 0.0501);
  }
  EXPECT_EQ(off, truth.outliers);
  EXPECT_NEAR(part(along, off), 0.5, 0.06);  // half, and those of the surroundings that happen to be near
  // brute force: a point of a dense blob has many others within 1.5 mm, one of the surroundings has hardly any
  for (const Vec3& p : far) {
    const auto near = std::count_if(far.begin(), far.end(), [&](const Vec3& q) { return (p - q).norm() < 1.5e-3; });
    if (near > 20) ++crowded;
  }
  EXPECT_NEAR(part(crowded, off), 0.25, 0.05);
}

class HoleShare : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Shares, HoleShare, ::testing::Values(0.005, 0.05, 0.3));

TEST_P(HoleShare, IsMet) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    ScannerSettings rail = rail_settings(200'000), wheel = wheel_settings(200'000);
    rail.holes = wheel.holes = GetParam();
    rail.seed = wheel.seed = seed;
    for (const ScannerTruth& t : {scan_surface(*round_rail(), rail).truth, scan_surface(*ball_wheel(), wheel).truth}) {
      EXPECT_NEAR(part(t.lost_holes, seen(t)), GetParam(), 0.1 * GetParam());
      EXPECT_EQ(t.lost_drop_outs + t.lost_occlusion + t.outliers, 0u);
    }
  }
}

TEST(ScannerHoles, AreEmptyRoundPlacesOfTheirSize) {
  ScannerSettings settings = rail_settings(200'000);
  const auto rail = round_rail();
  const VirtualScan whole = scan_surface(*rail, settings);
  settings.holes = 0.02;
  settings.hole_size = 8e-3;
  const VirtualScan scan = scan_surface(*rail, settings);
  // the points that are missing, in the unrolled plane
  std::vector<Vec2> lost;
  std::vector<Vec2> left;
  const auto unrolled = [](const Vec3& p) { return Vec2(p.x(), kHeadRadius * std::atan2(p.y(), kHeadRadius - p.z())); };
  std::size_t k = 0;
  for (const Vec3& p : whole.cloud.points)
    if (k < scan.cloud.points.size() && scan.cloud.points[k] == p) {
      left.push_back(unrolled(p));
      ++k;
    } else {
      lost.push_back(unrolled(p));
    }
  ASSERT_EQ(k, scan.cloud.points.size());
  ASSERT_EQ(lost.size(), scan.truth.lost_holes);
  // groups of lost points that hang together
  std::vector<int> group(lost.size(), -1);
  std::vector<double> area;
  for (std::size_t i = 0; i < lost.size(); ++i) {
    if (group[i] >= 0) continue;
    const int g = static_cast<int>(area.size());
    std::vector<std::size_t> open{i};
    group[i] = g;
    std::size_t count = 0;
    Vec2 low = lost[i], high = lost[i];
    while (!open.empty()) {
      const std::size_t a = open.back();
      open.pop_back();
      ++count;
      low = low.cwiseMin(lost[a]).eval();
      high = high.cwiseMax(lost[a]).eval();
      for (std::size_t b = 0; b < lost.size(); ++b)
        if (group[b] < 0 && (lost[a] - lost[b]).norm() < 3.0 * scan.truth.spacing) {
          group[b] = g;
          open.push_back(b);
        }
    }
    area.push_back(static_cast<double>(count) * scan.truth.spacing * scan.truth.spacing);
    // nothing is left in the middle half of the hole's box, unless two holes touch
    if (area.back() > 1.3e-4) continue;
    const Vec2 middle = 0.5 * (low + high), half = 0.5 * (high - low);
    for (const Vec2& p : left) EXPECT_FALSE(((p - middle).array().abs() < 0.3 * half.array()).all());
  }
  const double mean = std::accumulate(area.begin(), area.end(), 0.0) / static_cast<double>(area.size());
  // pi/4 D^2 times the mean square of 0.5 to 1.5 (1.083); some touch each other or the ends
  EXPECT_NEAR(mean / (0.25 * std::numbers::pi * 64e-6 * 13.0 / 12.0), 1.0, 0.4);
  EXPECT_GT(area.size(), 5u);
}

TEST(ScannerDropOuts, HaveTheirShareHalfOfItInRuns) {
  for (const double share : {0.02, 0.2, 0.6}) {
    ScannerSettings settings = rail_settings(200'000);
    const auto rail = round_rail();
    const VirtualScan whole = scan_surface(*rail, settings);
    settings.drop_outs = share;
    const VirtualScan scan = scan_surface(*rail, settings);
    const double n = static_cast<double>(seen(scan.truth));
    // runs of ten make chance ten times as strong
    EXPECT_NEAR(part(scan.truth.lost_drop_outs, seen(scan.truth)), share, 4.0 * std::sqrt(6.0 * share / n));
    EXPECT_EQ(whole.cloud.points.size(), seen(scan.truth));
    if (share > 0.1) continue;
    std::size_t k = 0, run = 0, in_runs = 0;
    for (const Vec3& p : whole.cloud.points) {
      if (k < scan.cloud.points.size() && scan.cloud.points[k] == p) {
        if (run >= 4) in_runs += run;
        run = 0;
        ++k;
      } else {
        ++run;
      }
    }
    EXPECT_NEAR(part(in_runs, scan.truth.lost_drop_outs), 0.5, 0.05);
  }
}

TEST(ScannerOcclusion, TakesExactlyWhatIsTooSteep) {
  ScannerSettings settings = rail_settings(100'000);
  const auto rail = round_rail();
  const VirtualScan whole = scan_surface(*rail, settings);
  settings.most_incidence = 0.7;
  const VirtualScan scan = scan_surface(*rail, settings);
  std::vector<Vec3> expected;
  for (const Vec3& p : whole.cloud.points)
    if (std::fabs(std::atan2(p.y(), kHeadRadius - p.z())) <= 0.7) expected.push_back(p);
  EXPECT_EQ(scan.cloud.points, expected);
  EXPECT_EQ(scan.truth.lost_occlusion, whole.cloud.points.size() - expected.size());
  EXPECT_GT(scan.truth.lost_occlusion, 30'000u);
}

TEST(ScannerOcclusion, OfAWheelIsSeenTowardsTheAxle) {
  ScannerSettings settings = wheel_settings(50'000);
  const auto wheel = ball_wheel();
  const VirtualScan whole = scan_surface(*wheel, settings);
  settings.most_incidence = 0.1;
  const VirtualScan scan = scan_surface(*wheel, settings);
  std::vector<Vec3> expected;
  for (const Vec3& p : whole.cloud.points)
    if (std::fabs(std::asin(p.y() / kBallRadius)) <= 0.1) expected.push_back(p);
  EXPECT_EQ(scan.cloud.points, expected);
}

}  // namespace
}  // namespace treadmark::scans
