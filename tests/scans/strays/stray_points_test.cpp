// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/strays/stray_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/random.hpp"

namespace treadmark::scans {
namespace {

constexpr double kStrayStep = 1e-3;

/// A scan with all that strays: a wavy patch and half a tube far from it (both real), single points and blobs.
struct PlantedScan {
  std::vector<Vec3> points;
  std::vector<Stray> truth;
};

PlantedScan planted_scan() {
  PlantedScan scan;
  Random random(7);
  const auto add = [&](const Vec3& p, Stray kind) {
    scan.points.push_back(p);
    scan.truth.push_back(kind);
  };
  const auto noise = [&] { return 0.05 * kStrayStep * (2.0 * random.uniform() - 1.0); };
  const auto jitter = [&] { return 0.7 * kStrayStep * (random.uniform() - 0.5); };
  for (int i = 0; i < 150; ++i)
    for (int j = 0; j < 100; ++j) {
      const double x = i * kStrayStep + jitter(), y = j * kStrayStep + jitter();
      add({x, y, 5.0 * kStrayStep * std::sin(40.0 * x) + noise()}, Stray::no);
    }
  const double radius = 30.0 * kStrayStep;
  for (int i = 0; i < 90; ++i)
    for (int j = 0; j < 60; ++j) {
      const double angle = std::numbers::pi * i / 90.0, r = radius + noise();
      add({0.4 + r * std::cos(angle), j * kStrayStep + jitter(), r * std::sin(angle)}, Stray::no);
    }
  for (int i = 0; i < 200; ++i)  // at least 10 steps above everything
    add({0.5 * random.uniform(), 0.1 * random.uniform(), 0.06 + 0.2 * random.uniform()}, Stray::outlier);
  for (int blob = 0; blob < 3; ++blob)  // 60 points each: dense in themselves, 1 % of the patch are 150
    for (int i = 0; i < 60; ++i)
      add({0.05 + 0.1 * blob + 4.0 * kStrayStep * random.uniform(), 0.05 + 4.0 * kStrayStep * random.uniform(),
           -0.05 - 4.0 * kStrayStep * random.uniform()},
          Stray::cluster);
  return scan;
}

TEST(StrayPoints, FindsWhatWasPlantedAndKeepsTheSurface) {
  const PlantedScan scan = planted_scan();
  const StrayResult result = find_strays(scan.points, {});
  std::size_t surface = 0, lost = 0, strays = 0, missed = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i)
    if (scan.truth[i] == Stray::no) {
      ++surface;
      lost += result.of_point[i] != Stray::no ? 1 : 0;
    } else {
      ++strays;
      missed += result.of_point[i] == Stray::no ? 1 : 0;
    }
  EXPECT_LT(static_cast<double>(lost), 1e-3 * static_cast<double>(surface));
  EXPECT_EQ(missed, 0U) << "of " << strays;
  for (std::size_t i = scan.points.size() - 180; i < scan.points.size(); ++i)
    EXPECT_EQ(result.of_point[i], Stray::cluster) << i;
  EXPECT_GE(result.clusters, 3U);
  EXPECT_EQ(result.outliers + result.cluster_points,
            static_cast<std::size_t>(
                std::count_if(result.of_point.begin(), result.of_point.end(), [](Stray s) { return s != Stray::no; })));
  EXPECT_NEAR(result.spacing, kStrayStep, 0.25 * kStrayStep);
}

TEST(StrayPoints, LengthsInTheSettingsHaveTheUnitOfThePoints) {
  // On a square grid the four nearest neighbours are one step away, so that of four the mean is exactly 1 step inside.
  std::vector<Vec3> points;
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j) points.emplace_back(i * kStrayStep, j * kStrayStep, 0.0);
  for (int i = 0; i < 30; ++i) points.emplace_back(i * kStrayStep, 38.0 * kStrayStep, 0.0);  // a line 9 steps away
  StraySettings settings;
  settings.neighbours = 4;
  settings.outlier_distance = 100.0 * kStrayStep;
  settings.least_cluster = 0.1;
  settings.cluster_gap = 9.01 * kStrayStep;
  EXPECT_EQ(find_strays(points, settings).clusters, 0U);
  settings.cluster_gap = 8.99 * kStrayStep;
  EXPECT_EQ(find_strays(points, settings).cluster_points, 30U);
  settings.least_cluster = 0.02;  // 18 points
  EXPECT_EQ(find_strays(points, settings).clusters, 0U);
  settings.outlier_distance = 1.01 * kStrayStep;  // the rims have farther neighbours; of the line all have
  const StrayResult rims = find_strays(points, settings);
  EXPECT_EQ(rims.outliers, 900U - 28U * 28U + 30U);
}

TEST(StrayPoints, NeitherScaleNorPlaceNorOrderNorThreadsMatter) {
  const PlantedScan scan = planted_scan();
  const StrayResult expected = find_strays(scan.points, {});
  std::vector<std::size_t> order(scan.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(3);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.bits() % i]);
  for (const double scale : {1e-9, 1.0, 1e6}) {
    std::vector<Vec3> other;
    for (const std::size_t i : order) other.push_back(scale * (scan.points[i] + Vec3(3.0, -2.0, 1.0)));
    const ThreadLimit one(1);
    const StrayResult result = find_strays(other, {});
    EXPECT_NEAR(result.spacing, scale * expected.spacing, 1e-9 * scale * expected.spacing);
    for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(result.of_point[i], expected.of_point[order[i]]) << scale;
  }
}

TEST(StrayPoints, ManyEqualPointsAreNoProblem) {
  std::vector<Vec3> points;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) points.emplace_back(i * kStrayStep, j * kStrayStep, 0.0);
  for (int i = 0; i < 100; ++i) points.emplace_back(5.0 * kStrayStep, 5.0 * kStrayStep, 0.0);
  const StrayResult result = find_strays(points, {});
  EXPECT_EQ(result.outliers + result.cluster_points, 0U);

  const std::vector<Vec3> all_equal(200, Vec3(1.0, 2.0, 3.0));
  EXPECT_THROW(find_strays(all_equal, {}), Error);
}

TEST(StrayPoints, BadInputIsAnError) {
  std::vector<Vec3> points(99, Vec3::Zero());
  const auto kind = [&](const StraySettings& settings) {
    try {
      find_strays(points, settings);
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::numerical;
  };
  EXPECT_EQ(kind({}), ErrorKind::input_data);
  points = planted_scan().points;
  points[17].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(kind({}), ErrorKind::input_data);
  points.erase(points.begin() + 17);
  EXPECT_EQ(kind({.neighbours = 0}), ErrorKind::configuration);
  EXPECT_EQ(kind({.outlier_distance = -1.0}), ErrorKind::configuration);
  EXPECT_EQ(kind({.cluster_gap = std::numeric_limits<double>::quiet_NaN()}), ErrorKind::configuration);
  EXPECT_EQ(kind({.least_cluster = 1.5}), ErrorKind::configuration);
}

}  // namespace
}  // namespace treadmark::scans
