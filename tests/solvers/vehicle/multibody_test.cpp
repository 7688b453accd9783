// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "small_vehicles.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
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

/// Without preloads stiffness is that of springs alone.
constexpr double kWeightless = 0.0;

TEST(Multibody, SpringsActAtTheirPoints) {
  VehicleModel v = wheel_on_mass(1800.0, 9000.0, 2e6, 0.0);
  v.bodies[0].free = {false, true, true, true, false, true};
  v.springs = {spring("mass", "wheelset", {0.4, -1.0, -0.46}, {0, 3e5, 1e6, 0, 0, 0}),
               spring("mass", "wheelset", {0.4, 1.0, -0.46}, {2e5, 3e5, 1e6, 7e3, 0, 0})};
  const Multibody s = assemble(v, {}, 20.0, kWeightless);
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
  const Multibody s = assemble(v, {}, 20.0, kWeightless);
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

/// A car above a frame above the ground, on eight springs.
VehicleModel two_storeys() {
  VehicleModel v;
  constexpr std::array<bool, kFreedoms> all{true, true, true, true, true, true};
  v.bodies = {body("car", 8000.0, {4e3, 9e3, 9e3}, {0, 0, -1.7}, all),
              body("frame", 2000.0, {1e3, 2e3, 2e3}, {0, 0, -0.7}, all),
              body("wheelset", 1000.0, {1, 1, 1}, {0, 0, -0.46}, kVertical)};
  for (const double x : {-1.2, 1.2})
    for (const double y : {-1.0, 1.0}) {
      v.springs.push_back(spring("frame", "car", {x, y, -0.9}, {2e5, 3e5, 4e5, 0, 0, 0}));
      v.springs.push_back(spring("frame", kGround, {0.8 * x, 0.9 * y, -0.4}, {3e6, 4e6, 2e6, 0, 0, 0}));
    }
  v.wheelsets = {{"wheelset", 0.46}};
  return v;
}

/// Potential of springs and weights, for rotations of any size: roll, yaw, pitch one after the other, springs in axes
/// that are turned by the means of the angles. Compressed so far that the vehicle stands at rest where it is.
double potential(const VehicleModel& v, const Multibody& s, const Vector& q) {
  struct Placed {
    Vec3 origin, angles;
    Mat3 rotation;
  };
  const auto turned = [](const Vec3& a) { return Mat3(rotation_x(a.x()) * rotation_z(a.z()) * rotation_y(a.y())); };
  const auto placed = [&](const std::string& name, const Vec3& position) {
    Placed p{position, Vec3::Zero(), Mat3::Identity()};
    for (int i = 0; i < s.size(); ++i) {
      const Coordinate& c = s.coordinates[static_cast<std::size_t>(i)];
      if (!c.name.starts_with(name + '.')) continue;
      const int f = static_cast<int>(c.freedom);
      (f < 3 ? p.origin[f] : p.angles[f - 3]) += q[i];
    }
    p.rotation = turned(p.angles);
    return p;
  };
  double sum = 0.0;
  for (const BodySpec& b : v.bodies)
    sum -= b.mass * kGravity * (placed(b.name, b.position).origin.z() - b.position.z());
  for (const SpringSpec& spring : v.springs) {
    const auto end = [&](const std::string& name) {
      const auto b = ranges::find(v.bodies, name, &BodySpec::name);
      if (b == v.bodies.end()) return std::pair(spring.position, Vec3(Vec3::Zero()));
      const Placed p = placed(name, b->position);
      return std::pair(Vec3(p.origin + p.rotation * (spring.position - b->position)), p.angles);
    };
    const auto [a, angles_a] = end(spring.body_a);
    const auto [b, angles_b] = end(spring.body_b);
    const double load = (spring.body_b == "car" ? 8000.0 : -10000.0) * kGravity / 4.0;
    const Vec3 u = turned(0.5 * (angles_a + angles_b)).transpose() * (b - a),
               stretch = u + Vec3(0.0, 0.0, load / spring.stiffness[2]);
    for (int i = 0; i < 3; ++i) sum += 0.5 * spring.stiffness[static_cast<std::size_t>(i)] * stretch[i] * stretch[i];
  }
  return sum;
}

TEST(Multibody, PreloadedSpringsLeanAsTheirPotentialSays) {
  const VehicleModel v = two_storeys();
  const Multibody s = assemble(v, {}, 20.0, kGravity), elastic = assemble(v, {}, 20.0, kWeightless);
  constexpr double kStep = 2e-3;
  const Eigen::Index n = s.size();
  const auto at = [&](Eigen::Index i, double by_i, Eigen::Index j, double by_j) {
    Vector q = Vector::Zero(n);
    q[i] += by_i;
    q[j] += by_j;
    return potential(v, s, q);
  };
  double most = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (s.coordinates[static_cast<std::size_t>(i)].name == "wheelset.z") continue;
    // At rest nothing pulls.
    EXPECT_NEAR((at(i, kStep, i, 0.0) - at(i, -kStep, i, 0.0)) / (2.0 * kStep), 0.0, 0.1) << i;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (s.coordinates[static_cast<std::size_t>(j)].name == "wheelset.z") continue;
      const double second =
          (at(i, kStep, j, kStep) - at(i, kStep, j, -kStep) - at(i, -kStep, j, kStep) + at(i, -kStep, j, -kStep)) /
          (4.0 * kStep * kStep);
      const double by_weight = s.stiffness(i, j) - elastic.stiffness(i, j);
      most = std::max(most, std::abs(by_weight));
      EXPECT_NEAR(second, s.stiffness(i, j), 150.0)
          << s.coordinates[static_cast<std::size_t>(i)].name << ' ' << s.coordinates[static_cast<std::size_t>(j)].name;
    }
  }
  EXPECT_GT(most, 3e4);
}

