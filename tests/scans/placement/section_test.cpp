// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/section.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

using tests::kPi;

/// The flanged section as a polyline with edges of 3 um, with its length up to every corner.
class Dense {
 public:
  Dense() {
    constexpr int kCount = 40'000;
    for (int k = 0; k <= kCount; ++k) {
      const double y = -65e-3 + 125e-3 * k / kCount;
      corner_.emplace_back(y, tests::flanged(y));
      arc_.push_back(k == 0 ? 0.0 : arc_.back() + (corner_[corner_.size() - 1] - corner_[corner_.size() - 2]).norm());
    }
  }
  struct Nearest {
    double distance = 1e300, s = 0.0;
    Vec2 at;
    bool end = false;
  };
  Nearest nearest(const Vec2& p) const {
    Nearest out;
    for (std::size_t k = 0; k + 1 < corner_.size(); ++k) {
      const Vec2 edge = corner_[k + 1] - corner_[k];
      const double t = std::clamp(edge.dot(p - corner_[k]) / edge.squaredNorm(), 0.0, 1.0);
      const double distance = (p - corner_[k] - t * edge).norm();
      if (distance < out.distance) out = {distance, arc_[k] + t * edge.norm(), corner_[k] + t * edge, false};
    }
    out.end = out.s < 10e-6 || out.s > arc_.back() - 10e-6;
    return out;
  }
  double length() const { return arc_.back(); }

 private:
  std::vector<Vec2> corner_;
  std::vector<double> arc_;
};

TEST(Section, FeetAreThoseOfBruteForce) {
  const Section section(tests::flanged_points());
  const Dense dense;
  EXPECT_NEAR(section.length(), dense.length(), 1e-8);
  constexpr double kFarthest = 8e-3;
  Random random(1);
  int feet = 0, ends = 0, far = 0;
  for (int k = 0; k < 600; ++k) {
    // at most a little beyond the ends, mostly near the curve, on either side of it
    const double y = -70e-3 + 135e-3 * random.uniform();
    const Vec2 p(y, tests::flanged(y) + (k % 3 == 0 ? 40e-3 : 4e-3) * (random.uniform() - 0.5));
    const Dense::Nearest expected = dense.nearest(p);
    const auto foot = section.foot(p, kFarthest);
    if (expected.end) {
      EXPECT_FALSE(foot) << p.transpose();
      ++ends;
    } else if (expected.distance > kFarthest) {
      EXPECT_FALSE(foot) << p.transpose();
      ++far;
    } else {
      ASSERT_TRUE(foot) << p.transpose() << " distance " << expected.distance;
      const bool outside = p.y() > tests::flanged(p.x());
      EXPECT_NEAR(foot->distance, outside ? expected.distance : -expected.distance, 1e-8) << p.transpose();
      // beside a centre of curvature two feet are nearly as near
      EXPECT_NEAR(foot->s, expected.s, 5e-6) << p.transpose();
      EXPECT_LT((section.at(foot->s).position - expected.at).norm(), 5e-6) << p.transpose();
      ++feet;
    }
  }
  EXPECT_GT(feet, 400);
  EXPECT_GT(ends, 15);
  EXPECT_GT(far, 15);
}

TEST(Section, FeetOfPointsThatLieFarBesideASteepFlank) {
  const Section section(tests::flanged_points());
  const Dense dense;
  // 5 mm off the flank along its normal: 10 mm below or above the curve
  for (double y = -40e-3; y <= -30e-3; y += 1e-3)
    for (const double off : {-5e-3, -1e-3, 1e-3, 5e-3}) {
      const Vec2 normal = Vec2(-tests::flanged_slope(y), 1.0).normalized();
      const Vec2 p = Vec2(y, tests::flanged(y)) + off * normal;
      const auto foot = section.foot(p, 20e-3);
      ASSERT_TRUE(foot);
      EXPECT_NEAR(foot->distance, off, 1e-8);
      EXPECT_NEAR(section.at(foot->s).position.x(), y, 1e-6);
      EXPECT_LT((section.at(foot->s).normal - normal).norm(), 1e-4);
    }
}

