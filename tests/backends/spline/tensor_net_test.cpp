// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/nurbs/tensor_net.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "treadmark/backends/spline/make.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_surface.hpp"
#include "treadmark/core/parametric.hpp"
#include "treadmark/tests/support/error_text.hpp"

namespace treadmark::spline {
namespace {

using ::testing::HasSubstr;

std::vector<double> random_knots(std::mt19937& random, int degree, bool with_double) {
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, 0.0);
  double t = 0.0;
  for (int i = 0; i < 4; ++i) {
    t += 0.1 + 1e-10 * static_cast<double>(random());
    knots.push_back(t);
    if (with_double && i == 1) knots.push_back(t);
  }
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, t + 0.2);
  return knots;
}

/// A rail of any knots and about this shape.
TensorSpline random_spline(int degree_u, int degree_v, bool rational, bool with_double) {
  std::mt19937 random(static_cast<unsigned>(10 * degree_u + degree_v));
  std::uniform_real_distribution<double> shift(-2e-3, 2e-3), weight(0.7, 1.4);
  TensorSpline s;
  s.degree_u = degree_u, s.degree_v = degree_v;
  s.knots_u = random_knots(random, degree_u, with_double && degree_u > 1);
  s.knots_v = random_knots(random, degree_v, with_double && degree_v > 1);
  for (std::size_t i = 0; i < s.poles_u(); ++i)
    for (std::size_t j = 0; j < s.poles_v(); ++j) {
      s.poles.emplace_back(0.02 * static_cast<double>(i) + shift(random), 0.02 * static_cast<double>(j) + shift(random),
                           shift(random));
      if (rational) s.weights.push_back(weight(random));
    }
  return s;
}

/// Greatest distance of the patches from what de Boor's recurrence gives.
double greatest_distance(const TensorSpline& s, const NurbsNet& net) {
  const NurbsSurface surface(net, Body::rail);
  const auto u = breaks_of(s.knots_u, s.degree_u), v = breaks_of(s.knots_v, s.degree_v);
  const NurbsNet::Range all = net.range();
  double most = 0.0;
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; j <= 60; ++j) {
      const double a = u.front() + (u.back() - u.front()) * i / 60.0, b = v.front() + (v.back() - v.front()) * j / 60.0;
      most =
          std::max(most, (surface.point(all.u0 + (all.u1 - all.u0) * i / 60.0, all.v0 + (all.v1 - all.v0) * j / 60.0) -
                          evaluate(s, a, b).p)
                             .norm());
    }
  return most;
}

TEST(TensorNets, AreExactUpToDegreeThree) {
  for (int p = 1; p <= 3; ++p)
    for (int q = 1; q <= 3; ++q)
      for (const bool rational : {false, true})
        for (const bool with_double : {false, true}) {
          const TensorSpline s = random_spline(p, q, rational, with_double);
          double deviation = 1e-9;
          const NurbsNet net = net_of(s, deviation);
          EXPECT_EQ(deviation, 0.0);
          EXPECT_LT(greatest_distance(s, net), 1e-15 * 100) << p << q << rational << with_double;
          const bool smooth = !rational && p > (with_double ? 2 : 1) && q > (with_double ? 2 : 1);
          EXPECT_EQ(net.by_corners(), smooth) << p << q << rational << with_double;
        }
}

TEST(TensorNets, AreAsNearAsAskedForAboveDegreeThree) {
  for (const bool rational : {false, true}) {
    const TensorSpline s = random_spline(5, 4, rational, false);
    double deviation = 1e-7;
    const NurbsNet net = net_of(s, deviation);
    EXPECT_GT(deviation, 0.0);
    EXPECT_LE(deviation, 1e-7);
    EXPECT_LT(greatest_distance(s, net), 2e-7);
  }
}

TEST(TensorNets, GiveTheCoefficientsOfWhatGoesThroughPoints) {
  for (const bool closed : {false, true}) {
    sampling::PointGrid grid;
    grid.body = closed ? Body::wheel : Body::rail;
    grid.closed = closed;
    for (int i = 0; i < 40; ++i)
      grid.u.push_back(closed ? -3.0 + 0.15 * i + 0.02 * std::sin(1.0 * i)
                              : 1e-3 * i + (i > 20 ? 3e-4 * (i - 20) : 0.0));
    for (int j = 0; j < 30; ++j) grid.y.push_back(1e-3 * j + 2e-4 * std::cos(3.0 * j));
    for (const double u : grid.u)
      for (const double y : grid.y) grid.h.push_back((closed ? 0.46 : 0.0) + 1e-3 * std::sin(3.0 * u + 90.0 * y));
    const FittedSpline fitted = fit_tensor_spline(grid);
    check(fitted.spline);
    EXPECT_EQ(fitted.spline.poles_u(), grid.u.size() + (closed ? 3 : 2));
    EXPECT_EQ(fitted.spline.poles_v(), grid.y.size() + 2);
    const auto& surface = dynamic_cast<const NurbsSurface&>(*fitted.surface);
    double deviation = 0.0, most = 0.0;
    const NurbsNet again = net_of(fitted.spline, deviation);
    EXPECT_TRUE(again.by_corners());
    const NurbsNet::Range end = surface.net().range(surface.net().patches_u() - 1, surface.net().patches_v() - 1);
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j <= 50; ++j) {
        const double u = grid.u.front() + (end.u1 - grid.u.front()) * i / 200.0, v = end.v1 * j / 50.0;
        most = std::max(most, (surface.point(u, v) - evaluate(fitted.spline, u, v).p).norm());
      }
    EXPECT_LT(most, 1e-14);
  }
}

TEST(TensorNets, TellStationsWhateverTheirParametersAre) {
  // a circle in four quarters, u from 0 to 1
  TensorSpline s;
  s.body = Body::wheel;
  s.degree_u = 2, s.degree_v = 1;
  s.knots_u = {0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0}, s.knots_v = {0.0, 0.0, 7.0, 7.0};
  const double corners[9][2] = {{0, -1}, {-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}};
  for (int i = 0; i < 9; ++i)
    for (const double y : {-0.02, 0.02}) {
      s.poles.emplace_back(0.46 * corners[i][0], y, 0.46 * corners[i][1]);
      s.weights.push_back(i % 2 == 1 ? std::sqrt(0.5) : 1.0);
    }
  double deviation = 0.0;
  const NurbsSurface wheel(net_of(s, deviation), Body::wheel);
  for (const double angle : {-3.0, -1.0, 0.0, 0.7, 2.9}) {
    const Vec2 uv(angle, wheel.net().range().v0 + 0.01);
    SurfaceJet jet;
    evaluate(wheel, {&uv, 1}, {&jet, 1});
    ASSERT_TRUE(jet.found()) << angle;
    EXPECT_NEAR(std::atan2(jet.p.x(), jet.p.z()), angle, 1e-11);
    EXPECT_NEAR(jet.pu.norm(), 0.46, 1e-9);
  }
}

TEST(TensorNets, RefuseWhatIsNoSurface) {
  TensorSpline s = random_spline(3, 3, false, false);
  s.poles.pop_back();
  double deviation = 0.0;
  EXPECT_THAT(treadmark::testing::error_of([&] { net_of(s, deviation); }), HasSubstr("poles, not"));
}

}  // namespace
}  // namespace treadmark::spline
