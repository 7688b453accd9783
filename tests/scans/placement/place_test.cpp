// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/place.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

using ::testing::HasSubstr;
using tests::kPi;

constexpr double kRadius = 0.46;

std::shared_ptr<const Surface> flat_wheel() {
  return create_surface({Body::wheel,
                         kRadius,
                         StandardProfile{"S1002"},
                         {.flats = {{.length = 0.16, .depth = 1.4e-3, .theta_center = 0.7}}}});
}
std::shared_ptr<const Surface> squat_rail() {
  return create_surface(
      {Body::rail, 0.0, StandardProfile{"60E1"}, {.squats = {{.length = 40e-3, .width = 30e-3, .depth = 0.5e-3}}}});
}
PlaceSettings with_nominal(Body body) {
  PlaceSettings out;
  out.body = body;
  out.nominal = Section(tests::nominal_points(body == Body::wheel ? "S1002" : "60E1", body));
  return out;
}

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
  const auto wheel = flat_wheel();
  const PlaceSettings settings = with_nominal(Body::wheel);
  for (std::uint64_t seed = 1; seed < 3; ++seed) {
    const auto cloud = tests::simple_cloud(*wheel, Body::wheel, -kPi, kPi, -69e-3, 60e-3, 400, 120, 30e-6, 0.01,
                                           tests::some_frame(seed), seed);
    const RoughPlace rough = find_roughly(cloud.points_C, {}, Body::wheel);
    EXPECT_EQ(unit_by_size(Body::wheel, rough.size), LengthUnit::metre);
    const Placement placed = place(cloud.points_C, {}, rough, settings);
    const AxleError error = axle_error(placed.X_CS, cloud.X_CS);
    EXPECT_LT(error.angle, 10e-6);
    EXPECT_LT(error.position, 3e-6);
    EXPECT_LT(std::fabs(error.y), 3e-6);
    EXPECT_LT(std::fabs(placed.nominal_radius - kRadius), 3e-6);
    // the flat, 5 % of the points, and splines with knots 4 mm apart count as scatter too
    EXPECT_GT(placed.scatter, 29e-6);
    EXPECT_LT(placed.scatter, 36e-6);
    EXPECT_LT(placed.position_error, 2e-6);
    EXPECT_LT(placed.direction_error, 8e-6);
    ASSERT_TRUE(placed.match);
    EXPECT_NEAR(placed.section.v_at(0.0), kRadius, 25e-6);
  }
}

/// Points of a wheel whose flange is 5 mm thinner than that of S1002, its back and its tip as they were; with_back:
/// down to the tread, else from beside the tip on.
std::vector<Vec3> thin_flange(bool with_back, const Pose& frame) {
  const auto smooth = [](double t) { return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t * t * (3.0 - 2.0 * t); };
  std::vector<Vec2> section;
  for (double z = 0.5e-3; with_back && z < 9.5e-3; z += 0.5e-3) section.emplace_back(-70e-3, z);
  for (Vec2 p : tests::nominal_points("S1002", Body::wheel)) {
    if (!with_back && p.x() < -66e-3) continue;
    if (p.x() > -57e-3) p.x() -= 5e-3 * smooth((p.x() + 57e-3) / 10e-3) * smooth((-14e-3 - p.x()) / 18e-3);
    if (section.empty() || (p - section.back()).norm() > 0.7e-3) section.push_back(p);
  }
  std::vector<Vec3> out;
  Random random(3);
  for (int k = 0; k < 300; ++k)
    for (const Vec2& p : section) {
      const double u = 2.0 * kPi * (k + random.uniform()) / 300.0,
                   r = kRadius + p.y() + 10e-6 * tests::gaussian(random);
      out.push_back(frame.apply({r * std::sin(u), p.x(), r * std::cos(u)}));
    }
  return out;
}

TEST(Place, AWornFlangeIsPlacedByItsBack) {
  const Pose frame = tests::some_frame(1);
  const auto placed = [&](bool with_back) {
    const std::vector<Vec3> points = thin_flange(with_back, frame);
    return place(points, {}, find_roughly(points, {}, Body::wheel), with_nominal(Body::wheel));
  };
  const Placement by_back = placed(true), by_fit = placed(false);
  EXPECT_LT(std::fabs(axle_error(by_back.X_CS, frame).y), 0.05e-3);
  EXPECT_GT(std::fabs(by_back.moved_by_back), 2e-3);
  EXPECT_TRUE(by_back.doubts.empty());
  EXPECT_GT(std::fabs(axle_error(by_fit.X_CS, frame).y), 2e-3);
  ASSERT_EQ(by_fit.doubts.size(), 1u);
  EXPECT_EQ(by_fit.doubts.front().name, "tape_line");
}

