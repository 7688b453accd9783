// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/sections/find_sections.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/scans/placement/band_frame.hpp"
#include "treadmark/tests/scans/support/simple_cloud.hpp"

namespace treadmark::scans {
namespace {

using tests::some_frame;
constexpr double kPi = std::numbers::pi, kRadius = 0.45;

struct Gauge {
  Body body = Body::wheel;
  std::vector<double> u;
  int points = 40;
  double jitter_y = 0.0;  // [m]
  double jitter_u = 0.0;  // [m] along the band
  bool upright_flank = true;
};

/// A section that goes across 0.1 m and then up an upright flank of 20 mm, the same at every station but for a wave.
std::vector<Natural> gauge(const Gauge& how, std::uint64_t seed) {
  Random random(seed);
  std::vector<Natural> out;
  for (const double u : how.u)
    for (int k = 0; k < how.points; ++k) {
      const double s =
          (how.upright_flank ? 0.12 : 0.1) * k / (how.points - 1) + how.jitter_y * (random.uniform() - 0.5);
      const double wave = 1e-3 * std::sin(3.0 * u), level = how.body == Body::wheel ? kRadius : 0.0;
      const double y = s < 0.1 ? 0.05 - s : -0.05, v = level + wave + (s < 0.1 ? 0.0 : s - 0.1);
      const double along = how.jitter_u * (random.uniform() - 0.5);
      out.push_back({how.body == Body::wheel ? u + along / kRadius : u + along, y, v});
    }
  return out;
}

std::vector<Vec3> cloud(Body body, const std::vector<Natural>& points, const Pose& X_CS) {
  std::vector<Vec3> out;
  for (const Natural& n : points) out.push_back(X_CS.apply(from_natural(body, n)));
  return out;
}

void shuffle(std::vector<Vec3>& points, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = points.size(); i > 1; --i)
    std::swap(points[i - 1],
              points[std::min(i - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(i)))]);
}

std::vector<double> stations(double first, double last, int count) {
  std::vector<double> out;
  for (int k = 0; k < count; ++k) out.push_back(first + (last - first) * k / (count - 1));
  return out;
}

TEST(FindSections, GivesBackASlicedWheelFromShuffledPoints) {
  // uneven stations, one of them on both sides of the half turn as its points scatter
  Gauge how;
  how.u = stations(-0.1, 0.1, 60);
  for (const double u : stations(0.2, 2.0 * kPi - 0.2, 70)) how.u.push_back(u);
  how.u.push_back(kPi);
  std::sort(how.u.begin(), how.u.end());
  how.u.erase(
      std::remove_if(how.u.begin(), how.u.end(), [](double u) { return u != kPi && std::fabs(u - kPi) < 0.03; }),
      how.u.end());
  how.jitter_u = 1e-6;
  const Pose X_CS = some_frame(3);
  std::vector<Vec3> points = cloud(Body::wheel, gauge(how, 5), X_CS);
  shuffle(points, 7);
  const auto found = find_sections(points, {}, X_CS, Body::wheel, kRadius);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->u.size(), how.u.size());
  EXPECT_TRUE(found->regular);
  EXPECT_LT(found->spread, 1.01e-6);
  const SliceSet slices = sections_to_slices(*found, points, X_CS, Body::wheel, kRadius, true, "gauge");
  ASSERT_EQ(slices.u.size(), how.u.size());
  EXPECT_TRUE(slices.approximate_u);
  for (std::size_t k = 0; k + 1 < slices.u.size(); ++k) EXPECT_LT(slices.u[k], slices.u[k + 1]);
  for (std::size_t k = 0; k < slices.u.size(); ++k) {
    const Profile& p = slices.profiles[k];
    ASSERT_EQ(p.y.size(), 40u);
    // wheel profiles run from the field side to the flange, up the flank at its end
    EXPECT_NEAR(p.y.front(), 0.05, 1e-9);
    EXPECT_NEAR(p.y.back(), -0.05, 1e-9);
    EXPECT_NEAR(p.z.back(), 1e-3 * std::sin(3.0 * slices.u[k]) + 0.02, 1e-8);
    for (std::size_t i = 0; i + 1 < p.z.size(); ++i) EXPECT_GT(p.z[i + 1], p.z[i] - 1e-9);
  }
}

