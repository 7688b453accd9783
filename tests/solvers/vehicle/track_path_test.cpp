// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kGauge = 1.435;

LayoutElement piece(double length, FromTo curvature, FromTo cant = {}, TransitionShape shape = TransitionShape::linear,
                    FromTo gauge = {kGauge, kGauge}) {
  return {length, curvature, cant, gauge, shape, {}};
}
TrackPath path_of(std::vector<LayoutElement> elements, CantAxis axis = CantAxis::centre) {
  TrackLayout layout;
  layout.elements = std::move(elements);
  layout.cant_axis = axis;
  return TrackPath(layout);
}

/// Straight, transition, curve to the right with cant and a wider gauge, transition, straight, curve to the left.
TrackPath line(TransitionShape shape, CantAxis axis = CantAxis::centre) {
  const double k = 1.0 / 300.0;
  return path_of(
      {piece(50, {}), piece(60, {0, k}, {0, 0.12}, shape, {kGauge, 1.445}),
       piece(100, {k, k}, {0.12, 0.12}, shape, {1.445, 1.445}), piece(60, {k, 0}, {0.12, 0}, shape, {1.445, kGauge}),
       piece(40, {}), piece(80, {0, -2 * k}, {0, -0.1}, shape), piece(30, {-2 * k, -2 * k}, {-0.1, -0.1}, shape)},
      axis);
}

// Closed forms in double precision: a few roundings of a kilometre.
constexpr double kExact = 1e-12;

TEST(TrackPath, ACircleCloses) {
  for (const double radius : {25.0, 300.0, -300.0}) {
    const double round = 2.0 * kPi * std::abs(radius);
    const TrackPath path = path_of({piece(round, {1 / radius, 1 / radius})});
    const PathPoint end = path.at(round), quarter = path.at(round / 4.0);
    EXPECT_LT(end.origin_L.norm(), kExact * round);
    EXPECT_NEAR(std::abs(end.heading), 2.0 * kPi, kExact);
    // To the right is positive y.
    EXPECT_NEAR(quarter.origin_L.x(), std::abs(radius), kExact * round);
    EXPECT_NEAR(quarter.origin_L.y(), radius, kExact * round);
  }
}

/// Fresnel's integrals of pi t^2 / 2 by their power series (Abramowitz and Stegun 1964, 7.3.11 and 7.3.13).
Vec2 fresnel(double t) {
  Vec2 sum = Vec2::Zero();
  const double q = kPi / 2.0 * t * t;
  double power = t;  // q^n t / n!
  for (int n = 0; n < 80; ++n) {
    const double term = power / (2 * n + 1) * (n % 4 < 2 ? 1.0 : -1.0);
    (n % 2 == 0 ? sum.x() : sum.y()) += term;
    power *= q / (n + 1);
  }
  return sum;
}

TEST(TrackPath, AClothoidHasFresnelsIntegrals) {
  // Published values: Abramowitz and Stegun 1964, table 7.7.
  EXPECT_NEAR(fresnel(1.0).x(), 0.7798934, 5e-8);
  EXPECT_NEAR(fresnel(1.0).y(), 0.4382591, 5e-8);
  // Curvature s / A^2: x = A sqrt(pi) C(s / (A sqrt(pi))).
  for (const double radius : {20.0, 150.0, 1000.0, -400.0}) {
    const double length = 80.0, scale = std::sqrt(kPi * std::abs(radius) * length);
    const TrackPath path = path_of({piece(length, {0, 1 / radius})});
    for (const double s : {0.5, 17.0, 63.0, 80.0}) {
      const Vec2 exact = scale * fresnel(s / scale);
      EXPECT_NEAR(path.at(s).origin_L.x(), exact.x(), kExact * length) << radius << ' ' << s;
      EXPECT_NEAR(path.at(s).origin_L.y(), std::copysign(exact.y(), radius), kExact * length) << radius << ' ' << s;
    }
  }
}

