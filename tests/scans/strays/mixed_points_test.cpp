// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/strays/mixed_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/core/random.hpp"

namespace treadmark::scans {
namespace {

constexpr int kScanRows = 60, kScanBeams = 200;

/// A plane 5 m away before one that is 6 m away, row after row from a station; where one ends each row has a point
/// between.
PointCloud two_planes() {
  PointCloud out;
  const Vec3 station(1.0, 2.0, 3.0);
  out.stations[0] = station;
  Random random(1);
  constexpr double kStep = 1e-3, kNoisy = 0.5e-3;
  for (int row = 0; row < kScanRows; ++row)
    for (int beam = 0; beam < kScanBeams; ++beam) {
      const double azimuth = kStep * beam, elevation = kStep * row;
      const int edge = kScanBeams / 2;
      const double plane = beam < edge ? 5.0 : beam == edge ? 5.5 : 6.0;
      const Vec3 direction(1.0, std::tan(azimuth), std::tan(elevation));
      out.points.push_back(station + (plane + kNoisy * (random.uniform() - 0.5)) * direction);
    }
  return out;
}

TEST(MixedPoints, LieAlongTheBeam) {
  const PointCloud cloud = two_planes();
  const MixedPoints found = find_mixed_points(cloud);
  EXPECT_TRUE(found.in_order);
  // in each row the point between, and the edges beside it
  EXPECT_EQ(found.count, static_cast<std::size_t>(3 * kScanRows));
  for (int row = 0; row < kScanRows; ++row)
    for (int off = -1; off <= 1; ++off)
      EXPECT_EQ(found.of_point[static_cast<std::size_t>(row * kScanBeams + kScanBeams / 2 + off)], 1) << row;
}

TEST(MixedPoints, AreNoSurfaceSeenAtAGrazingAngle) {
  PointCloud cloud = two_planes();
  // in the middle of each row a face that leads along the beam, nearly
  const Vec3 station = cloud.stations.at(0);
  constexpr int kFace = 8;
  constexpr double kDeep = 0.06;
  for (int row = 0; row < kScanRows; ++row)
    for (int k = 0; k < kFace; ++k) {
      Vec3& p = cloud.points[static_cast<std::size_t>(row * kScanBeams + kScanBeams / 4 + k)];
      p = station + (1.0 + kDeep * k / 5.0) * (p - station);
    }
  const MixedPoints found = find_mixed_points(cloud);
  for (int row = 0; row < kScanRows; ++row)
    for (int k = 1; k + 1 < kFace; ++k)
      EXPECT_EQ(found.of_point[static_cast<std::size_t>(row * kScanBeams + kScanBeams / 4 + k)], 0) << row << ' ' << k;
}

TEST(MixedPoints, NeedTheOrderAndTheStation) {
  PointCloud cloud = two_planes();
  cloud.stations.clear();
  EXPECT_EQ(find_mixed_points(cloud).count, 0u);
  cloud = two_planes();
  Random random(2);
  for (std::size_t i = cloud.points.size() - 1; i > 0; --i)
    std::swap(cloud.points[i], cloud.points[random.bits() % (i + 1)]);
  const MixedPoints found = find_mixed_points(cloud);
  EXPECT_FALSE(found.in_order);
  EXPECT_EQ(found.count, 0u);
}

TEST(MixedPoints, OfSeveralStationsEachHasItsOwn) {
  PointCloud one = two_planes(), cloud = one;
  cloud.points.insert(cloud.points.end(), one.points.begin(), one.points.end());
  cloud.passes.assign(one.points.size(), 1);
  cloud.passes.resize(cloud.points.size(), 2);
  cloud.stations = {{1, one.stations.at(0)}, {2, one.stations.at(0)}};
  const MixedPoints found = find_mixed_points(cloud);
  EXPECT_EQ(found.count, static_cast<std::size_t>(2 * 3 * kScanRows));
}

}  // namespace
}  // namespace treadmark::scans
