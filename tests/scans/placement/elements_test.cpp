// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/elements.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

using ::testing::HasSubstr;
using tests::kPi;

/// Half a cylinder of radius 0.4 about y, 0.3 long, with noise [m] along its normals and a part of outliers.
std::vector<Vec3> cylinder(int count, double noise, double outliers, std::uint64_t seed, const Pose& X = {}) {
  Random random(seed);
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const double u = kPi * random.uniform(), y = 0.3 * random.uniform(), r = 0.4 + noise * tests::gaussian(random);
    points.push_back(
        X.apply(random.uniform() < outliers ? tests::in_cube(random, 0.4) : Vec3(r * std::cos(u), y, r * std::sin(u))));
  }
  return points;
}

struct Angles {
  double rms = 0.0;
  double good = 0.0;  ///< part of the elements whose normals are off by less than 5 degrees
};
Angles normals_off(const SurfaceElements& elements, const Pose& X = {}) {
  Angles out;
  double square = 0.0;
  for (std::size_t k = 0; k < elements.position.size(); ++k) {
    const Vec3 p = X.apply_inverse(elements.position[k]);
    const double angle = std::asin(std::min(
        1.0, (X.rotation.transpose() * elements.normal[k]).cross(Vec3(p.x(), 0.0, p.z()).normalized()).norm()));
    if (angle > 0.087) continue;
    square += angle * angle;
    out.good += 1.0;
  }
  out.rms = std::sqrt(square / out.good);
  out.good /= static_cast<double>(elements.position.size());
  return out;
}

