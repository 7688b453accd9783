// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/tensor_spline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "treadmark/tests/support/error_text.hpp"

namespace treadmark {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::error_of;

/// Quadratic in u, linear in v, with a break in both: z = x^2 + y by Greville's places of the functions.
TensorSpline parabola() {
  TensorSpline s;
  s.name = "parabola";
  s.degree_u = 2, s.degree_v = 1;
  s.knots_u = {0.0, 0.0, 0.0, 1.0, 3.0, 3.0, 3.0};
  s.knots_v = {-1.0, -1.0, 0.5, 2.0, 2.0};
  for (std::size_t i = 0; i < s.poles_u(); ++i)
    for (std::size_t j = 0; j < s.poles_v(); ++j) {
      const double a = s.knots_u[i + 1], b = s.knots_u[i + 2], y = s.knots_v[j + 1];
      s.poles.emplace_back(0.5 * (a + b), y, a * b + y);  // blossoms
    }
  return s;
}

TEST(TensorSplines, ReproducePolynomialsOfTheirDegree) {
  const TensorSpline s = parabola();
  check(s);
  for (double u = 0.0; u <= 3.0; u += 0.125)
    for (double v = -1.0; v <= 2.0; v += 0.25) {
      const TensorJet at = evaluate(s, u, v);
      EXPECT_LT((at.p - Vec3(u, v, u * u + v)).norm(), 1e-14);
      EXPECT_LT((at.pu - Vec3(1.0, 0.0, 2.0 * u)).norm(), 1e-14);
      EXPECT_LT((at.pv - Vec3(0.0, 1.0, 1.0)).norm(), 1e-14);
      EXPECT_LT(at.puv.norm(), 1e-14);
    }
  EXPECT_LT((evaluate(s, 9.0, -9.0).p - Vec3(3.0, -1.0, 8.0)).norm(), 1e-14) << "clamped";
}

TEST(TensorSplines, AreCirclesWithWeights) {
  TensorSpline s;
  s.degree_u = 2, s.degree_v = 1;
  s.knots_u = {0.0, 0.0, 0.0, 1.0, 1.0, 1.0}, s.knots_v = {0.0, 0.0, 1.0, 1.0};
  const Vec3 corners[] = {{0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {1.0, 0.0, 0.0}};
  for (const Vec3& p : corners)
    for (const double y : {0.0, 1.0}) s.poles.emplace_back(p + Vec3(0.0, y, 0.0));
  s.weights = {1.0, 1.0, std::sqrt(0.5), std::sqrt(0.5), 1.0, 1.0};
  check(s);
  constexpr double kStep = 1e-5;
  for (double u = 0.0; u <= 1.0; u += 0.0625) {
    const TensorJet at = evaluate(s, u, 0.5);
    EXPECT_NEAR(std::hypot(at.p.x(), at.p.z()), 1.0, 1e-15);
    EXPECT_NEAR(at.p.x() * at.pu.x() + at.p.z() * at.pu.z(), 0.0, 1e-14) << "along the circle";
    if (u < kStep || u > 1.0 - kStep) continue;
    const Vec3 slope = (evaluate(s, u + kStep, 0.5).p - evaluate(s, u - kStep, 0.5).p) / (2.0 * kStep);
    EXPECT_LT((slope - at.pu).norm(), 1e-9);
  }
}

TEST(TensorSplines, SayWhatIsWrong) {
  const auto refusal = [](auto change) {
    TensorSpline s = parabola();
    change(s);
    return error_of([&] { check(s); });
  };
  EXPECT_THAT(refusal([](TensorSpline& s) { s.degree_u = 0; }), HasSubstr("'parabola' has degree 0 in u"));
  EXPECT_THAT(refusal([](TensorSpline& s) { s.degree_v = 99; }), HasSubstr("degree 99 in v"));
  EXPECT_THAT(refusal([](TensorSpline& s) { s.knots_u.resize(5); }), HasSubstr("5 knots in u, too few"));
  EXPECT_THAT(refusal([](TensorSpline& s) { s.knots_u[3] = 4.0; }), HasSubstr("decrease at 3"));
  EXPECT_THAT(refusal([](TensorSpline& s) { s.knots_v[2] = -1.0; }), HasSubstr("breaks apart at v = -1"));
  EXPECT_THAT(refusal([](TensorSpline& s) { s.knots_v[2] = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("not finite"));
  EXPECT_THAT(refusal([](TensorSpline& s) { s.poles.pop_back(); }), HasSubstr("has 11 poles, not 4 x 3"));
  EXPECT_THAT(refusal([](TensorSpline& s) { s.poles[2].y() = HUGE_VAL; }), HasSubstr("pole that is not finite"));
  EXPECT_THAT(refusal([](TensorSpline& s) { s.weights = {1.0}; }), HasSubstr("other weights than poles"));
  EXPECT_THAT(refusal([](TensorSpline& s) { s.weights.assign(12, -1.0); }), HasSubstr("weight of -1"));
}

TEST(TensorSplines, TurnAlongTheBody) {
  // u runs against y, v along x
  TensorSpline s = parabola();
  for (Vec3& p : s.poles) p = {p.y(), -p.x(), p.z()};
  const TensorSpline turned = along_body(s);
  check(turned);
  EXPECT_EQ(turned.degree_u, 1);
  EXPECT_EQ(turned.degree_v, 2);
  for (double u = -1.0; u <= 2.0; u += 0.25)
    for (double v = -3.0; v <= 0.0; v += 0.25) {
      const TensorJet at = evaluate(turned, u, v);
      EXPECT_LT((at.p - Vec3(u, v, v * v + u)).norm(), 1e-14);
      EXPECT_GT(at.pu.x(), 0.0);
      EXPECT_GT(at.pv.y(), 0.0);
    }
}

}  // namespace
}  // namespace treadmark