/// Names of the doubts about what was scanned from y to y.
std::vector<std::string> doubts_of(const Surface& surface, Body body, double y_min, double y_max) {
  const double end = body == Body::wheel ? kPi : 0.3;
  const auto cloud =
      tests::simple_cloud(surface, body, -end, end, y_min, y_max, 300, 100, 20e-6, 0.0, tests::some_frame(2), 2);
  std::vector<std::string> names;
  for (const measured::Doubt& doubt :
       place(cloud.points_C, {}, find_roughly(cloud.points_C, {}, body), with_nominal(body)).doubts)
    names.push_back(doubt.name);
  return names;
}

TEST(Place, WhatDoesNotTellItsPlaceAcrossIsDoubted) {
  using ::testing::Contains;
  using ::testing::Not;
  const auto wheel = create_surface({Body::wheel, kRadius, StandardProfile{"S1002"}, {}});
  EXPECT_THAT(doubts_of(*wheel, Body::wheel, -30e-3, 60e-3), Contains("no_flange")) << "the tread alone";
  EXPECT_THAT(doubts_of(*wheel, Body::wheel, -45e-3, 60e-3), Contains("no_flange")) << "and the face of the flange";
  EXPECT_THAT(doubts_of(*wheel, Body::wheel, -62e-3, 60e-3), Not(Contains("no_flange"))) << "over its tip";
  const auto rail = create_surface({Body::rail, 0.0, StandardProfile{"60E1"}, {}});
  EXPECT_THAT(doubts_of(*rail, Body::rail, -26e-3, 26e-3), Contains("no_sides"));
  EXPECT_THAT(doubts_of(*rail, Body::rail, -26e-3, 35e-3), Not(Contains("no_sides"))) << "one side fixes its place";
  EXPECT_THAT(doubts_of(*rail, Body::rail, -35e-3, 35e-3), Not(Contains("no_sides")));
}

TEST(Place, RailWithASquatInAnyFrame) {
  const auto rail = squat_rail();
  PlaceSettings settings = with_nominal(Body::rail);
  for (std::uint64_t seed = 1; seed < 3; ++seed) {
    const auto cloud = tests::simple_cloud(*rail, Body::rail, -0.3, 0.3, -35e-3, 35e-3, 500, 90, 20e-6, 0.01,
                                           tests::some_frame(seed), seed);
    const RoughPlace rough = find_roughly(cloud.points_C, {}, Body::rail);
    EXPECT_EQ(unit_by_size(Body::rail, rough.size), LengthUnit::metre);
    settings.forward = cloud.X_CS.rotation.col(0);
    const Placement placed = place(cloud.points_C, {}, rough, settings);
    const Vec3 y_error = placed.X_CS.apply_inverse(cloud.X_CS.origin);
    const Mat3 turn = placed.X_CS.rotation.transpose() * cloud.X_CS.rotation;
    EXPECT_LT((turn - Mat3::Identity()).norm(), 100e-6);
    EXPECT_LT(std::fabs(y_error.y()), 20e-6);
    EXPECT_LT(std::fabs(y_error.z()), 10e-6);
    EXPECT_GT(placed.scatter, 19e-6);
    EXPECT_LT(placed.scatter, 27e-6);
    EXPECT_EQ(placed.nominal_radius, 0.0);
  }
}

TEST(Place, IsTheSameForAnyNumberOfThreadsAndRun) {
  const auto wheel = flat_wheel();
  const auto cloud = tests::simple_cloud(*wheel, Body::wheel, -kPi, kPi, -69e-3, 60e-3, 200, 100, 30e-6, 0.01,
                                         tests::some_frame(3), 3);
  const PlaceSettings settings = with_nominal(Body::wheel);
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return place(cloud.points_C, {}, find_roughly(cloud.points_C, {}, Body::wheel), settings);
  };
  const Placement one = with(1), many = with(4);
  EXPECT_EQ(one.X_CS.origin, many.X_CS.origin);
  EXPECT_EQ(one.X_CS.rotation, many.X_CS.rotation);
  EXPECT_EQ(one.nominal_radius, many.nominal_radius);
  EXPECT_EQ(one.scatter, many.scatter);
  EXPECT_EQ(one.section.v_at(3e-3), many.section.v_at(3e-3));
}

