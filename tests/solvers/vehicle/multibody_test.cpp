// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include "small_vehicles.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/random.hpp"

namespace treadmark::vehicle {
namespace {

int coordinate(const Multibody& s, const std::string& name) {
  for (int i = 0; i < s.size(); ++i)
    if (s.coordinates[static_cast<std::size_t>(i)].name == name) return i;
  ADD_FAILURE() << "no coordinate " << name;
  return 0;
}

TEST(Multibody, WheelsetsCarryWhatIsAboveThem) {
  const Multibody s =
      assemble(wheel_on_mass(1800.0, 9000.0, 2e6, 1e4), rails_on_springs(200.0, 6e7, 5e4), 20.0, kGravity);
  ASSERT_EQ(s.wheelset_load.size(), 1u);
  EXPECT_NEAR(s.wheelset_load[0], (1800.0 + 9000.0) * kGravity, 1e-6);
  EXPECT_EQ(s.size(), 4);
  // Nothing moves but the wheelset: springs bear the rest.
  Vector rest = s.weight;
  rest[coordinate(s, "wheelset.z")] = 0.0;
  EXPECT_LT(rest.cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Multibody, SpringsActAtTheirPoints) {
  VehicleModel v = wheel_on_mass(1800.0, 9000.0, 2e6, 0.0);
  v.bodies[0].free = {false, true, true, true, false, true};
  v.springs = {spring("mass", "wheelset", {0.4, -1.0, -0.46}, {0, 3e5, 1e6, 0, 0, 0}),
               spring("mass", "wheelset", {0.4, 1.0, -0.46}, {2e5, 3e5, 1e6, 7e3, 0, 0})};
  const Multibody s = assemble(v, {}, 20.0, kGravity);
  const int y = coordinate(s, "mass.y"), z = coordinate(s, "mass.z"), roll = coordinate(s, "mass.roll"),
            yaw = coordinate(s, "mass.yaw");
  EXPECT_DOUBLE_EQ(s.stiffness(z, z), 2e6);
  EXPECT_DOUBLE_EQ(s.stiffness(y, y), 6e5);
  // Roll: vertical springs at 1 m, lateral ones 0.54 m below the centre of mass, one about the axis.
  EXPECT_NEAR(s.stiffness(roll, roll), 2e6 + 6e5 * 0.54 * 0.54 + 7e3, 1e-6);
  EXPECT_NEAR(s.stiffness(yaw, yaw), 6e5 * 0.16 + 2e5, 1e-6);
  // A roll takes y towards z: what lies below the centre goes to the left.
  EXPECT_NEAR(s.stiffness(y, roll), -6e5 * 0.54, 1e-6);
  EXPECT_NEAR((s.stiffness - s.stiffness.transpose()).cwiseAbs().maxCoeff(), 0.0, 1e-9);
}

TEST(Multibody, RigidMotionsStrainNothing) {
  VehicleModel v;
  constexpr std::array<bool, kFreedoms> all{true, true, true, true, true, true};
  v.bodies = {body("a", 10, {1, 2, 3}, {0.3, -0.2, -1.4}, all), body("b", 20, {1, 2, 3}, {-1.0, 0.5, -0.6}, all),
              body("wheelset", 30, {1, 1, 1}, {0, 0, -0.46}, kVertical)};
  v.springs = {spring("a", "b", {0.1, 0.7, -0.9}, {1e5, 2e5, 3e5, 4e3, 5e3, 6e3}, {10, 20, 30, 1, 2, 3},
                      {1e4, 2e4, 3e4, 1e2, 2e2, 3e2}),
               spring("b", "wheelset", {0, 0, -0.5}, {1e5, 1e5, 1e5, 1e5, 1e5, 1e5})};
  v.wheelsets = {{"wheelset", 0.46}};
  const Multibody s = assemble(v, {}, 20.0, kGravity);
  Random random(7);
  const Vec3 shift(random.uniform(), random.uniform(), random.uniform()),
      turn(random.uniform(), random.uniform(), random.uniform());
  Vector q = Vector::Zero(s.size());
  for (int i = 0; i < s.size(); ++i) {
    const Coordinate& c = s.coordinates[static_cast<std::size_t>(i)];
    if (c.body != 0 && c.body != 1) continue;
    const Vec3 moved = shift + turn.cross(v.bodies[static_cast<std::size_t>(c.body)].position);
    const int f = static_cast<int>(c.freedom);
    q[i] = f < 3 ? moved[f] : turn[f - 3];
  }
  const Vector force = s.stiffness * q;
  for (int i = 0; i < s.size(); ++i) {
    const Coordinate& c = s.coordinates[static_cast<std::size_t>(i)];
    if (c.body == 0) {
      EXPECT_NEAR(force[i], 0.0, 1e-6) << c.name;
    }
  }
}

TEST(Multibody, ADamperBehindASpring) {
  VehicleModel v = wheel_on_mass(1800.0, 9000.0, 2e6, 0.0);
  v.springs[0] =
      spring("mass", "wheelset", {0, 0, -0.46}, {0, 0, 2e6, 0, 0, 0}, {0, 0, 3e4, 0, 0, 0}, {0, 0, 5e6, 0, 0, 0});
  const Multibody s = assemble(v, {}, 20.0, kGravity);
  const int inner = coordinate(s, "mass-wheelset.damper_z"), z = coordinate(s, "mass.z");
  EXPECT_EQ(s.mass[inner], 0.0);
  EXPECT_DOUBLE_EQ(s.damping(inner, inner), 3e4);
  EXPECT_DOUBLE_EQ(s.stiffness(inner, inner), 5e6);
  EXPECT_DOUBLE_EQ(s.stiffness(z, z), 7e6);
  EXPECT_DOUBLE_EQ(s.damping(z, z), 0.0);
}

TEST(Multibody, ATurningWheelsetIsAGyroscope) {
  VehicleModel v = wheel_on_mass(1800.0, 9000.0, 2e6, 1e4);
  v.bodies[1].free = {true, true, true, true, true, true};
  v.bodies[1].inertia = {1100.0, 110.0, 1100.0};
  v.springs[0].stiffness = {1e6, 1e6, 2e6, 1e5, 0, 1e5};
  const Multibody s = assemble(v, {}, 23.0, kGravity);
  const int roll = coordinate(s, "wheelset.roll"), yaw = coordinate(s, "wheelset.yaw");
  // Forward rolling: momentum 110 * 50 along -y. Rolling (y towards z) turns it; the torque that needs is about +z,
  // reversed on the body.
  EXPECT_NEAR(s.damping(yaw, roll), -110.0 * 50.0, 1e-9);
  EXPECT_NEAR(s.damping(roll, yaw), 110.0 * 50.0, 1e-9);
  EXPECT_DOUBLE_EQ(s.dissipation(yaw, roll), 0.0);
}

TEST(Multibody, RailsMoveTheirProfileOrigin) {
  TrackModel t = rails_on_springs(100.0, 6e7, 0.0);
  t.bodies[1].free = {false, true, true, true, false, false};
  t.springs.push_back(spring("right_rail", kGround, {0, 0.75, 0.2}, {0, 1e7, 0, 1e5, 0, 0}));
  const Multibody s = assemble(wheel_on_mass(1800.0, 9000.0, 2e6, 1e4), t, 20.0, kGravity);
  Vector q = Vector::Zero(s.size());
  q[coordinate(s, "right_rail@1.roll")] = 1e-3;
  q[coordinate(s, "right_rail@1.z")] = 2e-3;
  const PairVector u = pair_map(s, 0, wheelrail::Side::right, {0.0, 0.76, 0.0}) * q;
  EXPECT_NEAR(u[6], 1e-3 * 0.1, 1e-15);  // 0.1 m above the centre of mass, which rolls to the right at the top
  EXPECT_NEAR(u[7], 2e-3 + 1e-3 * 0.01, 1e-15);
  EXPECT_NEAR(u[8], 1e-3, 1e-15);
}

TEST(Multibody, CharacteristicsAreOddAndHaveAPotential) {
  const CharacteristicForce c{Vector::Ones(1), {0.025, 0.03, 0.035}, {0.0, 600.0, 1760.0}};
  EXPECT_DOUBLE_EQ(characteristic(c, 0.02).force, 0.0);
  EXPECT_NEAR(characteristic(c, 0.0275).force, 300.0, 1e-9);
  EXPECT_NEAR(characteristic(c, -0.0325).force, -1180.0, 1e-9);
  EXPECT_NEAR(characteristic(c, 0.04).force, 2920.0, 1e-9);
  for (const double u : {0.026, 0.031, 0.037, -0.033}) {
    const double h = 1e-7;
    EXPECT_NEAR((characteristic(c, u + h).energy - characteristic(c, u - h).energy) / (2 * h),
                characteristic(c, u).force, 1e-3);
  }
}

TEST(Multibody, WhatNothingHoldsIsAnError) {
  VehicleModel v = wheel_on_mass(1800.0, 9000.0, 2e6, 1e4);
  v.springs.clear();
  EXPECT_THROW(assemble(v, {}, 20.0, kGravity), Error);
  v = wheel_on_mass(1800.0, -1.0, 2e6, 1e4);
  EXPECT_THROW(assemble(v, {}, 20.0, kGravity), Error);
  v = wheel_on_mass(1800.0, 9000.0, 2e6, 1e4);
  v.springs[0].body_a = "bogie";
  EXPECT_THROW(assemble(v, {}, 20.0, kGravity), Error);
}

}  // namespace
}  // namespace treadmark::vehicle