TEST(TrackPath, TransitionsEqualAFinerQuadrature) {
  // Simpson's rule with twenty thousand intervals of what the shapes say, and an egg curve between two radii.
  for (const TransitionShape shape : {TransitionShape::linear, TransitionShape::bloss}) {
    const double a = 1 / 40.0, b = -1 / 25.0, length = 70.0;
    const TrackPath path = path_of({piece(length, {a, b}, {}, shape)});
    const auto heading = [&](double x) {
      const double u = x / length;
      return a * x + (b - a) * length * (shape == TransitionShape::linear ? u * u / 2 : u * u * u - u * u * u * u / 2);
    };
    Vec2 sum = Vec2::Zero();
    const int n = 20000;
    for (int i = 0; i <= n; ++i) {
      const double weight = i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0, psi = heading(length * i / n);
      sum += weight * length / (3.0 * n) * Vec2(std::cos(psi), std::sin(psi));
    }
    EXPECT_NEAR(path.at(length).origin_L.x(), sum.x(), 1e-12 * length);
    EXPECT_NEAR(path.at(length).origin_L.y(), sum.y(), 1e-12 * length);
    EXPECT_NEAR(path.at(length).heading, (a + b) / 2.0 * length, kExact);
  }
}

/// Fourth-order differences, step 0.05 m: errors below 1e-8 of functions that change over tens of metres, and rounding
/// of positions of 400 m over the step.
constexpr double kStep = 0.05, kDifference = 2e-9;
template <class F>
auto slope(const F& f, double s) -> decltype(f(s)) {
  return ((f(s - 2 * kStep) - f(s + 2 * kStep)) + 8.0 * (f(s + kStep) - f(s - kStep))) / (12.0 * kStep);
}

TEST(TrackPath, DerivativesEqualDifferences) {
  for (const TransitionShape shape : {TransitionShape::linear, TransitionShape::bloss})
    for (const CantAxis axis : {CantAxis::centre, CantAxis::low_rail}) {
      const TrackPath path = line(shape, axis);
      // Away from joints at 0, 50, 110, 210, 270, 310, 390, 420 m; before and behind the line, too.
      for (const double s : {-30.0, 20.0, 61.0, 80.0, 104.0, 150.0, 250.0, 290.0, 333.0, 400.0, 450.0}) {
        SCOPED_TRACE(s);
        const PathPoint p = path.at(s);
        const auto of = [&](Along PathPoint::*member, double Along::*part) {
          return slope([&](double x) { return path.at(x).*member.*part; }, s);
        };
        for (const auto member :
             {&PathPoint::curvature, &PathPoint::cant, &PathPoint::cant_angle, &PathPoint::height, &PathPoint::gauge}) {
          EXPECT_NEAR(of(member, &Along::value), (p.*member).first, kDifference);
          EXPECT_NEAR(of(member, &Along::first), (p.*member).second, kDifference);
        }
        EXPECT_NEAR(slope([&](double x) { return path.at(x).heading; }, s), p.curvature.value, kDifference);
        const Vec3 tangent = slope([&](double x) -> Vec3 { return path.at(x).origin_L; }, s);
        EXPECT_LT((tangent - p.tangent_L()).norm(), kDifference);
        const Mat3 R = p.X_LT().rotation;
        const Mat3 rate = R.transpose() * slope([&](double x) -> Mat3 { return path.at(x).X_LT().rotation; }, s);
        EXPECT_LT((Vec3(rate(2, 1), rate(0, 2), rate(1, 0)) - p.turn()).norm(), kDifference);
        const Vec3 turn_first = slope([&](double x) -> Vec3 { return path.at(x).turn(); }, s);
        EXPECT_LT((turn_first - p.turn_first()).norm(), kDifference);
      }
    }
}

TEST(TrackPath, JointsAreAsSmoothAsTheShapeAllows) {
  for (const TransitionShape shape : {TransitionShape::linear, TransitionShape::bloss}) {
    const TrackPath path = line(shape, CantAxis::low_rail);
    EXPECT_EQ(path.largest_curvature_step(), 0.0);
    for (const double joint : {0.0, 50.0, 110.0, 210.0, 270.0, 310.0, 390.0, 420.0}) {
      SCOPED_TRACE(joint);
      const double step = 1e-7;  // [m]
      const PathPoint before = path.at(joint - step), behind = path.at(joint + step);
      EXPECT_LT((behind.origin_L - before.origin_L).norm(), 3.0 * step);
      EXPECT_NEAR(before.heading, behind.heading, step);
      for (const auto member :
           {&PathPoint::curvature, &PathPoint::cant, &PathPoint::cant_angle, &PathPoint::height, &PathPoint::gauge}) {
        EXPECT_NEAR((before.*member).value, (behind.*member).value, step);
        if (shape != TransitionShape::bloss) continue;
        EXPECT_NEAR((before.*member).first, (behind.*member).first, step);
      }
    }
    // A clothoid's curvature has a kink where it begins.
    const double kink = path.at(50.0).curvature.first - path.at(50.0 - 1e-7).curvature.first;
    EXPECT_NEAR(kink, shape == TransitionShape::linear ? 1.0 / 300.0 / 60.0 : 0.0, 1e-12);
  }
  EXPECT_EQ(path_of({piece(10, {}), piece(10, {0.005, 0.005})}).largest_curvature_step(), 0.005);
}

