// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/place.hpp"

#include <cmath>
#include <iostream>
#include <numbers>

#include <gtest/gtest.h>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/scans/support/simple_cloud.hpp"

namespace treadmark::scans {
namespace {

constexpr double kPi = std::numbers::pi;

/// What is wrong with a wheel's frame: the rotation about the axle is free.
struct AxleError {
  double angle, position, y;
};
AxleError axle_error(const Pose& found, const Pose& truth) {
  const Vec3 a = found.rotation.col(1), b = truth.rotation.col(1);
  const Vec3 apart = found.origin - truth.origin;
  return {a.cross(b).norm() + (a.dot(b) < 0.0 ? 10.0 : 0.0), (apart - b * b.dot(apart)).norm(), b.dot(apart)};
}

TEST(Place, WheelWithAFlatInAnyFrame) {
  const double radius = 0.46;
  const auto wheel = create_surface({Body::wheel, radius, StandardProfile{"S1002"}, {.flats = {{.length = 0.16, .depth = 1.4e-3, .theta_center = 0.7}}}});
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const auto cloud = tests::simple_cloud(*wheel, Body::wheel, -kPi, kPi, -69e-3, 60e-3, 1000, 300, 30e-6, 0.01, tests::some_frame(seed), seed);
    RoughPlace rough = find_roughly(cloud.points_C, {}, Body::wheel);
    EXPECT_EQ(unit_by_size(Body::wheel, rough.size), LengthUnit::metre);
    PlaceSettings settings;
    settings.body = Body::wheel;
    settings.nominal = Section(tests::nominal_points("S1002", Body::wheel));
    const Placement placed = place(cloud.points_C, {}, rough, settings);
    const AxleError error = axle_error(placed.X_CS, cloud.X_CS);
    std::cout << "angle " << error.angle << " position " << error.position << " y " << error.y << " R " << placed.nominal_radius - radius << " scatter "
              << placed.scatter << " se " << placed.position_error << " " << placed.direction_error << " rounds " << placed.iterations << " undamaged "
              << placed.undamaged << " rough " << rough.rough.residual << ' ' << rough.rough.inliers << '\n';
    EXPECT_LT(error.angle, 20e-6);
    EXPECT_LT(error.position, 10e-6);
    EXPECT_LT(std::fabs(error.y), 20e-6);
    EXPECT_LT(std::fabs(placed.nominal_radius - radius), 10e-6);
    EXPECT_NEAR(placed.scatter, 30e-6, 3e-6);
  }
}

TEST(Place, RailWithASquatInAnyFrame) {
  const auto rail = create_surface({Body::rail, 0.0, StandardProfile{"60E1"}, {.squats = {{.length = 40e-3, .width = 30e-3, .depth = 0.5e-3}}}});
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const auto cloud = tests::simple_cloud(*rail, Body::rail, -0.3, 0.3, -35e-3, 35e-3, 1500, 150, 20e-6, 0.01, tests::some_frame(seed), seed);
    RoughPlace rough = find_roughly(cloud.points_C, {}, Body::rail);
    EXPECT_EQ(unit_by_size(Body::rail, rough.size), LengthUnit::metre);
    PlaceSettings settings;
    settings.body = Body::rail;
    settings.nominal = Section(tests::nominal_points("60E1", Body::rail));
    settings.forward = cloud.X_CS.rotation.col(0);
    const Placement placed = place(cloud.points_C, {}, rough, settings);
    const Vec3 y_error = placed.X_CS.apply_inverse(cloud.X_CS.origin);
    const Mat3 turn = placed.X_CS.rotation.transpose() * cloud.X_CS.rotation;
    std::cout << "origin " << y_error.transpose() << " turn " << (turn - Mat3::Identity()).norm() << " scatter " << placed.scatter << " rounds " << placed.iterations
              << " undamaged " << placed.undamaged << '\n';
    EXPECT_LT((turn - Mat3::Identity()).norm(), 100e-6);
    EXPECT_LT(std::fabs(y_error.y()), 20e-6);
    EXPECT_LT(std::fabs(y_error.z()), 10e-6);
  }
}

}  // namespace
}  // namespace treadmark::scans
