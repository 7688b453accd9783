// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/rough_axis.hpp"

#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

using ::testing::HasSubstr;
using tests::kPi;

TEST(RoughAxis, OfAWheelInAnyFrame) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Pose X = tests::some_frame(seed);
    const RoughAxis found = rough_revolution(tests::flanged_elements(Body::wheel, 2.0 * kPi, 0.0, 3e-3, X, seed));
    const auto error = tests::axis_error(found.axis, X.origin, X.rotation.col(1));
    EXPECT_LT(error.angle, 5e-4) << seed;
    EXPECT_LT(error.distance, 0.3e-3) << seed;
    EXPECT_NEAR(found.axis.direction.norm(), 1.0, 1e-12);
    EXPECT_GT(found.inliers, 0.97);
    // normals off by 3 mrad pass the axis at 0.45 m in about 1.4 mm
    EXPECT_NEAR(found.residual, 1.4e-3, 0.3e-3);
  }
}

TEST(RoughAxis, OfAWheelWithAFifthOfForeignElements) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Pose X = tests::some_frame(10 + seed);
    const RoughAxis found = rough_revolution(tests::flanged_elements(Body::wheel, 2.0 * kPi, 0.2, 3e-3, X, seed));
    const auto error = tests::axis_error(found.axis, X.origin, X.rotation.col(1));
    EXPECT_LT(error.angle, 1.5e-3) << seed;
    EXPECT_LT(error.distance, 0.8e-3) << seed;
    EXPECT_NEAR(found.inliers, 0.8, 0.04);
  }
}

TEST(RoughAxis, OfPartsOfTheCircumference) {
  for (const double arc : {kPi, 0.5 * kPi, kPi / 3.0, kPi / 6.0})
    for (const double foreign : {0.0, 0.2}) {
      const Pose X = tests::some_frame(21);
      const RoughAxis found = rough_revolution(tests::flanged_elements(Body::wheel, arc, foreign, 2e-3, X, 5));
      const auto error = tests::axis_error(found.axis, X.origin, X.rotation.col(1));
      EXPECT_LT(error.angle, 3e-3) << arc << ' ' << foreign;
      EXPECT_LT(error.distance, 3e-3) << arc << ' ' << foreign;
    }
}

TEST(RoughAxis, DirectionOfARailInAnyFrame) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    for (const double foreign : {0.0, 0.2}) {
      const Pose X = tests::some_frame(seed);
      const RoughAxis found = rough_sweep(tests::flanged_elements(Body::rail, 0.8, foreign, 3e-3, X, seed));
      EXPECT_LT(found.axis.direction.cross(X.rotation.col(0)).norm(), 5e-4) << seed << ' ' << foreign;
      // a random normal is perpendicular to the direction within 4.685 deviations of 3 mrad once in 70 times
      EXPECT_NEAR(found.inliers, 1.0 - foreign, 0.04);
      EXPECT_NEAR(found.residual, 3e-3, 0.7e-3);
    }
}

/// Elements of whatever: (position, normal) of two random numbers.
SurfaceElements object(const std::function<std::pair<Vec3, Vec3>(Random&)>& element, double radius,
                       double noise = 3e-3) {
  Random random(1);
  SurfaceElements out;
  out.radius = radius;
  const Pose X = tests::some_frame(3);
  out.centre = X.origin;
  for (int k = 0; k < 3000; ++k) {
    const auto [p, n] = element(random);
    tests::add_element(out, X, p, n, noise, random);
  }
  return out;
}

SurfaceElements ellipsoid(const Vec3& half, double noise = 3e-3) {
  return object(
      [&](Random& random) {
        const Vec3 n = tests::gaussian_vector(random).normalized();
        return std::pair{Vec3(half.cwiseProduct(n)), Vec3(n.cwiseQuotient(half).normalized())};
      },
      half.maxCoeff(), noise);
}
SurfaceElements plane(double noise = 3e-3) {
  return object(
      [](Random& random) {
        const double x = random.uniform(), y = random.uniform();
        return std::pair{Vec3(x, y, 0.0), Vec3(Vec3::UnitZ())};
      },
      0.7, noise);
}
SurfaceElements box() {
  return object(
      [](Random& random) {
        Vec3 p = tests::in_cube(random, 0.5), n = Vec3::Zero();
        const auto side = static_cast<Eigen::Index>(3.0 * random.uniform());
        n[side] = random.uniform() < 0.5 ? -1.0 : 1.0;
        p[side] = 0.5 * n[side];
        return std::pair{p, n};
      },
      0.87);
}
SurfaceElements anything() {
  return object(
      [](Random& random) {
        return std::pair{tests::in_cube(random, 0.5), Vec3(tests::gaussian_vector(random).normalized())};
      },
      0.8);
}

TEST(RoughAxis, RefusesWhatIsNoWheel) {
  for (const auto& [name, elements] :
       {std::pair{"plane", plane()}, std::pair{"exact plane", plane(0.0)},
        std::pair{"sphere", ellipsoid({0.4, 0.4, 0.4})}, std::pair{"exact sphere", ellipsoid({0.4, 0.4, 0.4}, 0.0)},
        std::pair{"anything", anything()}}) {
    const auto error = tests::error_of([&] { rough_revolution(elements); });
    ASSERT_TRUE(error) << name;
    EXPECT_EQ(error->kind(), ErrorKind::input_data) << name;
    EXPECT_THAT(error->message(), HasSubstr("the scan is no wheel")) << name;
    EXPECT_FALSE(error->advice().empty());
  }
}

TEST(RoughAxis, RefusesWhatIsNoRail) {
  for (const auto& [name, elements] :
       {std::pair{"plane", plane()}, std::pair{"sphere", ellipsoid({0.4, 0.4, 0.4})},
        std::pair{"ellipsoid", ellipsoid({0.5, 0.4, 0.3})}, std::pair{"anything", anything()}}) {
    const auto error = tests::error_of([&] { rough_sweep(elements); });
    ASSERT_TRUE(error) << name;
    EXPECT_EQ(error->kind(), ErrorKind::input_data) << name;
    EXPECT_THAT(error->message(), HasSubstr("the scan is no rail")) << name;
    EXPECT_FALSE(error->advice().empty());
  }
}

TEST(RoughAxis, OfABoxIsAlongOneOfItsEdges) {
  // swept along each of three edges: any will do, later steps refuse it
  const Pose X = tests::some_frame(3);
  const RoughAxis found = rough_sweep(box());
  EXPECT_GT((X.rotation.transpose() * found.axis.direction).cwiseAbs().maxCoeff(), 1.0 - 1e-5);
  EXPECT_NEAR(found.inliers, 2.0 / 3.0, 0.05);
}

}  // namespace
}  // namespace treadmark::scans
