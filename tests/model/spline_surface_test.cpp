// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/shape/spline_surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "treadmark/tests/support/error_text.hpp"

namespace treadmark {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::error_of;

/// Quadratic in s, linear in t, with a break in both: z = x^2 + y by Greville's places of the functions.
SplineSurface parabola() {
  SplineSurface out;
  out.name = "parabola";
  out.levels.push_back(
      {SplineKnots{2, {0.0, 0.0, 0.0, 1.0, 3.0, 3.0, 3.0}}, SplineKnots{1, {-1.0, -1.0, 0.5, 2.0, 2.0}}});
  const auto& [s, t] = out.levels.front();
  for (std::size_t j = 0; j < t.functions(); ++j)
    for (std::size_t i = 0; i < s.functions(); ++i) {
      const double a = s.knots[i + 1], b = s.knots[i + 2], y = t.knots[j + 1];
      out.points.emplace_back(0.5 * (a + b), y, a * b + y);  // blossoms
    }
  return out;
}

TEST(SplineSurfaces, ReproducePolynomialsOfTheirDegree) {
  const SplineSurface surface = parabola();
  check(surface);
  for (double s = 0.0; s <= 3.0; s += 0.125)
    for (double t = -1.0; t <= 2.0; t += 0.25) {
      const SplineJet at = evaluate(surface, s, t);
      EXPECT_LT((at.p - Vec3(s, t, s * s + t)).norm(), 1e-14);
      EXPECT_LT((at.ps - Vec3(1.0, 0.0, 2.0 * s)).norm(), 1e-14);
      EXPECT_LT((at.pt - Vec3(0.0, 1.0, 1.0)).norm(), 1e-14);
      EXPECT_LT(at.pst.norm(), 1e-14);
    }
  EXPECT_LT((evaluate(surface, 9.0, -9.0).p - Vec3(3.0, -1.0, 8.0)).norm(), 1e-14) << "clamped";
}

TEST(SplineSurfaces, HaveASlopeOnEachSideOfAnEdge) {
  SplineSurface roof;
  roof.levels.push_back({SplineKnots{1, {0.0, 0.0, 1.0, 3.0, 3.0}}, SplineKnots{1, {0.0, 0.0, 1.0, 1.0}}});
  for (const double y : {0.0, 1.0})
    for (const Vec2& xz : {Vec2(0.0, 0.0), Vec2(1.0, -1.0), Vec2(3.0, 3.0)})
      roof.points.emplace_back(xz.x(), y, xz.y());
  EXPECT_NEAR(evaluate(roof, {1.0, 0.5}, {0.5, 0.5}).ps.z(), -1.0, 1e-15);
  EXPECT_NEAR(evaluate(roof, {1.0, 0.5}, {2.0, 0.5}).ps.z(), 2.0, 1e-15);
  EXPECT_NEAR(evaluate(roof, 1.0, 0.5).p.z(), -1.0, 1e-15);
  EXPECT_FALSE(roof.levels[0][0].smooth());
  EXPECT_TRUE(parabola().levels[0][0].smooth());
  EXPECT_EQ(parabola().levels[0][0].breaks(), (std::vector<double>{0.0, 1.0, 3.0}));
}

TEST(SplineSurfaces, AreCirclesWithWeights) {
  SplineSurface surface;
  surface.levels.push_back({SplineKnots{2, {0.0, 0.0, 0.0, 1.0, 1.0, 1.0}}, SplineKnots{1, {0.0, 0.0, 1.0, 1.0}}});
  for (const double y : {0.0, 1.0})
    for (const Vec2& xz : {Vec2(0.0, 1.0), Vec2(1.0, 1.0), Vec2(1.0, 0.0)})
      surface.points.emplace_back(xz.x(), y, xz.y());
  surface.weights = {1.0, std::sqrt(0.5), 1.0, 1.0, std::sqrt(0.5), 1.0};
  check(surface);
  constexpr double kStep = 1e-5;
  for (double s = 0.0; s <= 1.0; s += 0.0625) {
    const SplineJet at = evaluate(surface, s, 0.5);
    EXPECT_NEAR(std::hypot(at.p.x(), at.p.z()), 1.0, 1e-15);
    EXPECT_NEAR(at.p.x() * at.ps.x() + at.p.z() * at.ps.z(), 0.0, 1e-14) << "along the circle";
    if (s < kStep || s > 1.0 - kStep) continue;
    const Vec3 slope = (evaluate(surface, s + kStep, 0.5).p - evaluate(surface, s - kStep, 0.5).p) / (2.0 * kStep);
    EXPECT_LT((slope - at.ps).norm(), 1e-9);
  }
}

TEST(SplineSurfaces, SayWhatIsWrong) {
  const auto refusal = [](auto change) {
    SplineSurface surface = parabola();
    change(surface, surface.levels[0][0], surface.levels[0][1]);
    return error_of([&] { check(surface); });
  };
  EXPECT_THAT(refusal([](auto&, auto& s, auto&) { s.degree = 0; }), HasSubstr("parabola: degree 0 is not known"));
  EXPECT_THAT(refusal([](auto&, auto&, auto& t) { t.degree = 99; }), HasSubstr("degree 99 is not known: 1 to 25 are"));
  EXPECT_THAT(refusal([](auto&, auto& s, auto&) { s.knots.resize(5); }), HasSubstr("5 knots are too few for degree 2"));
  EXPECT_THAT(refusal([](auto&, auto& s, auto&) { s.knots[3] = 4.0; }), HasSubstr("knot 5 is less than"));
  EXPECT_THAT(refusal([](auto&, auto&, auto& t) { t.knots[2] = -1.0; }), HasSubstr("knot 3 is repeated 3 times"));
  EXPECT_THAT(refusal([](auto&, auto&, auto& t) { t.knots[2] = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("knot 3 is not finite"));
  EXPECT_THAT(refusal([](auto& all, auto&, auto&) { all.points.pop_back(); }),
              HasSubstr("its basis has 4 x 3 functions, but it has 11 coefficients"));
  EXPECT_THAT(refusal([](auto& all, auto&, auto&) { all.points[2].y() = HUGE_VAL; }),
              HasSubstr("a coefficient is not finite"));
  EXPECT_THAT(refusal([](auto& all, auto&, auto&) { all.weights = {1.0}; }), HasSubstr("it has 1 weights for 12"));
  EXPECT_THAT(refusal([](auto& all, auto&, auto&) { all.weights.assign(12, -1.0); }), HasSubstr("weight 1 is -1"));
  EXPECT_THAT(refusal([](auto& all, auto& s, auto&) { all.hierarchical = true, s.degree = 4; }),
              HasSubstr("degree 4 is not known: 1 to 3 are"));
}

}  // namespace
}  // namespace treadmark
