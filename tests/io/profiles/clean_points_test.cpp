// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/clean_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "samples.hpp"

namespace treadmark::io::profiles {
namespace {

using testing::Point;

RawPoints raw(const std::vector<Point>& points) {
  RawPoints result;
  result.file = "sample";
  for (const Point& p : points) result.add(p.y, p.z, static_cast<int>(result.size()) + 1);
  return result;
}

RawPoints mirrored(RawPoints p, bool y, bool z) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (y) p.y[i] = -p.y[i];
    if (z) p.z[i] = -p.z[i];
  }
  return p;
}

RawPoints reversed(RawPoints p) {
  std::reverse(p.y.begin(), p.y.end());
  std::reverse(p.z.begin(), p.z.end());
  return p;
}

constexpr double kThreshold = 150.0 * std::numbers::pi / 180.0;

TEST(RemoveNearPoints, MeasuresFromTheLastKeptPoint) {
  RawPoints p = raw({{0, 0}, {0.6, 0}, {1.2, 0}, {1.2, 0.5}, {1.2, 1.0}, {3, 1}});
  remove_near_points(p, 1.0);
  EXPECT_EQ(p.y, (std::vector<double>{0, 1.2, 1.2, 3}));
  EXPECT_EQ(p.z, (std::vector<double>{0, 0, 1.0, 1}));
  EXPECT_EQ(p.line, (std::vector<int>{1, 3, 5, 6}));
}

TEST(RemoveZigzags, ReplacesTheTwoTurningPointsByTheirMean) {
  RawPoints p = raw({{0, 0}, {1, 0}, {2, 0.1}, {1.5, 0.1}, {3, 0.2}, {4, 0}});
  remove_zigzags(p, kThreshold);
  EXPECT_EQ(p.y, (std::vector<double>{0, 1, 1.75, 3, 4}));
  EXPECT_EQ(p.line, (std::vector<int>{1, 2, 3, 5, 6}));
}

TEST(RemoveZigzags, HandlesTwoInARowFromTheirOwnAngles) {
  RawPoints p = raw({{0, 0}, {2, 0}, {1, 0}, {4, 0}, {3, 0}, {6, 0}, {7, 0}});
  remove_zigzags(p, kThreshold);
  EXPECT_EQ(p.y, (std::vector<double>{0, 1.5, 3.5, 6, 7}));
}

