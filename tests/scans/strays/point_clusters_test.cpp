// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/strays/point_clusters.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "treadmark/core/random.hpp"

namespace treadmark::scans {
namespace {

/// Single linkage by trying all pairs.
std::vector<std::uint32_t> by_brute_force(const std::vector<Vec3>& points, double gap) {
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> group(points.size(), kNone);
  std::uint32_t groups = 0;
  for (std::size_t first = 0; first < points.size(); ++first) {
    if (group[first] != kNone) continue;
    std::vector<std::size_t> open{first};
    group[first] = groups;
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      for (std::size_t j = 0; j < points.size(); ++j)
        if (group[j] == kNone && (points[i] - points[j]).squaredNorm() <= gap * gap) {
          group[j] = groups;
          open.push_back(j);
        }
    }
    ++groups;
  }
  return group;
}

TEST(PointClusters, AreThoseOfAllPairs) {
  Random random(11);
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec3> points;
    for (int i = 0; i < 400; ++i)
      points.emplace_back(random.uniform() - 0.5, random.uniform() - 0.5,
                          round % 2 == 0 ? 0.0 : random.uniform() - 0.5);
    for (const double gap : {0.01, 0.03, 0.06, 0.1, 0.15, 2.0})
      ASSERT_EQ(cluster_points(points, gap), by_brute_force(points, gap)) << round << ", gap " << gap;
  }
}

TEST(PointClusters, OfNothingAreNone) { EXPECT_TRUE(cluster_points({}, 1.0).empty()); }

}  // namespace
}  // namespace treadmark::scans
