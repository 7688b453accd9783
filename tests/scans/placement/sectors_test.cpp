// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Parts of the circumference of a wheel, scanned in lines or at random places.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/scans/placement/place.hpp"
#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

using ::testing::HasSubstr;
using tests::kPi;

constexpr double kRunningRadius = 0.46, kNoise = 20e-6;

struct Sector {
  double arc = 0.7;       // [rad]
  double spacing = 2e-3;  // [m]
  bool lines = false;
  double noise = kNoise;
};

/// S1002 from the back of its flange to 60 mm, by arc length, about y.
std::vector<Vec3> points_of(const Sector& sector, const Section& section, const Pose& X, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> out;
  const auto add = [&](double u, double s) {
    const Section::Point at = section.at(s);
    const Vec2 p = at.position + sector.noise * tests::gaussian(random) * at.normal;
    const double r = kRunningRadius + p.y();
    out.push_back(X.apply(Vec3(r * std::sin(u), p.x(), r * std::cos(u))));
  };
  const double s_max = section.s_at(60e-3), length = sector.arc * kRunningRadius;
  if (sector.lines) {
    const int lines = static_cast<int>(length / sector.spacing), points = static_cast<int>(s_max / sector.spacing);
    for (int i = 0; i <= lines; ++i)
      for (int k = 0; k < points; ++k)
        add(sector.arc * (static_cast<double>(i) / lines - 0.5), (k + random.uniform()) * sector.spacing);
  } else {
    const int count = static_cast<int>(length * s_max / (sector.spacing * sector.spacing));
    for (int i = 0; i < count; ++i) {
      const double u = sector.arc * (random.uniform() - 0.5);
      add(u, s_max * random.uniform());
    }
  }
  return out;
}

class Sectors : public ::testing::Test {
 protected:
  Placement placed(const std::vector<Vec3>& points, std::optional<double> radius = {}) const {
    PlaceSettings settings;
    settings.body = Body::wheel;
    settings.nominal = nominal;
    settings.radius = radius;
    return place(points, {}, find_roughly(points, {}, Body::wheel), settings);
  }

  Section nominal{tests::nominal_points("S1002", Body::wheel)};
};

/// What is wrong with the axle: its direction, and its distance from the true one beside the middle of the arc.
struct Wrong {
  double direction = 0.0, radius = 0.0, along = 0.0;
};
Wrong wrong(const Placement& found, const Pose& X) {
  const Vec3 a = found.X_CS.rotation.col(1), b = X.rotation.col(1);
  return {a.cross(b).norm() + (a.dot(b) < 0.0 ? 10.0 : 0.0), found.nominal_radius - kRunningRadius,
          b.dot(found.X_CS.origin - X.origin)};
}

TEST_F(Sectors, AreFoundAsWellAsTheySay) {
  int known = 0, within_two = 0;
  for (const auto& [degrees, spacing] : {std::pair{20.0, 1.5e-3},
                                         {20.0, 3e-3},
                                         {20.0, 4e-3},
                                         {30.0, 2e-3},
                                         {30.0, 4e-3},
                                         {40.0, 1.5e-3},
                                         {40.0, 2.5e-3},
                                         {40.0, 4e-3},
                                         {60.0, 2e-3},
                                         {60.0, 4e-3},
                                         {90.0, 2e-3},
                                         {90.0, 4e-3},
                                         {120.0, 4e-3},
                                         {180.0, 4e-3}})
    for (const bool lines : {false, true}) {
      const auto seed = static_cast<std::uint64_t>(100.0 * degrees + 1e5 * spacing + (lines ? 1 : 0));
      const Pose X = tests::some_frame(seed);
      const auto points = points_of({degrees * kPi / 180.0, spacing, lines}, nominal, X, seed);
      const std::string what = fmt::format("{} degrees, {} mm, {}", degrees, 1e3 * spacing, lines ? "lines" : "random");
      const Placement found = placed(points);
      const Wrong off = wrong(found, X);
      ++known;
      within_two += std::fabs(off.radius) < 2.0 * found.radius_error ? 1 : 0;
      EXPECT_LT(std::fabs(off.radius), 4.0 * found.radius_error) << what;
      EXPECT_LT(off.direction, 4.0 * found.direction_error) << what;
      EXPECT_LT(std::fabs(off.along), 0.1e-3) << what;
      // what circles of that length tell at best: sigma / sqrt(n) over the standard deviation of the cosine
      const double half = 0.5 * degrees * kPi / 180.0, mean = std::sin(half) / half,
                   cosine = std::sqrt(0.5 + std::sin(2.0 * half) / (4.0 * half) - mean * mean);
      const double best = kNoise / std::sqrt(static_cast<double>(points.size())) / cosine;
      EXPECT_LT(found.radius_error, 3.0 * best) << what;
      EXPECT_GT(found.radius_error, 0.9 * best) << what;
    }
  EXPECT_GE(within_two, 85 * known / 100) << "of " << known;
}

TEST_F(Sectors, AKnownRadiusHelpsWhereTheArcIsShort) {
  const Pose X = tests::some_frame(12);
  const auto points = points_of({20.0 * kPi / 180.0, 3e-3, true}, nominal, X, 12);
  const Placement alone = placed(points), helped = placed(points, kRunningRadius);
  EXPECT_GT(alone.radius_error, 0.1e-3);
  EXPECT_LT(helped.radius_error, 0.05e-3);
  EXPECT_LT(std::fabs(wrong(helped, X).radius), 0.1e-3);
  EXPECT_LT(wrong(helped, X).direction, 0.2e-3);
  // one that the points contradict says nothing of the axle
  const Placement other = placed(points, 0.455);
  EXPECT_EQ(other.radius_error, alone.radius_error);
  // too short to say anything, but for that
  const auto shorter = points_of({9.0 * kPi / 180.0, 2e-3, true}, nominal, X, 13);
  const auto error = tests::error_of([&] { placed(shorter); });
  ASSERT_TRUE(error);
  EXPECT_THAT(error->message(), HasSubstr("9 degrees is too short to find the axle"));
  EXPECT_THAT(error->advice(), HasSubstr("placement.nominal_radius_mm"));
  EXPECT_LT(std::fabs(wrong(placed(shorter, kRunningRadius), X).radius), 0.15e-3);
}

TEST_F(Sectors, AWornWheelKeepsItsOwnSection) {
  // a tread hollow by 2 mm: the nominal section must not turn the axle
  const Pose X = tests::some_frame(14);
  std::vector<Vec2> worn;
  for (const Vec2& p : tests::nominal_points("S1002", Body::wheel)) {
    const double y = p.x() - 5e-3, half = 25e-3;
    worn.emplace_back(p.x(), p.y() - (std::fabs(y) < half ? 1e-3 * (1.0 + std::cos(kPi * y / half)) : 0.0));
  }
  const auto points = points_of({50.0 * kPi / 180.0, 2e-3, false}, Section(worn), X, 14);
  const Placement found = placed(points);
  EXPECT_LT(wrong(found, X).direction, 4.0 * found.direction_error);
  EXPECT_LT(std::fabs(wrong(found, X).radius), 4.0 * found.radius_error);
}

}  // namespace
}  // namespace treadmark::scans
