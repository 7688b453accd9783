// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/even_sample.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/core/random.hpp"

namespace treadmark::scans {
namespace {

TEST(EvenSample, DensePartsAndLonePointsDoNotCount) {
  // a plane of 1 m x 0.2 m; the part beyond x = 0.9 is scanned 20 times more densely; as many outliers as sparse points
  // in a metre around
  Random random(3);
  std::vector<Vec3> points;
  for (int k = 0; k < 100'000; ++k) points.emplace_back(random.uniform(), 0.2 * random.uniform(), 0.0);
  for (int k = 0; k < 200'000; ++k) points.emplace_back(0.9 + 0.1 * random.uniform(), 0.2 * random.uniform(), 0.0);
  for (int k = 0; k < 30'000; ++k)
    points.emplace_back(2.0 * random.uniform() - 0.5, 2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0);
  constexpr double kCube = 8e-3;
  const auto sample = even_sample(points, {}, Vec3(0.5, 0.1, 0.0031), kCube, 50'000);
  double dense = 0.0, off = 0.0;
  for (const Vec3& p : sample) {
    off += std::fabs(p.z()) > 1e-12 ? 1.0 : 0.0;
    dense += p.z() == 0.0 && p.x() > 0.9 ? 1.0 : 0.0;
  }
  const auto all = static_cast<double>(sample.size());
  EXPECT_LT(off / all, 0.01) << "of 9 % outliers";
  EXPECT_LT(dense / all, 0.35) << "a tenth of the area held 2/3 of the points";
  EXPECT_GT(sample.size(), 5'000u);
  EXPECT_LT(sample.size(), 50'000u);
}

TEST(EvenSample, FewPointsAreAllTakenAndFlagsAreKept) {
  std::vector<Vec3> points;
  for (int i = 0; i < 50; ++i)
    for (int k = 0; k < 50; ++k) points.emplace_back(1e-3 * (i + 0.5), 1e-3 * (k + 0.5), 0.0);
  EXPECT_EQ(even_sample(points, {}, Vec3::Zero(), 5e-3, 100'000).size(), points.size());
  std::vector<std::uint8_t> keep(points.size(), 1);
  for (std::size_t i = 0; i < 1250; ++i) keep[i] = 0;
  for (const Vec3& p : even_sample(points, keep, Vec3::Zero(), 5e-3, 100'000)) EXPECT_GT(p.x(), 25e-3);
}

}  // namespace
}  // namespace treadmark::scans
