// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/thin.hpp"

#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "treadmark/tests/scans/cleaning/band_samples.hpp"

namespace treadmark::scans {
namespace {

TEST(Thin, OnePointACube) {
  const Vec3 origin(0.3, -2.0, 7.0);
  constexpr double kSize = 5e-3;
  Random random(1);
  std::vector<Vec3> points;
  for (int k = 0; k < 20000; ++k)
    points.push_back(origin + 0.1 * Vec3(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5));
  std::map<std::tuple<long, long, long>, std::pair<Vec3, int>> cubes;  // by z, y, x
  for (const Vec3& p : points) {
    const Vec3 at = (p - origin) / kSize;
    auto [entry, fresh] = cubes.try_emplace(
        {std::lround(std::floor(at.z())), std::lround(std::floor(at.y())), std::lround(std::floor(at.x()))},
        Vec3::Zero(), 0);
    entry->second.first += p - origin;
    ++entry->second.second;
  }
  const ThinnedPoints thinned = thin(points, origin, kSize);
  ASSERT_EQ(thinned.position.size(), cubes.size());
  ASSERT_EQ(thinned.voxels.count(), cubes.size());
  std::size_t v = 0;
  for (const auto& [key, cube] : cubes) {
    EXPECT_EQ(thinned.voxels.points_of(v).size(), static_cast<std::size_t>(cube.second));
    EXPECT_LT((thinned.position[v] - origin - cube.first / cube.second).norm(), 1e-12);
    ++v;
  }
}

TEST(DropDuplicates, AllButTheFirstOfEachPlace) {
  const Band band = tests::straight_band(0.3, 0.06, false);
  auto samples = tests::scattered(band, 300, 60, 1, 10e-6, 1, [](double, double) { return 0.0; });
  const std::size_t fresh = samples.size();
  for (std::size_t i = 0; i < fresh; i += 5) samples.push_back(samples[i]);
  for (std::size_t i = 0; i < fresh; i += 25) samples.push_back(samples[i]);
  std::vector<Vec3> cloud;
  for (const auto& p : samples) cloud.emplace_back(p.a, p.s, p.d);
  // near is not the same
  for (std::size_t i = 2; i < fresh; i += 50) {
    samples.push_back(samples[i]);
    cloud.push_back(cloud[i] + Vec3(0.0, 0.0, 1e-9));
  }
  BandPoints points = tests::sorted(band, 300, 60, samples);
  std::map<std::array<double, 3>, std::uint32_t> first;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) first.try_emplace({cloud[i].x(), cloud[i].y(), cloud[i].z()}, i);
  const std::size_t dropped = drop_duplicates(points, cloud);
  EXPECT_EQ(dropped, cloud.size() - first.size());
  EXPECT_GT(dropped, 4000u);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3& p = cloud[points.index[k]];
    ASSERT_EQ(points.state[k] == PointState::off_band, first.at({p.x(), p.y(), p.z()}) != points.index[k]);
  }
}

}  // namespace
}  // namespace treadmark::scans
