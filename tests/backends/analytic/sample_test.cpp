// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::analytic {
namespace {

TEST(Sampling, S1002PointsLieOnTheSurfaceAtTheStepAsked) {
  const Profile p = sample_profile(StandardProfile{"S1002"}, 0.5e-3);
  EXPECT_EQ(p.body, Body::wheel);
  EXPECT_EQ(p.y.front(), 0.060);
  EXPECT_EQ(p.y.back(), -0.070);
  const auto wheel = make_standard_surface({"S1002"}, Body::wheel, 0.46);
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    if (i > 0) {
      EXPECT_LT(p.y[i], p.y[i - 1]);
      const double step = std::hypot(p.y[i] - p.y[i - 1], p.z[i] - p.z[i - 1]);
      EXPECT_LT(step, 0.5001e-3);
      EXPECT_GT(step, 0.2e-3);
    }
    const double z = height_at(*wheel, {{0.0, 0.0, 0.46}, Mat3::Identity()}, {0.0, p.y[i]});
    EXPECT_NEAR(z, p.z[i], 1.3e-7) << p.y[i];  // a joint belongs to one of two pieces 0.12 um apart
  }
}

TEST(Sampling, RailPointsRunWithIncreasingY) {
  const Profile p = sample_profile(StandardProfile{"60E1"}, 0.5e-3);
  EXPECT_EQ(p.body, Body::rail);
  const auto rail = make_standard_surface({"60E1"}, Body::rail, 0.0);
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    if (i > 0) {
      EXPECT_GT(p.y[i], p.y[i - 1]);
    }
    if (i > 0 && i + 1 < p.y.size()) {
      EXPECT_NEAR(height_at(*rail, {}, {0.0, p.y[i]}), p.z[i], 1e-13);  // slope 20 on the sides
    }
  }
}

TEST(Sampling, SlicesCarryTheFlatAndAreFineOnlyThere) {
  WheelFlat flat;
  flat.length = 0.06;
  flat.depth = 1e-3;
  flat.theta_center = -0.5;
  const Profile profile = sample_profile(straight_chain(0.05), Body::wheel, 5e-3);
  const SliceSet slices = sample_wheel(profile, 0.46, {flat}, 1e-3, 0.02);
  ASSERT_EQ(slices.u.size(), slices.profiles.size());
  EXPECT_DOUBLE_EQ(slices.u.front(), -std::numbers::pi);
  EXPECT_DOUBLE_EQ(slices.u.back(), std::numbers::pi);
  for (std::size_t i = 0; i < slices.u.size(); ++i) {
    const double x = 0.46 * (slices.u[i] + 0.5);
    const double depth = std::fabs(x) < 0.03 ? 0.5e-3 * (1.0 + std::cos(2.0 * std::numbers::pi * x / 0.06)) : 0.0;
    EXPECT_NEAR(slices.profiles[i].z[3], -depth, 1e-15);
    if (i == 0) continue;
    const double step = slices.u[i] - slices.u[i - 1];
    EXPECT_GT(step, 1e-3);
    EXPECT_LE(step, std::fabs(x) < 0.03 ? 1e-3 / 0.46 : 0.02);
  }
  EXPECT_LT(slices.u.size(), 700u);
}

TEST(Sampling, RefusesAStepThatIsNotPositive) {
  EXPECT_THROW(sample_profile(StandardProfile{"S1002"}, 0.0), Error);
  EXPECT_THROW(sample_profile(StandardProfile{"nothing"}, 1e-3), Error);
  EXPECT_THROW(sample_wheel({}, 0.0, {}, 1e-3), Error);
}

}  // namespace
}  // namespace treadmark::analytic
