// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// A scanner that stands somewhere sees what nothing of the surface hides.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/scans/virtual/virtual_scanner.hpp"
#include "treadmark/tests/scans/virtual/sample_scans.hpp"

namespace treadmark::scans {
namespace {

using namespace scans::testing;

constexpr double kHill = 0.03, kHillTurn = 0.9;  // radius [m] of arcs, half the angle of each
const double kHalfHill = kHill * std::sin(kHillTurn);

/// Two hills with a valley between them.
std::shared_ptr<const Surface> hills() {
  const double length = 2.0 * kHillTurn * kHill;
  return analytic::make_prismatic_surface({-3.0 * kHalfHill,
                                           kHill * (1.0 - std::cos(kHillTurn)),
                                           -kHillTurn,
                                           {{length, 1.0 / kHill}, {length, -1.0 / kHill}, {length, 1.0 / kHill}}});
}
/// How deep a place is below them; negative above.
double below_hills(const Vec3& p) {
  if (std::fabs(p.y()) > 3.0 * kHalfHill) return -kInfinity;
  const double y = std::fabs(p.y()) < kHalfHill ? p.y() : std::fabs(p.y()) - 2.0 * kHalfHill;
  const double arc = kHill - std::sqrt(kHill * kHill - y * y);
  const double z = std::fabs(p.y()) < kHalfHill ? 2.0 * kHill * (1.0 - std::cos(kHillTurn)) - arc : arc;
  return p.z() - z;
}

/// The greatest depth along a beam, but for its first tenth of a millimetre.
template <class Depth>
double deepest(const Depth& depth, const Vec3& from, const Vec3& to) {
  constexpr int kSteps = 600;
  constexpr double kFrom = 1e-4;
  const double length = (to - from).norm();
  double worst = -kInfinity;
  for (int i = 0; i <= kSteps; ++i) {
    const double at = kFrom + (length - kFrom) * i / kSteps;
    worst = std::max(worst, depth(from + at / length * (to - from)));
  }
  return worst;
}

/// Holds which points are lost to how deep the beams to the others and to these lie; lost: at least so many.
template <class Depth>
void expect_shadows(const Surface& surface, ScannerSettings settings, const Vec3& stand, const Depth& depth,
                    std::size_t lost) {
  constexpr double kOutside = -5e-6, kInside = 1e-5;  // between them a step of the beam does not tell
  const VirtualScan whole = scan_surface(surface, settings);
  settings.stands = {stand};
  const VirtualScan scan = scan_surface(surface, settings);
  std::size_t k = 0, hidden = 0, doubtful = 0;
  for (const Vec3& p : whole.cloud.points) {
    const bool seen = k < scan.cloud.points.size() && scan.cloud.points[k] == p;
    k += seen ? 1 : 0;
    hidden += seen ? 0 : 1;
    const double deep = deepest(depth, p, stand);
    if (deep > kOutside && deep < kInside) {
      ++doubtful;
      continue;
    }
    ASSERT_EQ(seen, deep < 0.0) << p.transpose() << ": " << deep;
  }
  EXPECT_EQ(k, scan.cloud.points.size());
  EXPECT_EQ(hidden, scan.truth.lost_shadow);
  EXPECT_GT(hidden, lost);
  EXPECT_GT(k, lost);
  EXPECT_LT(doubtful, whole.cloud.points.size() / 20);
}

ScannerSettings hill_settings(std::size_t points) {
  ScannerSettings s;
  s.u_min = -0.05;
  s.u_max = 0.05;
  s.points = points;
  return s;
}
const Vec3 kLeft(0.02, -0.25, -0.1), kRight(0.0, 0.25, -0.1);

TEST(ScannerShadows, LieBehindAHill) { expect_shadows(*hills(), hill_settings(20'000), kLeft, below_hills, 2000); }

TEST(ScannerShadows, LieBehindTheFlangeOfAWheel) {
  constexpr double kRadius = 0.46, kStep = 5e-5, kWide = 0.08;
  const auto wheel = analytic::make_standard_surface({"S1002"}, Body::wheel, kRadius);
  std::vector<double> y, r;
  for (double at = -kWide; at <= kWide; at += kStep) y.push_back(at);
  r.resize(y.size());
  section_heights(*wheel, Body::wheel, 0.0, y, {r, {}, {}});
  const auto depth = [&](const Vec3& p) {
    const double at = (p.y() + kWide) / kStep;
    if (!(at >= 0.0 && at < static_cast<double>(y.size() - 1))) return -kInfinity;
    const auto i = static_cast<std::size_t>(at);
    const double share = at - static_cast<double>(i), radius = (1.0 - share) * r[i] + share * r[i + 1];
    return std::isnan(radius) ? -kInfinity : radius - std::hypot(p.x(), p.z());
  };
  ScannerSettings settings = wheel_settings(20'000);
  settings.u_min = -0.15;
  settings.u_max = 0.15;
  expect_shadows(*wheel, settings, {0.05, -0.25, 0.75}, depth, 1000);
}

TEST(ScannerShadows, EachPlaceIsAPass) {
  const auto surface = hills();
  ScannerSettings one = hill_settings(5'000), two = hill_settings(10'000);
  one.stands = {kLeft};
  two.stands = {kLeft, kRight};
  const VirtualScan left = scan_surface(*surface, one), both = scan_surface(*surface, two);
  const std::size_t n = left.cloud.points.size();
  ASSERT_EQ(both.truth.passes.size(), 2u);
  ASSERT_GT(both.cloud.points.size(), n);
  EXPECT_EQ(both.truth.passes[0].points, n);
  EXPECT_TRUE(std::equal(left.cloud.points.begin(), left.cloud.points.end(), both.cloud.points.begin()));
  EXPECT_EQ(both.cloud.passes.front(), 0);
  EXPECT_EQ(both.cloud.passes.back(), 1);
  // what one does not see of the valley the other one does
  const auto in_valley = [](const VirtualScan& scan, std::uint16_t pass, bool left_half) {
    return std::count_if(scan.cloud.points.begin(), scan.cloud.points.end(), [&](const Vec3& p) {
      const auto i = static_cast<std::size_t>(&p - scan.cloud.points.data());
      return scan.cloud.passes[i] == pass && std::fabs(p.y()) < kHalfHill && (p.y() < 0.0) == left_half;
    });
  };
  EXPECT_GT(in_valley(both, 0, false), in_valley(both, 0, true) + 200);
  EXPECT_GT(in_valley(both, 1, true), in_valley(both, 1, false) + 200);
}

/// Of a round rail all is seen whose outside shows, at no more than the angle asked for.
TEST(ScannerShadows, NoiseAndIncidenceAreThoseOfTheBeam) {
  constexpr double kMostIncidence = 1.1;
  const auto rail = round_rail();
  ScannerSettings settings = rail_settings(20'000);
  const VirtualScan whole = scan_surface(*rail, settings);
  settings.stands = {Vec3(0.1, 0.3, -0.2)};
  const auto cosine = [&](const Vec3& p) {
    const Vec3 normal(0.0, p.y() / kHeadRadius, p.z() / kHeadRadius - 1.0);
    return normal.dot((settings.stands[0] - p).normalized());
  };
  const auto seen_at = [&](double least) {
    std::vector<Vec3> seen;
    for (const Vec3& p : whole.cloud.points)
      if (cosine(p) >= least) seen.push_back(p);
    return seen;
  };
  const VirtualScan clean = scan_surface(*rail, settings);
  EXPECT_EQ(clean.cloud.points, seen_at(0.0));
  settings.noise = 20e-6;
  const VirtualScan noisy = scan_surface(*rail, settings);
  ASSERT_EQ(noisy.cloud.points.size(), clean.cloud.points.size());
  double squares = 0.0;
  for (std::size_t i = 0; i < noisy.cloud.points.size(); ++i) {
    const Vec3 &p = clean.cloud.points[i], off = noisy.cloud.points[i] - p;
    ASSERT_LT(off.cross((settings.stands[0] - p).normalized()).norm(), 1e-12);
    squares += off.squaredNorm();
  }
  const double n = static_cast<double>(noisy.cloud.points.size());
  EXPECT_NEAR(std::sqrt(squares / n) / 20e-6, 1.0, 4.0 / std::sqrt(2.0 * n));
  settings.noise = 0.0;
  settings.most_incidence = kMostIncidence;
  const VirtualScan steep = scan_surface(*rail, settings);
  EXPECT_EQ(steep.cloud.points, seen_at(std::cos(kMostIncidence)));
  EXPECT_EQ(steep.truth.lost_shadow, 0u);
}

TEST(ScannerShadows, AScannerInAHollowIsRefused) {
  ScannerSettings settings = hill_settings(1'000);
  settings.stands = {Vec3(0.0, 0.0, 0.004)};
  try {
    scan_surface(*hills(), settings);
    ADD_FAILURE() << "accepted";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("behind the scanner at (0, 0, 4) mm"));
  }
}

}  // namespace
}  // namespace treadmark::scans