TEST(TrackPath, CantLiftsTheOuterRail) {
  const double cant = 0.15, k = 1 / 500.0, b = 1.5;
  for (const CantAxis axis : {CantAxis::centre, CantAxis::low_rail}) {
    const TrackPath path = path_of({piece(100, {k, k}, {cant, cant})}, axis);
    const Vec3 left = path.to_space({30.0, -b / 2, 0.0}), right = path.to_space({30.0, b / 2, 0.0});
    EXPECT_NEAR(right.z() - left.z(), cant, kExact);
    EXPECT_NEAR((right - left).norm(), b, kExact);
    EXPECT_NEAR(right.z(), axis == CantAxis::low_rail ? 0.0 : cant / 2.0, kExact);
    EXPECT_NEAR(path.at(30.0).cant_angle.value, std::asin(0.1), kExact);
  }
}

TEST(TrackPath, PointsComeBackFromSpace) {
  for (const TransitionShape shape : {TransitionShape::linear, TransitionShape::bloss}) {
    const TrackPath path = line(shape, CantAxis::low_rail);
    for (double s = -25.0; s < 450.0; s += 7.3)
      for (const double y : {-20.0, -0.75, 0.0, 3.0})
        for (const double z : {-4.0, 0.0, 0.5}) {
          const Vec3 point = path.to_space({s, y, z});
          for (const auto& found : {path.locate(point, s + 9.0), path.locate(point)}) {
            ASSERT_TRUE(found) << s << ' ' << y;
            EXPECT_NEAR(found->distance, s, 1e-10);
            EXPECT_NEAR(found->y, y, 1e-10);
            EXPECT_NEAR(found->z, z, 1e-10);
          }
        }
  }
  // Behind the centre of the curve there is no place next to here.
  const TrackPath circle = path_of({piece(100, {0.01, 0.01})});
  EXPECT_FALSE(circle.locate({0.0, 120.0, 0.0}, 0.0));
}

TEST(TrackPath, LinesThatMakeNoSenseAreRefused) {
  const auto message = [](std::vector<LayoutElement> elements, CantAxis axis = CantAxis::centre) -> std::string {
    try {
      path_of(std::move(elements), axis);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(message({}), HasSubstr("no elements"));
  EXPECT_THAT(message({piece(0, {})}), HasSubstr("0 m long"));
  EXPECT_THAT(message({piece(-5, {})}), HasSubstr("-5 m long"));
  EXPECT_THAT(message({piece(kNaN, {})}), HasSubstr("m long"));
  EXPECT_THAT(message({piece(1e6, {}), piece(1, {})}), HasSubstr("1e+06 m long"));
  EXPECT_THAT(message({piece(5, {0.2, 0.2})}), HasSubstr("radius of 5 m, less than 10 m"));
  EXPECT_THAT(message({piece(5, {}, {0.8, 0.8})}), HasSubstr("a cant of 800 mm on rails 1500 mm apart"));
  EXPECT_THAT(message({piece(5, {}), piece(5, {}, {0.1, 0.1})}), HasSubstr("the cant steps from 0 to 100 mm"));
  EXPECT_THAT(message({piece(5, {}), piece(5, {}, {}, TransitionShape::linear, {1.44, 1.44})}),
              HasSubstr("the gauge steps from 1435 to 1440 mm"));
  EXPECT_THAT(message({piece(5, {kNaN, 0})}), HasSubstr("not finite"));
  EXPECT_THAT(message({piece(50, {}, {0.1, -0.1})}, CantAxis::low_rail), HasSubstr("changes its sign"));
  EXPECT_THAT(message({piece(50, {}, {0.1, -0.1})}), HasSubstr("accepted"));
}

}  // namespace
}  // namespace treadmark::vehicle
