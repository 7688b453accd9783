// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Height bounds against heights, over thousands of rectangles and planes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/tests/backends/analytic/milled_rails.hpp"

namespace treadmark::testing {
namespace {

struct Subject {
  const char* name;
  std::shared_ptr<const Surface> surface;
  double reach;  ///< a rectangle's middle is within +-reach along x, whole profile along y
  double radius;
  friend std::ostream& operator<<(std::ostream& out, const Subject& s) { return out << s.name; }
};

std::vector<WheelFlat> several_flats() {
  WheelFlat fresh;
  fresh.shape = WheelFlat::Shape::fresh;
  fresh.length = 0.05;
  fresh.theta_center = -0.1;
  fresh.y_center = 0.01;
  fresh.width = 0.04;
  return {{WheelFlat::Shape::rounded, 0.16, 1.4e-3, 0.0, 6e-3, 0.06},
          fresh,
          {WheelFlat::Shape::rounded, 0.03, 4e-4, 0.08, 0.0, 0.0}};
}

std::vector<Subject> subjects() {
  const auto rail = analytic::make_standard_surface({"60E1"}, Body::rail, 0.0);
  const auto big = analytic::make_prismatic_surface(MilledRail::rail());
  MillingPath narrow = MilledRail{false}.path();  // walls within the head
  narrow.start_y = 0.3 * narrow.start_y;
  narrow.start_angle = std::asin(narrow.start_y / MilledRail::kCutter);
  narrow.start_z = MilledRail::kCutter * (1.0 - std::cos(narrow.start_angle));
  narrow.section = {{-2.0 * MilledRail::kCutter * narrow.start_angle, 1.0 / MilledRail::kCutter}};
  const auto milled = [](const std::shared_ptr<const Surface>& base, const std::vector<MillingPath>& paths) {
    return analytic::add_defects(base, {.milling_paths = paths}, Body::rail, 0.0);
  };
  return {
      {"wheel", analytic::make_standard_surface({"S1002"}, Body::wheel, 0.46), 0.1, 0.46},
      {"wheel_with_flats", analytic::make_standard_surface({"S1002"}, Body::wheel, 0.46, several_flats()), 0.1, 0.46},
      {"ball", analytic::make_revolved_surface(analytic::barrel_chain(0.3, 0.2), 0.3), 0.1, 0.3},
      {"rail", rail, 0.2, 0.0},
      {"milled_rail", milled(big, {MilledRail{true}.path()}), 0.15, 0.0},
      {"twice_milled_rail", milled(rail, {MilledRail{true}.path(), MilledRail{false}.path()}), 0.15, 0.0},
      {"grooved_rail", milled(big, {narrow}), 0.1, 0.0}};
}

class HeightBoundsOf : public ::testing::TestWithParam<Subject> {
 protected:
  /// Compares random rectangles; the planes are inclined by about `tilt` in all directions.
  void compare(double tilt, int trials, double& hits, double& excess) const {
    const Subject& s = GetParam();
    const bool wheel = s.radius > 0.0;
    constexpr int kPoints = 9;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> either(-1.0, 1.0);
    hits = excess = 0.0;
    std::vector<double> z(kPoints * kPoints);
    for (int trial = 0; trial < trials; ++trial) {
      const double theta = wheel ? 0.15 * either(random) : 0.0;
      const Vec3 origin(s.radius * std::sin(theta), 0.02 * either(random),
                        s.radius * std::cos(theta) + 0.01 * either(random));
      const Pose X{origin,
                   rotation({tilt * either(random), 0.3 * tilt * either(random), theta + 0.3 * tilt * either(random)})};
      const double width = std::pow(10.0, -4.5 + 3.0 * std::fabs(either(random))),
                   height = std::pow(10.0, -4.5 + 3.0 * std::fabs(either(random)));
      const double x = s.reach * either(random), y = 0.07 * either(random);
      const HeightBounds bounds = s.surface->height_bounds(X, {x, x + width, y, y + height});
      const Grid2 g{x, y, width / (kPoints - 1), height / (kPoints - 1), kPoints, kPoints};
      s.surface->heights({X, g}, {z, {}, {}});
      double low = std::numeric_limits<double>::infinity(), high = -low;
      bool all = true;
      for (const double one : z) {
        if (std::isnan(one)) {
          all = false;
          continue;
        }
        ASSERT_FALSE(bounds.empty) << "trial " << trial;
        ASSERT_GE(one, bounds.z_min - 1e-11) << "trial " << trial;
        ASSERT_LE(one, bounds.z_max + 1e-11) << "trial " << trial;
        low = std::min(low, one);
        high = std::max(high, one);
      }
      if (!all) continue;
      ++hits;
      const double more = wheel ? bounds.z_max - high : low - bounds.z_min;
      if (more > 0.2 * (high - low) + 0.5 * (width + height) + 1e-5) ++excess;
    }
  }
};

TEST_P(HeightBoundsOf, HoldAllHeightsOverNearlyLevelPlanes) {
  double hits = 0.0, excess = 0.0;
  compare(0.1, 4000, hits, excess);
  EXPECT_GT(hits, 400);
  EXPECT_LE(excess, 0.02 * hits);
}

TEST_P(HeightBoundsOf, HoldAllHeightsOverInclinedPlanes) {
  double hits = 0.0, excess = 0.0;
  compare(1.2, 4000, hits, excess);
  EXPECT_GT(hits, 200);
  EXPECT_LE(excess, 0.1 * hits);
}

INSTANTIATE_TEST_SUITE_P(Analytic, HeightBoundsOf, ::testing::ValuesIn(subjects()),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(HeightBoundsOfWheels, FindTheHorizonAndNothingBesideIt) {
  const auto wheel = analytic::make_standard_surface({"S1002"}, Body::wheel, 0.46, several_flats());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> either(-1.0, 1.0);
  int seen = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Pose X{{0.0, 0.0, 0.0}, rotation({0.3 * either(random), 0.2 * either(random), 3.0 * either(random)})};
    const double x = 0.5 * either(random), y = 0.08 * either(random);
    const HeightBounds bounds = wheel->height_bounds(X, {x, x + 1e-3, y, y + 2e-3});
    for (const double u : {0.0, 0.5e-3, 1e-3})
      for (const double v : {0.0, 1e-3, 2e-3}) {
        const double z = height_at(*wheel, X, {x + u, y + v});
        if (std::isnan(z)) continue;
        ++seen;
        ASSERT_FALSE(bounds.empty);
        ASSERT_GE(z, bounds.z_min - 1e-11);
        ASSERT_LE(z, bounds.z_max + 1e-11);
      }
  }
  EXPECT_GT(seen, 3000);
  EXPECT_TRUE(wheel->height_bounds({}, {0.0, 0.01, 0.07, 0.08}).empty);
  EXPECT_TRUE(wheel->height_bounds({}, {0.52, 0.53, 0.0, 0.01}).empty);
  EXPECT_TRUE(wheel->height_bounds({{0.0, 0.0, 0.0}, rotation_x(std::acos(0.0))}, {-0.01, 0.01, 0.0, 0.01}).empty);
}

}  // namespace
}  // namespace treadmark::testing
