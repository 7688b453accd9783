// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/strays/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "treadmark/core/parallel.hpp"
#include "treadmark/core/random.hpp"

namespace treadmark::scans {
namespace {

std::vector<std::vector<Neighbour>> neighbourhoods(const std::vector<Vec3>& points, int count) {
  std::vector<std::vector<Neighbour>> found(points.size());
  for_each_neighbourhood(points, count, [&](std::uint32_t i, std::span<const Neighbour> near) {
    found[i].assign(near.begin(), near.end());
  });
  return found;
}

std::vector<Neighbour> by_sorting_all(const std::vector<Vec3>& points, std::uint32_t self, std::size_t count) {
  std::vector<Neighbour> all;
  for (std::uint32_t j = 0; j < points.size(); ++j)
    if (j != self) all.push_back({j, (points[j] - points[self]).squaredNorm()});
  std::stable_sort(all.begin(), all.end(),
                   [](const Neighbour& a, const Neighbour& b) { return a.squared_distance < b.squared_distance; });
  all.resize(std::min(count, all.size()));
  return all;
}

TEST(Neighbours, AreTheNearestOfAllPoints) {
  constexpr double kRounding = 1e-15;  // of squares of lengths below 1
  Random random(5);
  std::vector<Vec3> points;
  for (int i = 0; i < 3000; ++i) points.emplace_back(random.uniform(), 0.1 * random.uniform(), 0.01 * random.uniform());
  for (const int count : {1, 6, 24}) {
    const auto found = neighbourhoods(points, count);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const auto expected = by_sorting_all(points, i, static_cast<std::size_t>(count));
      ASSERT_EQ(found[i].size(), expected.size());
      for (std::size_t k = 0; k < expected.size(); ++k) {
        ASSERT_EQ(found[i][k].index, expected[k].index) << i << ", " << k;
        ASSERT_NEAR(found[i][k].squared_distance, expected[k].squared_distance, kRounding);
      }
    }
  }
}

TEST(Neighbours, OfEquallyNearOnesTheLowerIndexComesFirst) {
  std::vector<Vec3> points;  // of a grid four are one step away
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) points.emplace_back(i, j, 0.0);
  const auto found = neighbourhoods(points, 4);
  const std::uint32_t middle = 10 * 20 + 10;
  std::vector<std::uint32_t> index;
  for (const Neighbour& near : found[middle]) index.push_back(near.index);
  EXPECT_EQ(index, (std::vector<std::uint32_t>{middle - 20, middle - 1, middle + 1, middle + 20}));
}

TEST(Neighbours, OfFewPointsAreAllOthersAndNoPointIsItsOwn) {
  std::vector<Vec3> points(40, Vec3(1.0, 2.0, 3.0));  // more equal ones than are asked for
  points.emplace_back(1.0, 2.0, 4.0);
  const auto few = neighbourhoods(points, 8);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(few[i].size(), 8U);
    for (const Neighbour& near : few[i]) {
      EXPECT_NE(near.index, i);
      EXPECT_EQ(near.squared_distance, i == 40 ? 1.0 : 0.0);
    }
  }
  for (const auto& all : neighbourhoods(points, 100)) EXPECT_EQ(all.size(), 40U);
  EXPECT_TRUE(neighbourhoods({}, 3).empty());
  EXPECT_TRUE(neighbourhoods({Vec3::Zero()}, 3).front().empty());
}

TEST(Neighbours, DoNotDependOnThreads) {
  Random random(8);
  std::vector<Vec3> points;
  for (int i = 0; i < 10000; ++i) points.emplace_back(random.bits() % 30, random.bits() % 30, random.bits() % 30);
  const auto expected = neighbourhoods(points, 7);
  const ThreadLimit one(1);
  const auto found = neighbourhoods(points, 7);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < 7; ++k) ASSERT_EQ(found[i][k].index, expected[i][k].index);
}

}  // namespace
}  // namespace treadmark::scans
