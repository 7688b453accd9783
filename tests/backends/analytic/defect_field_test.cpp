// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/tests/backends/analytic/defect_formulas.hpp"
#include "treadmark/tests/support/mutation.hpp"

namespace treadmark::testing {
namespace {

using displacement::OffsetJet;
using displacement::OffsetRange;

class DefectFields : public ::testing::TestWithParam<NamedDefects> {
 protected:
  std::shared_ptr<const displacement::OffsetField> field_ =
      analytic::make_defect_field(GetParam().defects, GetParam().body, kTestRadius, nullptr);
  double random_u() { return uniform(GetParam().u_min, GetParam().u_max); }
  double random_y() { return uniform(GetParam().y_min, GetParam().y_max); }
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  std::mt19937 random_{11};
};

INSTANTIATE_TEST_SUITE_P(Shapes, DefectFields, ::testing::ValuesIn(offset_defects()),
                         [](const auto& which) { return which.param.name; });

TEST_P(DefectFields, JetsMatchDifferenceQuotientsOfTheFormula) {
  const auto& f = GetParam().offset;
  // central differences of values of up to 2 mm that carry rounding of 1e-16 m and third derivatives of up to 1e5/m^2
  constexpr double kFirst = 1e-6, kSecond = 1e-4, kFirstTolerance = 1e-8, kSecondTolerance = 2e-4;
  int wrong = 0, changed = 0;
  constexpr int kPoints = 4000;
  for (int i = 0; i < kPoints; ++i) {
    const double u = random_u(), y = random_y();
    const OffsetJet jet = field_->jet(u, y);
    ASSERT_NEAR(jet.value, f(u, y), 1e-15) << u << ' ' << y;
    if (jet.value != 0.0) ++changed;
    const auto d1 = [&](double a, double b, double h) {
      return (f(u + a * h, y + b * h) - f(u - a * h, y - b * h)) / (2.0 * h);
    };
    const auto d2 = [&](double a, double b, double h) {
      return (f(u + a * h, y + b * h) - 2.0 * f(u, y) + f(u - a * h, y - b * h)) / (h * h);
    };
    const double scale = 1.0 + std::fabs(jet.d_uu) + std::fabs(jet.d_yy);
    const double d_uy = (f(u + kSecond, y + kSecond) - f(u + kSecond, y - kSecond) - f(u - kSecond, y + kSecond) +
                         f(u - kSecond, y - kSecond)) /
                        (4.0 * kSecond * kSecond);
    const bool good = std::fabs(jet.d_u - d1(1, 0, kFirst)) < kFirstTolerance * scale &&
                      std::fabs(jet.d_y - d1(0, 1, kFirst)) < kFirstTolerance * scale &&
                      std::fabs(jet.d_uu - d2(1, 0, kSecond)) < kSecondTolerance * scale &&
                      std::fabs(jet.d_yy - d2(0, 1, kSecond)) < kSecondTolerance * scale &&
                      std::fabs(jet.d_uy - d_uy) < kSecondTolerance * scale;
    if (!good) ++wrong;
  }
  EXPECT_GT(changed, kPoints / 20);
  EXPECT_LE(wrong, kPoints / 40)
      << "second derivatives jump where a shape begins, but differences see that on thin lines only";
}

TEST_P(DefectFields, ManyPointsAtOnceAreTheJets) {
  std::vector<double> u, y;
  for (int i = 0; i < 500; ++i) {
    // rows share a coordinate
    u.push_back(i % 3 == 1 ? u.back() : random_u());
    y.push_back(i % 5 == 3 ? y.back() : random_y());
  }
  std::vector<double> value(u.size(), 7.0), d_u = value, d_y = value, only = value;
  field_->evaluate(u, y, value, d_u, d_y);
  field_->evaluate(u, y, only, {}, {});
  for (std::size_t i = 0; i < u.size(); ++i) {
    const OffsetJet jet = field_->jet(u[i], y[i]);
    EXPECT_NEAR(value[i], jet.value, 1e-16);
    EXPECT_NEAR(d_u[i], jet.d_u, 1e-14);
    EXPECT_NEAR(d_y[i], jet.d_y, 1e-14);
    EXPECT_EQ(only[i], value[i]);
  }
}

TEST_P(DefectFields, RangesHoldValuesAndSlopes) {
  constexpr double kRounding = 1e-14;
  int zero = 0, tight = 0, small = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double size = std::pow(10.0, uniform(-4.0, 0.0));
    const double u = random_u(), y = random_y(), width = size * (GetParam().u_max - GetParam().u_min);
    const double height = size * (GetParam().y_max - GetParam().y_min);
    const OffsetRange range = field_->range({u, u + width, y, y + height});
    double least = 1.0, most = -1.0;
    for (int i = 0; i < 100; ++i) {
      const OffsetJet jet = field_->jet(uniform(u, u + width), uniform(y, y + height));
      ASSERT_GE(jet.value, range.low - kRounding) << "trial " << trial;
      ASSERT_LE(jet.value, range.high + kRounding) << "trial " << trial;
      ASSERT_LE(std::fabs(jet.d_u), range.max_d_u + kRounding) << "trial " << trial;
      ASSERT_LE(std::fabs(jet.d_y), range.max_d_y + kRounding) << "trial " << trial;
      least = std::min(least, jet.value);
      most = std::max(most, jet.value);
    }
    if (range.zero()) ++zero;
    if (size > 1e-3) continue;
    ++small;
    // of small rectangles they are not much more than the slopes allow
    if (range.high - range.low <= 2.5 * (range.max_d_u * width + range.max_d_y * height) + kRounding) ++tight;
  }
  if (GetParam().body == Body::rail) {
    EXPECT_GT(zero, 0);
  }
  EXPECT_EQ(tight, small);
}

TEST(DefectField, RandomShapesFollowTheFormulas) {
  constexpr double kRounding = 1e-13;  // of phases far from the origin, times amplitudes of millimetres
  constexpr int kPoints = 50;
  std::mt19937 random(23);
  int changed = 0;
  const int shapes = mutants(400);
  for (int i = 0; i < shapes; ++i) {
    const NamedDefects d = random_defect(random);
    const auto field = analytic::make_defect_field(d.defects, d.body, kTestRadius, nullptr);
    for (int k = 0; k < kPoints; ++k) {
      const double u = std::uniform_real_distribution<double>(d.u_min, d.u_max)(random);
      const double y = std::uniform_real_distribution<double>(d.y_min, d.y_max)(random);
      const double value = field->jet(u, y).value;
      ASSERT_NEAR(value, d.offset(u, y), kRounding) << d.name << ' ' << i << ' ' << u << ' ' << y;
      if (value != 0.0) ++changed;
    }
  }
  EXPECT_GT(changed, shapes * kPoints / 10);
}

TEST(DefectField, FlattenedHeadIsTheBaseCutToAPlane) {
  constexpr double kRadius = 0.3;
  const auto base = analytic::make_prismatic_surface(analytic::cylinder_chain(kRadius, 0.3));
  const FlattenedHead head{-0.1, 0.2, 0.05, 0.4e-3, 0.02};
  const auto field = analytic::make_defect_field({.flattened_heads = {head}}, Body::rail, 0.0, base);
  const auto plane = [&](double x, double y) {
    const double t = std::clamp(std::min(x + 0.1, 0.2 - x) / 0.05, 0.0, 1.0);
    // the line of the same inclination that touches the circle
    const double touching = kRadius - kRadius / std::cos(0.02);
    return y * std::tan(0.02) + touching + 0.4e-3 * t * t * (3.0 - 2.0 * t);
  };
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int cut = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x = -0.15 + 0.4 * unit(random), y = -0.06 + 0.12 * unit(random);
    const double z = kRadius - std::sqrt(kRadius * kRadius - y * y);
    const double expected = x > -0.1 && x < 0.2 ? std::max(0.0, plane(x, y) - z) : 0.0;
    const OffsetJet jet = field->jet(x, y);
    ASSERT_NEAR(jet.value, expected, 1e-12) << x << ' ' << y;
    if (expected < 1e-7) continue;  // next to the edge second differences see both sides
    ++cut;
    ASSERT_NEAR(jet.d_u, (plane(x + 1e-6, y) - plane(x - 1e-6, y)) / 2e-6, 1e-8);
    ASSERT_NEAR(jet.d_y, std::tan(0.02) - y / std::sqrt(kRadius * kRadius - y * y), 1e-12);
    ASSERT_NEAR(jet.d_yy, -kRadius * kRadius / std::pow(kRadius * kRadius - y * y, 1.5), 1e-5);
    const OffsetRange range = field->range({x - 0.001, x + 0.002, y - 0.001, y + 0.001});
    ASSERT_LE(range.low, jet.value);
    ASSERT_GE(range.high, jet.value);
    ASSERT_GE(range.max_d_u, std::fabs(jet.d_u));
    ASSERT_GE(range.max_d_y, std::fabs(jet.d_y));
    double value[1], d_u[1], d_y[1];
    field->evaluate({{x}}, {{y}}, value, d_u, d_y);
    ASSERT_EQ(value[0], jet.value);
    ASSERT_EQ(d_u[0], jet.d_u);
  }
  EXPECT_GT(cut, 200);
}