TEST(RemoveZigzags, KeepsASingleSharpTurnAndShallowOnes) {
  const std::vector<Point> fold = {{0, 0}, {5, 0}, {1, 0.1}, {1, 5}};
  RawPoints p = raw(fold);
  remove_zigzags(p, kThreshold);
  EXPECT_EQ(p.size(), fold.size());
  // Two right angles stay at 150 degrees and go at 45 degrees.
  const std::vector<Point> step = {{0, 0}, {1, 0}, {1, 1}, {2, 1}};
  p = raw(step);
  remove_zigzags(p, kThreshold);
  EXPECT_EQ(p.size(), step.size());
  remove_zigzags(p, 0.25 * std::numbers::pi);
  EXPECT_EQ(p.y, (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(p.z, (std::vector<double>{0, 0.5, 1}));
}

TEST(Bounds, DeleteInYAndClipInZ) {
  RawPoints p = raw({{-3, 1}, {-1, 2}, {0, 9}, {1, -9}, {3, 1}});
  delete_outside_y(p, -1, 1);
  EXPECT_EQ(p.y, (std::vector<double>{-1, 0, 1}));
  clip_z(p, 0, 3);
  EXPECT_EQ(p.z, (std::vector<double>{2, 3, 0}));
}

TEST(Bounds, CountOnlyIfTheMinimumIsBelowTheMaximum) {
  RawPoints p = raw({{-3, 1}, {-1, 2}, {5, 9}});
  delete_outside_y(p, 1, 0);
  delete_outside_y(p, 0, 0);
  clip_z(p, 1, 0);
  EXPECT_EQ(p.size(), 3u);
  EXPECT_EQ(p.z[2], 9);
}

TEST(ZPointsUp, RailIsJudgedByItsSides) {
  const RawPoints down = raw(testing::rail_points());
  EXPECT_FALSE(z_points_up(down, Body::rail));
  EXPECT_TRUE(z_points_up(mirrored(down, false, true), Body::rail));
  EXPECT_TRUE(z_points_up(mirrored(reversed(down), false, true), Body::rail));
}

TEST(ZPointsUp, RailWithAFlatStartIsJudgedByItsLastPoints) {
  std::vector<Point> points;
  for (int i = 0; i <= 50; ++i) points.push_back({1.0 * i, i < 40 ? 0.0 : 1.0 * (i - 40)});
  EXPECT_FALSE(z_points_up(raw(points), Body::rail));
  EXPECT_TRUE(z_points_up(mirrored(raw(points), false, true), Body::rail));
}

TEST(ZPointsUp, WheelIsJudgedByWhereItsExtremesLie) {
  // The cone falls to its smallest z at the field side, which is an end.
  const RawPoints down = raw(testing::wheel_points());
  EXPECT_FALSE(z_points_up(down, Body::wheel));
  EXPECT_TRUE(z_points_up(mirrored(down, false, true), Body::wheel));
}

TEST(ZPointsUp, WheelWithInnerExtremesIsComparedWithItsChord) {
  std::vector<Point> points;
  for (int i = -50; i <= 50; ++i) {
    const double y = -i;
    points.push_back({y, 10.0 * std::exp(-y * y / 400.0) - 1e-3 * std::exp(-std::pow(std::abs(y) - 40.0, 2) / 4.0)});
  }
  EXPECT_FALSE(z_points_up(raw(points), Body::wheel));
  EXPECT_TRUE(z_points_up(mirrored(raw(points), false, true), Body::wheel));
}

TEST(OrderIsWrong, FollowsTheDirectionAtTheExtreme) {
  const RawPoints rail = raw(testing::rail_points()), wheel = raw(testing::wheel_points());
  EXPECT_FALSE(order_is_wrong(rail, Body::rail));
  EXPECT_TRUE(order_is_wrong(reversed(rail), Body::rail));
  EXPECT_TRUE(order_is_wrong(mirrored(rail, true, false), Body::rail));
  EXPECT_FALSE(order_is_wrong(wheel, Body::wheel));
  EXPECT_TRUE(order_is_wrong(reversed(wheel), Body::wheel));
}

TEST(OrderIsWrong, FlatProfilesAreJudgedAtTheirEnd) {
  const RawPoints flat = raw({{0, 0}, {1, 0}, {2, 0}});
  EXPECT_FALSE(order_is_wrong(flat, Body::rail));
  EXPECT_TRUE(order_is_wrong(flat, Body::wheel));
}

TEST(OrderIsWrong, SharpCornerIsDecidedByTheTurn) {
  // The blade of a switch, overhanging: at its tip y runs back for a moment.
  const RawPoints blade = raw({{0, 10}, {3, 5}, {2, 0}, {1.5, -2}, {1.8, -1}, {8, 0.5}, {30, 1}});
  EXPECT_FALSE(order_is_wrong(blade, Body::rail));
  EXPECT_TRUE(order_is_wrong(reversed(blade), Body::rail));
  const RawPoints hook = raw({{0, 0}, {-1, 6}, {-0.9, 3}, {-10, 1}});
  EXPECT_TRUE(order_is_wrong(hook, Body::wheel) != order_is_wrong(reversed(hook), Body::wheel));
  EXPECT_FALSE(order_is_wrong(raw({{30, 0}, {0, 1}, {-2, 20}, {-1, 30}, {-4, 15}}), Body::wheel));
}

bool crosses_brute_force(const RawPoints& p) {
  const auto side = [&](std::size_t a, std::size_t b, std::size_t c) {
    return (p.y[b] - p.y[a]) * (p.z[c] - p.z[a]) - (p.z[b] - p.z[a]) * (p.y[c] - p.y[a]);
  };
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < p.size(); ++j)
      if (side(i, i + 1, j) * side(i, i + 1, j + 1) < 0 && side(j, j + 1, i) * side(j, j + 1, i + 1) < 0) return true;
  return false;
}

TEST(CrossesItself, AgreesWithTestingAllPairs) {
  std::mt19937 random(20240501);
  std::uniform_real_distribution<double> step(-1.0, 1.0);
  int crossing = 0;
  for (int trial = 0; trial < 400; ++trial) {
    RawPoints p;
    double y = 0.0, z = 0.0;
    const double drift = 0.02 * (trial % 40);
    for (int i = 0; i < 5 + trial % 90; ++i) {
      p.add(y, z, i + 1);
      y += drift + step(random);
      z += step(random);
    }
    std::size_t first = 0, second = 0;
    const bool expected = crosses_brute_force(p);
    crossing += expected;
    ASSERT_EQ(crosses_itself(p, first, second), expected) << trial;
    if (expected) {
      EXPECT_LT(first + 1, second);
    }
  }
  EXPECT_GT(crossing, 50);
  EXPECT_LT(crossing, 350);
}

TEST(CrossesItself, GivesUpOnATangleInsteadOfTryingForever) {
  RawPoints p;
  p.file = "sample";
  for (int i = 0; i < 30'000; ++i) p.add(i % 2 + 1e-9 * i, i % 2, i + 1);
  std::size_t first = 0, second = 0;
  TREADMARK_EXPECT_ERROR(crosses_itself(p, first, second), "too tangled", 0, 0);
}

TEST(CrossesItself, ALongPlainProfileIsQuick) {
  RawPoints p;
  for (int i = 0; i < 1'000'000; ++i) p.add(1e-4 * i, std::sin(1e-3 * i), i + 1);
  std::size_t first = 0, second = 0;
  EXPECT_FALSE(crosses_itself(p, first, second));
}

TEST(TotalLength, AddsTheChords) { EXPECT_DOUBLE_EQ(total_length(raw({{0, 0}, {3, 4}, {3, 10}})), 11.0); }

}  // namespace
}  // namespace treadmark::io::profiles
