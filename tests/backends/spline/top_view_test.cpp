// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/backends/spline/fit_profile.hpp"
#include "treadmark/backends/spline/top_view.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"

namespace treadmark::spline {
namespace {

// Extreme z over y among dense samples of the curve.
double sampled(const ProfileSpline& spline, double y, bool least) {
  constexpr int kSamples = 40000;
  double best = std::nan("");
  Vec2 a = spline.position(spline.begin());
  for (int i = 1; i <= kSamples; ++i) {
    const Vec2 b = spline.position(spline.begin() + (spline.end() - spline.begin()) * i / kSamples);
    if ((a.x() - y) * (b.x() - y) <= 0.0 && a.x() != b.x()) {
      const double z = a.y() + (b.y() - a.y()) * (y - a.x()) / (b.x() - a.x());
      if (std::isnan(best) || (least ? z < best : z > best)) best = z;
    }
    a = b;
  }
  return best;
}

TEST(TopView, ShowsTheBranchOfLeastZOfAnUndercutRail) {
  const ProfileSpline spline = fit_profile(testing::rail_head());
  const TopView view(spline, Body::rail);
  ASSERT_EQ(view.sections().size(), 1u);
  double y_max = 0.0;
  for (double s = spline.begin(); s < spline.end(); s += 1e-6) y_max = std::max(y_max, spline.position(s).x());
  EXPECT_NEAR(view.y_max(), y_max, 1e-9);
  EXPECT_NEAR(view.y_min(), -y_max, 1e-9);
  for (double y = -35e-3; y < 35.5e-3; y += 1.3e-3) {
    const double s = view.s_at(y);
    EXPECT_NEAR(spline.position(s).x(), y, 1e-15);
    EXPECT_NEAR(spline.position(s).y(), sampled(spline, y, true), 1e-6);
  }
  EXPECT_TRUE(std::isnan(view.s_at(40e-3)));
}

TEST(TopView, JumpsBetweenBranchesOfAFold) {
  // An S-shaped curve: y = t^3 - t, z = t (scaled).
  Profile p;
  p.name = "S";
  for (int i = 0; i <= 80; ++i) {
    const double t = -1.5 + 3.0 * i / 80;
    p.y.push_back(10e-3 * (t * t * t - t));
    p.z.push_back(10e-3 * t);
  }
  const ProfileSpline spline = fit_profile(p);
  for (const Body body : {Body::rail, Body::wheel}) {
    const TopView view(spline, body);
    EXPECT_EQ(view.sections().size(), 2u);
    for (double y = -18e-3; y < 18e-3; y += 0.7e-3)
      EXPECT_NEAR(spline.position(view.s_at(y)).y(), sampled(spline, y, body == Body::rail), 3e-6) << y;
  }
}

TEST(TopView, OfAWheelRunsBackwards) {
  const ProfileSpline spline = fit_profile(testing::flanged_wheel());
  const TopView view(spline, Body::wheel);
  ASSERT_EQ(view.sections().size(), 1u);
  EXPECT_FALSE(view.sections()[0].increasing);
  EXPECT_NEAR(view.y_min(), -70e-3, 1e-12);
  EXPECT_NEAR(spline.position(view.s_at(12.34e-3)).x(), 12.34e-3, 1e-15);
}

}  // namespace
}  // namespace treadmark::spline