TEST(Section, OfACircleHasItsLengthNormalsAndCurvature) {
  for (const double sign : {1.0, -1.0}) {  // a head, then a fillet
    const double radius = 13e-3, half = kPi / 3.0;
    std::vector<Vec2> points;
    for (int k = -60; k <= 60; ++k)
      points.emplace_back(radius * std::sin(half * k / 60), sign * radius * std::cos(half * k / 60));
    const Section section(points);
    EXPECT_NEAR(section.length(), 2.0 * half * radius, 1e-7);
    // the spline is straight at its very ends, whatever the circle does
    for (double s = 4e-3; s < section.length() - 4e-3; s += 0.37e-3) {
      const double angle = s / radius - half;
      const Section::Point at = section.at(s);
      EXPECT_LT((at.position - radius * Vec2(std::sin(angle), sign * std::cos(angle))).norm(), 2e-7) << s;
      EXPECT_LT((at.normal - Vec2(sign * std::sin(angle), std::cos(angle))).norm(), 5e-5) << s;
      EXPECT_NEAR(at.curvature * radius, sign, 2e-3) << s;
    }
  }
}

TEST(Section, OfALineHasNoCurvatureAndGoesStraightOnBeyondItsEnds) {
  const Vec2 start(-20e-3, 3e-3), along = Vec2(1.0, 0.7).normalized(), normal(-along.y(), along.x());
  std::vector<Vec2> points;
  for (const double t : {0.0, 1.3e-3, 9e-3, 9.2e-3, 31e-3, 50e-3}) points.push_back(start + t * along);
  const Section section(points);
  EXPECT_NEAR(section.length(), 50e-3, 1e-12);
  EXPECT_EQ(section.y_min(), points.front().x());
  EXPECT_NEAR(section.y_max(), points.back().x(), 1e-15);
  for (const double s : {-5e-3, -1e-6, 0.0, 12.34e-3, 50e-3, 58e-3}) {
    const Section::Point at = section.at(s);
    EXPECT_LT((at.position - start - s * along).norm(), 1e-12) << s;
    EXPECT_LT((at.normal - normal).norm(), 1e-9) << s;
    EXPECT_NEAR(at.curvature, 0.0, 1e-6) << s;
  }
  const auto foot = section.foot(start + 20e-3 * along + 0.5e-3 * normal, 1e-3);
  ASSERT_TRUE(foot);
  EXPECT_NEAR(foot->s, 20e-3, 1e-10);
  EXPECT_NEAR(foot->distance, 0.5e-3, 1e-12);
  EXPECT_FALSE(section.foot(start + 20e-3 * along + 1.01e-3 * normal, 1e-3));
  EXPECT_FALSE(section.foot(start - 1e-5 * along, 1e-3));
  EXPECT_FALSE(section.foot(start + 50.01e-3 * along, 1e-3));
  EXPECT_FALSE(section.foot(start + 5.0 * along, 10.0));
}

TEST(Section, FindsPlacesByTheirLateralPosition) {
  const Section section(tests::flanged_points());
  for (double y = -64.9e-3; y < 60e-3; y += 0.61e-3) {
    const double s = section.s_at(y);
    EXPECT_NEAR(section.at(s).position.x(), y, 1e-12);
    EXPECT_NEAR(section.v_at(y), tests::flanged(y), 1e-8);
    EXPECT_NEAR(section.s_at(section.at(s).position.x()), s, 1e-11);
  }
  EXPECT_EQ(section.s_at(-1.0), 0.0);
  EXPECT_EQ(section.s_at(1.0), section.length());
  EXPECT_NEAR(section.v_at(1.0), tests::flanged(60e-3), 1e-12);
}

TEST(Section, RefusesPointsThatAreNoSection) {
  const auto of = [](std::vector<Vec2> points) { return tests::error_of([&] { Section section(points); }); };
  const auto few = of({{0, 0}, {1, 0}, {2, 0}});
  ASSERT_TRUE(few);
  EXPECT_EQ(few->kind(), ErrorKind::input_data);
  EXPECT_EQ(few->message(), "a section needs at least four points");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double y : {1.0, 0.5, nan}) {
    const auto back = of({{0, 0}, {1, 0}, {y, 0.1}, {3, 0}, {4, 0}});
    ASSERT_TRUE(back) << y;
    EXPECT_EQ(back->message(), "the points of a section must run with increasing y");
  }
  EXPECT_FALSE(of({{0, 0}, {1, 0}, {2, 0}, {3, 0}}));
}

}  // namespace
}  // namespace treadmark::scans