TEST(FindSections, RailProfilesRunTheOtherWayAndKeepTheirOwnPlaces) {
  Gauge how;
  how.body = Body::rail;
  how.u = stations(0.3, 0.9, 25);
  how.jitter_y = 1e-3;
  const Pose X_CS = some_frame(4);
  std::vector<Vec3> points = cloud(Body::rail, gauge(how, 6), X_CS);
  const auto found = find_sections(points, {}, X_CS, Body::rail, 0.0);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->regular);
  EXPECT_NEAR(found->least_gap, 0.025, 1e-9);
  EXPECT_NEAR(found->widest_gap, 0.025, 1e-9);
  const SliceSet slices = sections_to_slices(*found, points, X_CS, Body::rail, 0.0, false, "gauge");
  for (const Profile& p : slices.profiles) EXPECT_LT(p.y.front(), p.y.back());
}

TEST(FindSections, LeavesOutWhatIsNotKept) {
  Gauge how;
  how.u = stations(-1.0, 1.0, 30);
  const Pose X_CS = some_frame(8);
  std::vector<Vec3> points = cloud(Body::wheel, gauge(how, 5), X_CS);
  std::vector<std::uint8_t> keep(points.size(), 1);
  const double between = 0.5 * (how.u[4] + how.u[5]);
  points.push_back(X_CS.apply(from_natural(Body::wheel, {between, 0.0, kRadius})));
  keep.push_back(1);
  EXPECT_FALSE(find_sections(points, keep, X_CS, Body::wheel, kRadius)) << "a point in no section";
  keep.back() = 0;
  EXPECT_TRUE(find_sections(points, keep, X_CS, Body::wheel, kRadius));
}

TEST(FindSections, NoneWhereThereAreNone) {
  const Pose X_CS = some_frame(9);
  // anywhere along the band
  Gauge how;
  how.u.assign(100, 0.0);
  Random random(2);
  std::vector<Natural> anywhere = gauge(how, 3);
  for (Natural& n : anywhere) n.u = 2.0 * kPi * random.uniform() - kPi;
  EXPECT_FALSE(find_sections(cloud(Body::wheel, anywhere, X_CS), {}, X_CS, Body::wheel, kRadius));
  // sections that scatter by a tenth of their distance
  how.u = stations(-1.0, 1.0, 30);
  how.jitter_u = 0.2 * kRadius * (how.u[1] - how.u[0]);
  EXPECT_FALSE(find_sections(cloud(Body::wheel, gauge(how, 5), X_CS), {}, X_CS, Body::wheel, kRadius));
  // three sections, and sections of few points
  how.jitter_u = 0.0;
  how.u = stations(-0.1, 0.1, 3);
  EXPECT_FALSE(find_sections(cloud(Body::wheel, gauge(how, 5), X_CS), {}, X_CS, Body::wheel, kRadius));
  how.u = stations(-0.1, 0.1, 20);
  how.points = 6;
  EXPECT_FALSE(find_sections(cloud(Body::wheel, gauge(how, 5), X_CS), {}, X_CS, Body::wheel, kRadius));
  // a section with a part of it missing has no way through without a jump
  how.points = 40;
  std::vector<Natural> torn = gauge(how, 5);
  torn.erase(torn.begin() + 405, torn.begin() + 425);
  EXPECT_FALSE(find_sections(cloud(Body::wheel, torn, X_CS), {}, X_CS, Body::wheel, kRadius));
  EXPECT_FALSE(find_sections({}, {}, X_CS, Body::wheel, kRadius));
}

}  // namespace
}  // namespace treadmark::scans
