// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/wheels/wheel_ray.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/tests/backends/analytic/defect_formulas.hpp"

namespace treadmark::analytic {
namespace {

using testing::fade;
using testing::turn;

/// Flats deeper and steeper than those of trains, so that they decide what a line meets.
struct DeepFlat {
  double theta, y, length, depth, width;
};
const std::vector<DeepFlat> kFlats{{0.02, 6e-3, 0.03, 3e-3, 0.04}, {-0.05, -20e-3, 0.04, 2e-3, 0.03}};

/// Below 0 in the material, by docs/defects.md.
double outside(const WheelBody& body, const Vec3& p) {
  double depth = 0.0;
  for (const DeepFlat& f : kFlats)
    depth += f.depth * fade(body.nominal_radius * turn(std::atan2(p.x(), p.z()) - f.theta), f.length) *
             fade(p.y() - f.y, f.width);
  return std::hypot(p.x(), p.z()) - body.nominal_radius - body.curve.height(p.y(), body.curve.find(p.y(), 0)) + depth;
}

/// Lines so inclined that the flange may hide the tread, and flats either: the outermost hit of a fine march along each
/// of them. Where nothing but the interval search can decide, its bounds must hold the flats.
TEST(WheelRay, FindsTheOutermostHitOfInclinedLinesThroughFlats) {
  std::vector<WheelFlat> flats;
  for (const DeepFlat& f : kFlats)
    flats.push_back({WheelFlat::Shape::rounded, f.length, f.depth, f.theta, f.y, f.width});
  const WheelBody body(s1002_curve(), 0.46, flats);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> either(-1.0, 1.0);
  int searched = 0, in_flats = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const double roll = std::copysign(0.25 + 0.55 * std::fabs(either(random)), either(random));
    const Mat3 axes = rotation({roll, 0.2 * either(random), 0.0});
    const Vec3 n = axes.col(2), o(0.04 * either(random), -0.01 + 0.03 * either(random), 0.458);
    const auto at = [&](double t) { return outside(body, o + t * n); };
    const double limit_1 = (body.curve.y_min() - o.y()) / n.y(), limit_2 = (body.curve.y_max() - o.y()) / n.y();
    const double low = std::max(-0.03, std::min(limit_1, limit_2)), high = std::min(0.06, std::max(limit_1, limit_2));
    constexpr double kMarch = 1e-5;
    double found = std::numeric_limits<double>::quiet_NaN(), above = at(high);
    if (!(above > 0.0)) continue;  // it leaves the wheel through its end
    for (double t = high - kMarch; t > low; t -= kMarch) {
      if (at(t) > 0.0) continue;
      double a = t, b = t + kMarch;
      for (int k = 0; k < 60; ++k) (at(0.5 * (a + b)) > 0.0 ? b : a) = 0.5 * (a + b);
      found = 0.5 * (a + b);
      break;
    }
    if (std::isnan(found)) continue;
    WheelRay ray(body, n);
    WheelHit hit;
    ASSERT_TRUE(ray.cast(o, std::numeric_limits<double>::quiet_NaN(), hit)) << trial;
    EXPECT_NEAR(at(hit.t), 0.0, 1e-12) << trial;
    EXPECT_GT(hit.t, found - 1e-10) << trial << ": " << found;  // a march may step over what is thinner than a step
    EXPECT_LT(hit.t, found + 2e-4) << trial;
    searched += WheelRay::is_outermost(body, n, o.z() * n.x() - o.x() * n.z(), hit) ? 0 : 1;
    in_flats += hit.depth > 1e-4 ? 1 : 0;
  }
  EXPECT_GT(searched, 60);
  EXPECT_GT(in_flats, 200);
}

}  // namespace
}  // namespace treadmark::analytic