TEST(Elements, OfACylinderPointToItsAxis) {
  const Pose X = tests::some_frame(4);
  const auto points = cylinder(60'000, 50e-6, 0.0, 1, X);
  const SurfaceElements elements = find_elements(points);
  ASSERT_GT(elements.position.size(), 500u);
  ASSERT_EQ(elements.normal.size(), elements.position.size());
  ASSERT_EQ(elements.weight.size(), elements.position.size());
  const Angles off = normals_off(elements, X);
  EXPECT_EQ(off.good, 1.0);
  EXPECT_LT(off.rms, 0.02);
  EXPECT_GT(elements.flat_part, 0.9);
  for (std::size_t k = 0; k < elements.position.size(); ++k) {
    const Vec3 p = X.apply_inverse(elements.position[k]);
    // a mean of points on an arc lies within it by its sagitta at most
    EXPECT_NEAR(std::hypot(p.x(), p.z()), 0.4, 0.5 * elements.size * elements.size / 0.4 + 300e-6);
    EXPECT_NEAR(elements.normal[k].norm(), 1.0, 1e-12);
    EXPECT_GT(elements.weight[k], 0.0f);
    EXPECT_LE(elements.weight[k], 1.0f);
  }
  // spacing of points that are evenly spread over the cylinder
  EXPECT_NEAR(elements.spacing, std::sqrt(kPi * 0.4 * 0.3 / 60'000), 0.25 * elements.spacing);
}

TEST(Elements, DoNotMindOutliersAndFlags) {
  auto points = cylinder(40'000, 50e-6, 0.05, 2);
  const Angles off = normals_off(find_elements(points));
  EXPECT_GT(off.good, 0.9);
  // everything that is not kept may be anywhere
  std::vector<std::uint8_t> keep(points.size(), 1);
  const SurfaceElements all = find_elements(points);
  Random random(9);
  for (int k = 0; k < 20'000; ++k) {
    points.push_back(tests::in_cube(random, 5.0));
    keep.push_back(0);
  }
  const SurfaceElements kept = find_elements(points, keep);
  ASSERT_EQ(kept.position.size(), all.position.size());
  EXPECT_EQ(kept.size, all.size);
  for (std::size_t k = 0; k < all.position.size(); ++k) EXPECT_EQ(kept.normal[k], all.normal[k]);
}

TEST(Elements, OfAPlaneLieInIt) {
  Random random(5);
  const Pose X = tests::some_frame(8);
  std::vector<Vec3> points;
  for (int k = 0; k < 20'000; ++k) {
    const double x = random.uniform(), y = random.uniform();
    points.push_back(X.apply({x, y, 20e-6 * tests::gaussian(random)}));
  }
  const SurfaceElements elements = find_elements(points);
  EXPECT_GT(elements.flat_part, 0.99);
  EXPECT_LT((elements.centre - X.apply({0.5, 0.5, 0.0})).norm(), 0.2);
  for (std::size_t k = 0; k < elements.position.size(); ++k) {
    EXPECT_LT(elements.normal[k].cross(X.rotation.col(2)).norm(), 2e-3);
    EXPECT_LT(std::fabs(X.apply_inverse(elements.position[k]).z()), 100e-6);
  }
}

TEST(Elements, AreTheSameInEveryUnit) {
  auto points = cylinder(20'000, 50e-6, 0.02, 6);
  const SurfaceElements metres = find_elements(points);
  for (Vec3& p : points) p *= 1024.0;  // exact in binary
  const SurfaceElements other = find_elements(points);
  ASSERT_EQ(other.position.size(), metres.position.size());
  EXPECT_DOUBLE_EQ(other.size, 1024.0 * metres.size);
  EXPECT_DOUBLE_EQ(other.spacing, 1024.0 * metres.spacing);
  for (std::size_t k = 0; k < metres.position.size(); ++k) {
    EXPECT_LT((other.position[k] - 1024.0 * metres.position[k]).norm(), 1e-9);
    EXPECT_LT(other.normal[k].cross(metres.normal[k]).norm(), 1e-9);
  }
}

/// A bar of 70 mm by 40 mm and corners of 13 mm, points at random: what a rail's head is to planes.
std::vector<Vec3> round_bar(double spacing, double length) {
  constexpr double kHalfWidth = 35e-3, kHalfHeight = 20e-3, kCorner = 13e-3;
  const double width = 2.0 * (kHalfWidth - kCorner), height = 2.0 * (kHalfHeight - kCorner), arc = 0.5 * kPi * kCorner,
               girth = 2.0 * (width + height) + 4.0 * arc;
  Random random(11);
  std::vector<Vec3> points;
  const auto count = static_cast<int>(girth * length / (spacing * spacing));
  for (int k = 0; k < count; ++k) {
    // a quarter of the outline, mirrored
    double s = 0.25 * girth * random.uniform();
    Vec2 p;
    if (s < 0.5 * width)
      p = Vec2(s, kHalfHeight);
    else if ((s -= 0.5 * width) < arc)
      p = Vec2(0.5 * width, 0.5 * height) + kCorner * Vec2(std::sin(s / kCorner), std::cos(s / kCorner));
    else
      p = Vec2(kHalfWidth, 0.5 * height - (s - arc));
    if (random.uniform() < 0.5) p.x() = -p.x();
    if (random.uniform() < 0.5) p.y() = -p.y();
    points.emplace_back(length * random.uniform(), p.x(), p.y());
  }
  return points;
}

TEST(Elements, AreAsSmallAsTheSurfaceTurns) {
  for (const double spacing : {2.9e-3, 2e-3, 1e-3, 0.5e-3}) {
    const SurfaceElements elements = find_elements(round_bar(spacing, 0.5));
    EXPECT_GT(elements.flat_part, 0.6) << spacing;
    EXPECT_LT(elements.size, 10e-3) << spacing;
    const RoughAxis sweep = rough_sweep(elements);
    EXPECT_GT(std::fabs(sweep.axis.direction.x()), 0.9999) << spacing;
  }
}

TEST(Elements, RefuseWhatIsNoSurface) {
  const auto few = tests::error_of([] { find_elements(cylinder(99, 0.0, 0.0, 1)); });
  ASSERT_TRUE(few);
  EXPECT_EQ(few->kind(), ErrorKind::input_data);
  EXPECT_EQ(few->message(), "99 points are too few to find a surface in them");
  const auto kept = tests::error_of([] {
    const auto points = cylinder(5000, 0.0, 0.0, 1);
    std::vector<std::uint8_t> keep(points.size(), 0);
    keep[17] = 1;
    find_elements(points, keep);
  });
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->message(), "1 points are too few to find a surface in them");
  const auto one_place = tests::error_of([] { find_elements(std::vector<Vec3>(500, Vec3(1.0, 2.0, 3.0))); });
  ASSERT_TRUE(one_place);
  EXPECT_EQ(one_place->message(), "nearly all points of the scan lie at one place");
  Random random(2);
  std::vector<Vec3> cloud, line;
  for (int k = 0; k < 20'000; ++k) {
    cloud.push_back(tests::in_cube(random, 0.5));
    line.push_back(Vec3(random.uniform(), 0.0, 0.0) + 1e-5 * tests::gaussian_vector(random));
  }
  for (const auto& points : {cloud, line}) {
    const auto none = tests::error_of([&] { find_elements(points); });
    ASSERT_TRUE(none);
    EXPECT_EQ(none->kind(), ErrorKind::input_data);
    EXPECT_THAT(none->message(), HasSubstr("the points do not form a surface"));
    EXPECT_FALSE(none->advice().empty());
  }
}

}  // namespace
}  // namespace treadmark::scans