TEST(Place, LeavesOutWhatIsNotKept) {
  const auto wheel = flat_wheel();
  auto cloud =
      tests::simple_cloud(*wheel, Body::wheel, -kPi, kPi, -69e-3, 60e-3, 200, 100, 30e-6, 0.0, tests::some_frame(4), 4);
  std::vector<std::uint8_t> keep(cloud.points_C.size(), 1);
  Random random(6);
  for (int k = 0; k < 20'000; ++k) {
    cloud.points_C.push_back(tests::in_cube(random, 1.0));
    keep.push_back(0);
  }
  const Placement placed =
      place(cloud.points_C, keep, find_roughly(cloud.points_C, keep, Body::wheel), with_nominal(Body::wheel));
  EXPECT_LT(axle_error(placed.X_CS, cloud.X_CS).position, 10e-6);
}

TEST(Place, WheelScannedInLinesFarApart) {
  // profiles 30 mm apart round the wheel, which leave few planes: found by circles where the normals fail
  const auto wheel = flat_wheel();
  const auto sparse =
      tests::simple_cloud(*wheel, Body::wheel, -kPi, kPi, -69e-3, 60e-3, 96, 260, 30e-6, 0.0, tests::some_frame(7), 8);
  const Placement placed =
      place(sparse.points_C, {}, find_roughly(sparse.points_C, {}, Body::wheel), with_nominal(Body::wheel));
  const AxleError error = axle_error(placed.X_CS, sparse.X_CS);
  EXPECT_LT(error.angle, 20e-6);
  EXPECT_LT(error.position, 6e-6);
  EXPECT_LT(std::fabs(placed.nominal_radius - kRadius), 6e-6);
}

TEST(Place, ShortArcsAreRefusedOrKnownToBeUncertain) {
  const auto wheel = create_surface({Body::wheel, kRadius, StandardProfile{"S1002"}, {}});
  const PlaceSettings settings = with_nominal(Body::wheel);
  const auto cloud_of = [&](double arc) {
    return tests::simple_cloud(*wheel, Body::wheel, 2.0 - 0.5 * arc, 2.0 + 0.5 * arc, -69e-3, 60e-3, 200, 80, 30e-6,
                               0.0, tests::some_frame(5), 5);
  };
  for (const double arc : {0.015, 0.03, 0.06}) {
    const auto cloud = cloud_of(arc);
    const auto error =
        tests::error_of([&] { place(cloud.points_C, {}, find_roughly(cloud.points_C, {}, Body::wheel), settings); });
    ASSERT_TRUE(error) << arc;
    EXPECT_EQ(error->kind(), ErrorKind::input_data);
    EXPECT_FALSE(error->advice().empty());
  }
  for (const double arc : {0.25, 0.5, 0.8, 1.5}) {
    const auto cloud = cloud_of(arc);
    const Placement placed = place(cloud.points_C, {}, find_roughly(cloud.points_C, {}, Body::wheel), settings);
    const AxleError error = axle_error(placed.X_CS, cloud.X_CS);
    EXPECT_LT(error.position, 4.0 * placed.position_error) << arc;
    EXPECT_LT(error.position, 0.5e-3) << arc;
    EXPECT_LT(error.angle, 4.0 * placed.direction_error) << arc;
    EXPECT_LT(std::fabs(placed.nominal_radius - kRadius), 4.0 * placed.radius_error) << arc;
    EXPECT_NEAR(placed.arc, arc, 0.05 * arc);
  }
}

TEST(Place, RefusesTheOtherBody) {
  const auto wheel = flat_wheel();
  const auto rail = squat_rail();
  const auto wheel_cloud =
      tests::simple_cloud(*wheel, Body::wheel, -kPi, kPi, -69e-3, 60e-3, 200, 100, 30e-6, 0.0, tests::some_frame(5), 5);
  const auto rail_cloud =
      tests::simple_cloud(*rail, Body::rail, -0.3, 0.3, -35e-3, 35e-3, 200, 90, 20e-6, 0.0, tests::some_frame(5), 5);
  const auto as_rail = tests::error_of([&] {
    place(wheel_cloud.points_C, {}, find_roughly(wheel_cloud.points_C, {}, Body::rail), with_nominal(Body::rail));
  });
  ASSERT_TRUE(as_rail);
  EXPECT_EQ(as_rail->kind(), ErrorKind::input_data);
  const auto as_wheel = tests::error_of([&] {
    place(rail_cloud.points_C, {}, find_roughly(rail_cloud.points_C, {}, Body::wheel), with_nominal(Body::wheel));
  });
  ASSERT_TRUE(as_wheel);
  EXPECT_EQ(as_wheel->kind(), ErrorKind::input_data);
}

}  // namespace
}  // namespace treadmark::scans
