// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/voxels.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

using Cell = std::array<int, 3>;  // z first: the order of the keys
using Naive = std::map<Cell, std::vector<std::uint32_t>>;

Naive sorted_naively(const std::vector<Vec3>& points, const Vec3& origin, double size,
                     const std::vector<std::uint8_t>& keep) {
  Naive out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!keep.empty() && keep[i] == 0) continue;
    const Vec3 p = (points[i] - origin) / size;
    if (!(p.cwiseAbs().maxCoeff() < 1048570.0)) continue;
    out[{static_cast<int>(std::floor(p.z())), static_cast<int>(std::floor(p.y())), static_cast<int>(std::floor(p.x()))}]
        .push_back(static_cast<std::uint32_t>(i));
  }
  return out;
}

void expect_same(const Voxels& voxels, const Naive& naive) {
  ASSERT_EQ(voxels.count(), naive.size());
  std::map<Cell, std::size_t> number;
  for (const auto& [cell, inside] : naive) {
    const std::size_t v = number.size();
    const auto found = voxels.points_of(v);
    ASSERT_EQ(std::vector<std::uint32_t>(found.begin(), found.end()), inside) << "cube " << v;
    number[cell] = v;
  }
  for (const auto& [cell, v] : number) {
    std::multiset<std::size_t> expected, visited;
    for (const auto& [other, w] : number)
      if (std::abs(other[0] - cell[0]) <= 1 && std::abs(other[1] - cell[1]) <= 1 && std::abs(other[2] - cell[2]) <= 1)
        expected.insert(w);
    voxels.neighbours(v, [&](std::size_t w) { visited.insert(w); });
    ASSERT_EQ(visited, expected) << "cube " << v;
  }
}

TEST(Voxels, AreThoseOfAMapOfCells) {
  Random random(3);
  std::vector<Vec3> points;
  std::vector<std::uint8_t> keep;
  for (int k = 0; k < 5000; ++k) {
    points.push_back(tests::in_cube(random, k % 2 == 0 ? 0.5 : 0.15));
    keep.push_back(random.uniform() < 0.7 ? 1 : 0);
  }
  const Vec3 origin(0.03, -0.2, 0.11);
  for (const double size : {0.02, 0.1, 3.0}) {
    expect_same(Voxels(points, origin, size), sorted_naively(points, origin, size, {}));
    expect_same(Voxels(points, origin, size, keep), sorted_naively(points, origin, size, keep));
  }
  EXPECT_EQ(Voxels(points, origin, 0.1).size(), 0.1);
}

TEST(Voxels, FarCubesAreNeighboursOfNobodyBeyondTheBorder) {
  // the last cubes of one row and the first ones of the next, and points that belong nowhere
  constexpr double kLast = 1048569.5;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Vec3> points;
  for (const double x : {-kLast, 0.5, kLast})
    for (const double y : {-kLast, -0.5, 0.5, kLast})
      for (const double z : {-kLast, 0.5, 1.5, kLast}) points.emplace_back(x, y, z);
  const std::size_t inside = points.size();
  for (const Vec3& p : {Vec3(2e6, 0, 0), Vec3(0, -2e6, 0), Vec3(0, 0, 1e30), Vec3(nan, 0, 0), Vec3(0, 0, -INFINITY)})
    points.push_back(p);
  const Voxels voxels(points, Vec3::Zero(), 1.0);
  EXPECT_EQ(voxels.count(), inside);
  expect_same(voxels, sorted_naively(points, Vec3::Zero(), 1.0, {}));
}

TEST(Voxels, OfNoPointsAreNone) {
  EXPECT_EQ(Voxels({}, Vec3::Zero(), 1.0).count(), 0u);
  const std::vector<Vec3> points(3, Vec3::Zero());
  const std::vector<std::uint8_t> none(3, 0);
  EXPECT_EQ(Voxels(points, Vec3::Zero(), 1.0, none).count(), 0u);
}

}  // namespace
}  // namespace treadmark::scans