/// On springs that do not give way sideways a body is an inverted pendulum.
TEST(Multibody, ABodyOnTwoSpringsRollsAsAnInvertedPendulum) {
  constexpr double kMass = 9000.0, kInertia = 5e3, kHeight = 1.1, kStiffness = 1e5, kHalf = 1.0;
  VehicleModel v = wheel_on_mass(1800.0, kMass, 0.0, 0.0);
  v.bodies[0] = body("mass", kMass, {kInertia, 1, 1}, {0, 0, -0.46 - kHeight}, {false, true, true, true, false, false});
  v.springs = {spring("wheelset", "mass", {0, -kHalf, -0.46}, {0, 1e12, kStiffness, 0, 0, 0}),
               spring("wheelset", "mass", {0, kHalf, -0.46}, {0, 1e12, kStiffness, 0, 0, 0})};
  const Multibody s = assemble(v, {}, 20.0, kGravity);
  const int y = coordinate(s, "mass.y"), roll = coordinate(s, "mass.roll");
  const Eigen::Matrix2d k{{s.stiffness(y, y), s.stiffness(y, roll)}, {s.stiffness(roll, y), s.stiffness(roll, roll)}};
  const double flexibility = k.inverse()(1, 1), by_hand = 2.0 * kStiffness * kHalf * kHalf - kMass * kGravity * kHeight;
  EXPECT_NEAR(1.0 / flexibility, by_hand, 1e-3 * by_hand);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> modes(
      k, Eigen::Vector2d(kMass, kInertia).asDiagonal().toDenseMatrix());
  const double frequency = by_hand / (kInertia + kMass * kHeight * kHeight);
  EXPECT_NEAR(modes.eigenvalues()[0], frequency, 1e-3 * frequency);
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
  const ForceCurve c{{0.025, 0.03, 0.035}, {0.0, 600.0, 1760.0}};
  EXPECT_DOUBLE_EQ(value_at(c, 0.02).force, 0.0);
  EXPECT_NEAR(value_at(c, 0.0275).force, 300.0, 1e-9);
  EXPECT_NEAR(value_at(c, -0.0325).force, -1180.0, 1e-9);
  EXPECT_NEAR(value_at(c, 0.04).force, 2920.0, 1e-9);
  for (const double u : {0.026, 0.031, 0.037, -0.033}) {
    const double h = 1e-7;
    EXPECT_NEAR((value_at(c, u + h).integral - value_at(c, u - h).integral) / (2 * h), value_at(c, u).force, 1e-3);
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