TEST(DefectField, FlattenedHeadHasRoundEdges) {
  constexpr double kRadius = 0.3, kEdge = 0.06, kDepth = 0.4e-3, kRoll = 0.02;
  const auto base = analytic::make_prismatic_surface(analytic::cylinder_chain(kRadius, 0.3));
  const FlattenedHead head{-0.1, 0.2, 0.05, kDepth, kRoll, kEdge};
  const auto field = analytic::make_defect_field({.flattened_heads = {head}}, Body::rail, 0.0, base);
  const auto sharp =
      analytic::make_defect_field({.flattened_heads = {{-0.1, 0.2, 0.05, kDepth, kRoll}}}, Body::rail, 0.0, base);
  // Curvature of what is left, across the rail in the middle: flat, and nowhere more than that of the edges.
  const auto curvature = [&](double y) {
    const OffsetJet jet = field->jet(0.05, y);
    const double root = std::sqrt(kRadius * kRadius - y * y), slope = y / root + jet.d_y,
                 second = kRadius * kRadius / (root * root * root) + jet.d_yy;
    return second / std::pow(1.0 + slope * slope, 1.5);
  };
  double sharpest = 0.0;
  for (double y = -0.03; y < 0.03; y += 1e-5) sharpest = std::max(sharpest, curvature(y));
  EXPECT_NEAR(sharpest, 1.0 / kEdge, 0.01 / kEdge);
  EXPECT_NEAR(curvature(kRadius * std::sin(kRoll)), 0.0, 1e-4) << "flat in its middle";

  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int round = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x = -0.15 + 0.4 * unit(random), y = -0.04 + 0.08 * unit(random);
    const OffsetJet jet = field->jet(x, y);
    const double flat = sharp->jet(x, y).value;
    ASSERT_GE(jet.value, flat);
    ASSERT_LE(jet.value, flat + 0.25 * kDepth) << "material is gone at the edges only";
    if (jet.value == flat) continue;
    ++round;
    constexpr double h = 1e-6;
    const auto value = [&](double u, double v) { return field->jet(u, v).value; };
    ASSERT_NEAR(jet.d_u, (value(x + h, y) - value(x - h, y)) / (2 * h), 1e-8);
    ASSERT_NEAR(jet.d_y, (value(x, y + h) - value(x, y - h)) / (2 * h), 1e-7);
    const auto slope_u = [&](double u, double v) { return field->jet(u, v).d_u; };
    const auto slope_y = [&](double u, double v) { return field->jet(u, v).d_y; };
    const auto near_end = [&](auto slope, double du, double dv, double second) {
      const double difference = (slope(x + du, y + dv) - slope(x - du, y - dv)) / (2 * h);
      return std::abs(difference - second) < 1e-3 * (1.0 + std::abs(second));
    };
    // where second derivatives jump, differences see both sides
    const double margin = 2 * h, here = jet.d_yy;
    if (std::abs(field->jet(x, y + margin).d_yy - here) + std::abs(field->jet(x, y - margin).d_yy - here) +
            std::abs(field->jet(x + margin, y).d_yy - here) + std::abs(field->jet(x - margin, y).d_yy - here) >
        0.5)
      continue;
    EXPECT_TRUE(near_end(slope_y, 0.0, h, jet.d_yy)) << x << ' ' << y;
    EXPECT_TRUE(near_end(slope_y, h, 0.0, jet.d_uy)) << x << ' ' << y;
    EXPECT_TRUE(near_end(slope_u, h, 0.0, jet.d_uu)) << x << ' ' << y;
    const OffsetRange range = field->range({x - 0.001, x + 0.002, y - 0.001, y + 0.001});
    ASSERT_LE(range.low, jet.value);
    ASSERT_GE(range.high, jet.value);
    ASSERT_GE(range.max_d_u, std::fabs(jet.d_u));
    ASSERT_GE(range.max_d_y, std::fabs(jet.d_y));
    double at[1], d_u[1], d_y[1];
    field->evaluate({{x}}, {{y}}, at, d_u, d_y);
    ASSERT_EQ(at[0], jet.value);
    ASSERT_EQ(d_u[0], jet.d_u);
    ASSERT_EQ(d_y[0], jet.d_y);
  }
  EXPECT_GT(round, 150);
  for (const double radius : {0.3, 0.2})
    EXPECT_THROW(analytic::make_defect_field({.flattened_heads = {{-0.1, 0.2, 0.05, kDepth, kRoll, radius}}},
                                             Body::rail, 0.0, base),
                 Error);
}

TEST(DefectRegion, HoldsEverythingThatChanges) {
  EXPECT_FALSE(analytic::defect_region({}, 0.46));
  for (const NamedDefects& d : offset_defects()) {
    SCOPED_TRACE(d.name);
    const auto region = analytic::defect_region(d.defects, kTestRadius);
    ASSERT_TRUE(region);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
      const double u = d.u_min + (d.u_max - d.u_min) * unit(random), y = d.y_min + (d.y_max - d.y_min) * unit(random);
      if (d.offset(u, y) == 0.0) continue;
      const double turn_on = 2.0 * std::numbers::pi;
      const bool inside = u >= region->x_min && u <= region->x_max;
      const bool turned = d.body == Body::wheel && ((u + turn_on >= region->x_min && u + turn_on <= region->x_max) ||
                                                    (u - turn_on >= region->x_min && u - turn_on <= region->x_max));
      ASSERT_TRUE(inside || turned) << u;
      ASSERT_TRUE(y >= region->y_min && y <= region->y_max) << y;
    }
  }
}

}  // namespace
}  // namespace treadmark::testing
