// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "axle_beam.hpp"
#include "small_vehicles.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"
#include "treadmark/solvers/vehicle/stability/eigenmodes.hpp"

namespace treadmark::vehicle {
namespace {

using testing::AxleBeam;
using testing::manchester_axle;

constexpr double kTurn = 2.0 * std::numbers::pi, kWheelAt = 0.75, kBoxAt = 1.0, kRadius = 0.46, kElement = 0.02;
const std::vector<double> kPlaces{-kBoxAt, -kWheelAt, kWheelAt, kBoxAt};

/// A wheelset that bends, below a mass on four springs.
VehicleModel flexible_vehicle(const std::optional<FlexibleAxle>& axle) {
  VehicleModel v = wheel_on_mass(1813.0, 9000.0, 0.0, 0.0);
  v.bodies[1].inertia = {1120.0, 112.0, 1120.0};
  v.bodies[1].free = {true, true, true, true, true, true};
  v.springs.clear();
  for (const double y : {-kBoxAt, kBoxAt})
    v.springs.push_back(
        spring("mass", "wheelset", {0, y, -0.46}, {5e6, 4e6, 1.2e6, 0, 0, 0}, {15e3, 2e3, 4e3, 0, 0, 0}));
  v.wheelsets[0].axle = axle;
  return v;
}

/// On nothing.
VehicleOnTrack free_wheelset(const FlexibleAxle& axle, double speed) {
  VehicleModel model;
  model.bodies = {
      body("wheelset", 1813.0, {1120.0, 112.0, 1120.0}, {0, 0, -kRadius}, {true, true, true, true, true, true})};
  model.wheelsets = {{"wheelset", kRadius, axle}};
  VehicleOnTrack v;
  v.speed = speed;
  v.system = assemble(model, {}, speed, 0.0);
  return v;
}

std::vector<double> frequencies(const VehicleOnTrack& v) {
  const Vector zero = Vector::Zero(v.system.size());
  std::vector<double> all;
  for (const Eigenmode& mode : eigenmodes(v, {0.0, zero, zero})) all.push_back(mode.frequency);
  return all;
}

int coordinate_at(const Multibody& s, const std::string& name) {
  for (int i = 0; i < s.size(); ++i)
    if (s.coordinates[static_cast<std::size_t>(i)].name == name) return i;
  ADD_FAILURE() << "no coordinate " << name;
  return 0;
}

FlexibleAxle manchester(int bending, int torsion, double damping = 0.0) {
  double polar = 0.0;
  const AxleBeam beam = manchester_axle(&polar, kElement);
  return beam.axle(2.0 * kWheelAt, polar, kPlaces, bending, torsion, damping);
}

/// The oracle itself: a free slender beam, and two discs on a shaft without mass.
TEST(AxleBeam, HasTheFrequenciesOfClosedForms) {
  constexpr double kLength = 2.0, kDiameter = 0.02;
  const AxleBeam slender({{-1.0, 1.0, kDiameter}}, {}, 7850.0, 0.05, 1e6);
  const double wave = std::sqrt(AxleBeam::kYoung / 7850.0) * kDiameter / 4.0 / (kLength * kLength);
  for (const auto& [mode, beta] : {std::pair{0u, 4.730041}, std::pair{1u, 7.853205}, std::pair{2u, 10.995608}})
    EXPECT_NEAR(slender.bending().omega[mode] / (beta * beta * wave), 1.0, 1e-3) << mode;
  const double torsion = std::numbers::pi / kLength * std::sqrt(AxleBeam::kShear / 7850.0);
  EXPECT_NEAR(slender.torsion().omega[0] / torsion, 1.0, 1e-3);

  constexpr double kShaft = 0.16, kDiametral = 30.0, kPolar = 55.0;
  const AxleBeam discs({{-kWheelAt, kWheelAt, kShaft}},
                       {{-kWheelAt, 600.0, kDiametral, kPolar}, {kWheelAt, 600.0, kDiametral, kPolar}}, 1e-6, 0.05);
  const double area_moment = std::numbers::pi / 64.0 * std::pow(kShaft, 4);
  // Without mass between them the discs bend the shaft by moments alone.
  EXPECT_NEAR(discs.bending().omega[0], std::sqrt(AxleBeam::kYoung * area_moment / (kWheelAt * kDiametral)), 1e-4);
  EXPECT_NEAR(discs.torsion().omega[0],
              std::sqrt(AxleBeam::kShear * 2.0 * area_moment / (2.0 * kWheelAt) * (2.0 / kPolar)), 1e-4);
}

TEST(FlexibleWheelset, WheelsMoveAsTheModeSays) {
  const FlexibleAxle axle = manchester(2, 1);
  const Multibody s = assemble(flexible_vehicle(axle), {}, 20.0, kGravity);
  for (const auto side : {wheelrail::Side::left, wheelrail::Side::right}) {
    const bool left = side == wheelrail::Side::left;
    const Vec3 wheel(0.0, left ? -kWheelAt : kWheelAt, 0.0);
    const auto map = pair_map(s, 0, side, Vec3::Zero());
    const auto moved = [&](const std::string& name) {
      Vector q = Vector::Zero(s.size());
      q[coordinate_at(s, name)] = 1.0;
      const PairVector u = map * q;
      const Vec3 turn = u.segment<3>(3);
      return std::pair<Vec3, Vec3>(Vec3(u.head<3>()) + turn.cross(wheel), turn);
    };
    for (std::size_t i = 0; i < 2; ++i) {
      const double w = axle.bending[i].shape[left ? 1 : 2], slope = axle.bending[i].slope[left ? 1 : 2];
      const std::string name = "wheelset.bending" + std::to_string(i + 1);
      const auto [down, roll] = moved(name + "_vertical");
      EXPECT_LT((down - Vec3(0, 0, w)).norm(), 1e-12);
      EXPECT_LT((roll - Vec3(slope, 0, 0)).norm(), 1e-12);
      const auto [forward, yaw] = moved(name + "_horizontal");
      EXPECT_LT((forward - Vec3(w, 0, 0)).norm(), 1e-12);
      EXPECT_LT((yaw - Vec3(0, 0, -slope)).norm(), 1e-12);
    }
    EXPECT_EQ(moved("wheelset.torsion1").second, Vec3(0, axle.torsion[0].wheel_rotation[left ? 0 : 1], 0));
  }
  // The first mode is even, wheels lean against each other; wheels twist against each other.
  EXPECT_NEAR(axle.bending[0].slope[1], -axle.bending[0].slope[2], 1e-9);
  EXPECT_NEAR(axle.torsion[0].wheel_rotation[0], -1.0, 1e-9);
}

TEST(FlexibleWheelset, SpringsHoldTheBendingAxle) {
  FlexibleAxle axle{"a", 1.5, 50.0, {-1.0, -0.75, 0.75, 1.0}, {}, {}, {}};
  axle.bending = {{400.0, 1e8, 1e3, {1.0, -0.2, -0.2, 1.0}, {-5.0, -2.0, 2.0, 5.0}, {}}};
  axle.torsion = {{110.0, 1e7, 0.0, {-1.0, 1.0}, {}}};
  VehicleModel model = flexible_vehicle(axle);
  model.springs = {spring("mass", "wheelset", {0.3, 1.0, -0.56}, {2e5, 3e5, 1e6, 7e3, 9e3, 8e3})};
  const Multibody s = assemble(model, {}, 20.0, kGravity);
  const int vertical = coordinate_at(s, "wheelset.bending1_vertical"),
            horizontal = coordinate_at(s, "wheelset.bending1_horizontal"),
            torsion = coordinate_at(s, "wheelset.torsion1");
  // The box rolls about the axle's end 0.1 m below the spring's place and is turned about it by horizontal bending.
  EXPECT_NEAR(s.stiffness(vertical, vertical), 1e8 + 1e6 + 3e5 * 0.5 * 0.5 + 7e3 * 25.0, 1e-3);
  EXPECT_NEAR(s.stiffness(horizontal, horizontal), 1e8 + 2e5 + 3e5 * 1.5 * 1.5 + 8e3 * 25.0, 1e-3);
  EXPECT_NEAR(s.stiffness(vertical, coordinate_at(s, "wheelset.z")), 1e6, 1e-3);
  EXPECT_NEAR(s.stiffness(vertical, coordinate_at(s, "mass.z")), -1e6, 1e-3);
  EXPECT_NEAR(s.stiffness(torsion, torsion), 1e7, 1e-6);
  EXPECT_EQ(s.damping(vertical, vertical), 1e3);
  EXPECT_EQ(s.weight[vertical], 9000.0 * kGravity) << "the mass alone loads the axle at its box";
  EXPECT_EQ(s.wheelset_load[0], (9000.0 + 1813.0) * kGravity);
}

TEST(FlexibleWheelset, AFreeWheelsetVibratesAsTheBeam) {
  const AxleBeam beam = manchester_axle(nullptr, kElement);
  std::vector<double> expected;
  for (const double omega : {beam.bending().omega[0], beam.bending().omega[1], beam.torsion().omega[0]})
    expected.push_back(omega / kTurn);
  // Both planes; nearly at rest, so that nothing turns.
  const std::vector<double> found = frequencies(free_wheelset(manchester(2, 1), 1e-6));
  ASSERT_EQ(found.size(), 5u);
  EXPECT_NEAR(found[0], expected[2], 1e-6 * expected[2]);
  for (const std::size_t i : {1u, 2u}) EXPECT_NEAR(found[i], expected[0], 1e-6 * expected[0]);
  for (const std::size_t i : {3u, 4u}) EXPECT_NEAR(found[i], expected[1], 1e-6 * expected[1]);
}

TEST(FlexibleWheelset, TwoDiscsTwistAsByHand) {
  constexpr double kInertia = 56.0, kStiffness = 4e6;
  FlexibleAxle axle{"discs", 1.5, kInertia, {}, {}, {}, {}};
  axle.torsion = {{2.0 * kInertia, 4.0 * kStiffness, 0.0, {-1.0, 1.0}, {}}};
  const std::vector<double> found = frequencies(free_wheelset(axle, 1e-6));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0], std::sqrt(kStiffness * (2.0 / kInertia)) / kTurn, 1e-9);
}

/// Whirling of two discs on a shaft without mass: I_d w^2 -+ I_p Omega w - k = 0.
TEST(FlexibleWheelset, TurningWheelsPartTheFrequenciesOfBothPlanes) {
  constexpr double kDiametral = 30.0, kPolar = 55.0, kShaft = 0.16, kSpeed = 50.0;
  const AxleBeam beam({{-kWheelAt, kWheelAt, kShaft}},
                      {{-kWheelAt, 600.0, kDiametral, kPolar}, {kWheelAt, 600.0, kDiametral, kPolar}}, 1e-6, 0.05);
  FlexibleAxle axle = beam.axle(1.5, kPolar, {-kWheelAt, 0.0, kWheelAt}, 1, 0, 0.0);
  const double k = AxleBeam::kYoung * std::numbers::pi / 64.0 * std::pow(kShaft, 4) / kWheelAt,
               gyroscopic = kPolar * kSpeed / kRadius;
  std::vector<double> expected;
  for (const double sign : {-1.0, 1.0})
    expected.push_back((sign * gyroscopic + std::sqrt(gyroscopic * gyroscopic + 4.0 * kDiametral * k)) /
                       (2.0 * kDiametral) / kTurn);
  std::vector<double> found = frequencies(free_wheelset(axle, kSpeed));
  // Below them the nutation of the rigid wheelset, which the even mode leaves as it is.
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0], 112.0 * kSpeed / kRadius / 1120.0 / kTurn, 1e-6);
  EXPECT_NEAR(found[1], expected[0], 1e-5 * expected[0]);
  EXPECT_NEAR(found[2], expected[1], 1e-5 * expected[1]);
  EXPECT_GT(expected[1] - expected[0], 0.1 * expected[0]);
}

/// An odd mode turns with the rigid roll and yaw: the whole against the beam's discs, by their momenta.
TEST(FlexibleWheelset, MomentaOfWheelsAreThoseOfDiscsOnTheBeam) {
  const FlexibleAxle axle = manchester(3, 0);
  constexpr double kSpeed = 40.0;
  const Multibody s = free_wheelset(axle, kSpeed).system;
  EXPECT_LT((s.damping + s.damping.transpose()).cwiseAbs().maxCoeff(), 1e-9);
  Random random(3);
  const double axle_alone = 112.0 - 2.0 * axle.wheel_polar_inertia, spin = -kSpeed / kRadius;
  const auto rate = [&] {
    Vector v(s.size());
    for (double& one : v) one = random.uniform() - 0.5;
    return v;
  };
  const auto turning = [&](const Vector& v, int place, const char* plane, double sign, const char* rigid) {
    double sum = v[coordinate_at(s, rigid)];
    for (std::size_t i = 0; i < 3 && place >= 0; ++i)
      sum += sign * axle.bending[i].slope[static_cast<std::size_t>(place)] *
             v[coordinate_at(s, "wheelset.bending" + std::to_string(i + 1) + plane)];
    return sum;
  };
  const Vector u = rate(), v = rate();
  double power = 0.0;
  for (const auto& [place, inertia] :
       {std::pair{-1, axle_alone}, std::pair{1, axle.wheel_polar_inertia}, std::pair{2, axle.wheel_polar_inertia}}) {
    const auto roll = [&](const Vector& x) { return turning(x, place, "_vertical", 1.0, "wheelset.roll"); };
    const auto yaw = [&](const Vector& x) { return turning(x, place, "_horizontal", -1.0, "wheelset.yaw"); };
    // Moment that keeps up a turning: rate of axes times momentum.
    const Vec3 needed = Vec3(roll(v), 0.0, yaw(v)).cross(Vec3(0.0, inertia * spin, 0.0));
    power += roll(u) * needed.x() + yaw(u) * needed.z();
  }
  EXPECT_NEAR(u.dot(s.damping * v), power, 1e-9 * std::abs(power) + 1e-9);
}

/// Loads at the boxes, wheels on rails: what modes make of the slope of the wheels, beside the beam's.
TEST(FlexibleWheelset, BendsAtRestAsFarAsItsModesReach) {
  constexpr double kForce = 50e3;
  const AxleBeam beam = manchester_axle(nullptr, kElement);
  const Eigen::VectorXd exact = beam.loaded(kForce, kBoxAt, kWheelAt);
  const double slope = exact[2 * beam.node(kWheelAt) + 1], box = exact[2 * beam.node(kBoxAt)];
  // Between the wheels the moment is constant: near the hand formula of the middle section.
  const double by_hand = kForce * 0.25 * kWheelAt / (AxleBeam::kYoung * std::numbers::pi / 64.0 * std::pow(0.16, 4));
  EXPECT_NEAR(slope, by_hand, 0.08 * by_hand);
  std::vector<double> slopes, boxes;
  for (int modes = 1; modes <= 5; ++modes) {
    const FlexibleAxle axle = manchester(modes, 0);
    const Multibody s = free_wheelset(axle, 20.0).system;
    double turn = 0.0, down = 0.0;
    for (int i = 0; i < modes; ++i) {
      const BendingMode& mode = axle.bending[static_cast<std::size_t>(i)];
      const int c = coordinate_at(s, "wheelset.bending" + std::to_string(i + 1) + "_vertical");
      // Wheels carry what the boxes bring; through the map as contacts do.
      double force = kForce * (mode.shape.front() + mode.shape.back());
      for (const auto side : {wheelrail::Side::left, wheelrail::Side::right}) {
        PairVector up = PairVector::Zero();
        up[2] = -kForce;
        up[3] = side == wheelrail::Side::left ? kForce * kWheelAt : -kForce * kWheelAt;
        force += (pair_map(s, 0, side, Vec3::Zero()).transpose() * up)[c];
      }
      const double q = force / s.stiffness(c, c);
      turn += q * mode.slope[2];
      down += q * (mode.shape[3] - mode.shape[2]);
    }
    slopes.push_back(turn / slope);
    boxes.push_back(down / box);
  }
  // The last of them bend the ends at the boxes only.
  for (const std::size_t few : {0u, 1u, 2u, 3u}) {
    EXPECT_NEAR(slopes[few], 1.0, 0.03) << few;
    EXPECT_NEAR(boxes[few], 0.92, 0.02) << few;
  }
  EXPECT_NEAR(slopes[4], 1.0, 1e-3);
  EXPECT_NEAR(boxes[4], 1.0, 1e-3);
}

SimulationSettings running(double duration) {
  SimulationSettings s;
  s.duration = duration;
  s.position_tolerance = 1e-9;
  s.max_step = 1e-3;
  s.first_step = 1e-6;
  s.min_step = 1e-10;
  s.max_travel = 1.0;
  s.step.force_tolerance = 1e-8;
  return s;
}

VehicleOnTrack running_vehicle() {
  return on_hertz_springs(flexible_vehicle(manchester(2, 1, 0.01)), rails_on_springs(200.0, 6e7, 5e4), 20.0, 9e10, 1e5);
}

SystemState disturbed(const VehicleOnTrack& v) {
  SystemState start = find_equilibrium(v).state;
  start.q[coordinate_at(v.system, "mass.z")] += 0.01;
  start.v[coordinate_at(v.system, "wheelset.bending1_vertical")] += 0.2;
  start.v[coordinate_at(v.system, "wheelset.torsion1")] += 0.5;
  start.v[coordinate_at(v.system, "wheelset.pitch")] += 0.3;
  return start;
}

TEST(FlexibleWheelset, EnergyOfARunIsBalanced) {
  const VehicleOnTrack v = running_vehicle();
  Simulation s(v, disturbed(v), running(0.1));
  while (!s.finished()) s.advance();
  EXPECT_GT(s.energy().turnover, 10.0);
  EXPECT_LT(std::abs(s.energy().integration_error(s.energy_at_start())), 1e-4 * s.energy().turnover);
}

/// Another scale of the shapes is another unit of their coordinates, nothing else.
TEST(FlexibleWheelset, TheScaleOfShapesIsFree) {
  constexpr double kScale = 40.0;
  FlexibleAxle scaled = manchester(2, 1, 0.01);
  for (BendingMode& mode : scaled.bending) {
    for (double& w : mode.shape) w *= kScale;
    for (double& slope : mode.slope) slope *= kScale;
    for (double* value : {&mode.mass, &mode.stiffness, &mode.damping}) *value *= kScale * kScale;
  }
  for (TorsionMode& mode : scaled.torsion) {
    for (double& rotation : mode.wheel_rotation) rotation *= kScale;
    for (double* value : {&mode.inertia, &mode.stiffness, &mode.damping}) *value *= kScale * kScale;
  }
  const auto run_with = [](const FlexibleAxle& axle, double unit) {
    const VehicleOnTrack v =
        on_hertz_springs(flexible_vehicle(axle), rails_on_springs(200.0, 6e7, 5e4), 20.0, 9e10, 1e5);
    SystemState start = find_equilibrium(v, {1e-12, 1e-6, 60}).state;
    start.v[coordinate_at(v.system, "wheelset.bending1_vertical")] += 0.2 / unit;
    start.v[coordinate_at(v.system, "wheelset.torsion1")] += 0.5 / unit;
    Simulation s(v, start, running(0.02));
    while (!s.finished()) s.advance();
    Vector q = s.state().q;
    for (int i = 0; i < v.system.size(); ++i)
      if (v.system.coordinates[static_cast<std::size_t>(i)].elastic) q[i] *= unit;
    return std::pair<Vector, long>(q, s.counts().steps);
  };
  const auto plain = run_with(manchester(2, 1, 0.01), 1.0), other = run_with(scaled, kScale);
  EXPECT_EQ(plain.second, other.second);
  EXPECT_LT((plain.first - other.first).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(FlexibleWheelset, GoesOnWithTheSameBits) {
  const VehicleOnTrack first = running_vehicle();
  const SystemState start = disturbed(first);
  Simulation whole(first, start, running(0.02));
  ByteWriter saved;
  for (int i = 0; !whole.finished(); ++i) {
    if (i == 20) whole.save(saved);
    whole.advance();
  }
  ASSERT_GT(whole.counts().steps, 20);
  Simulation rest(running_vehicle(), start, running(0.02));
  ByteReader reader(saved.bytes());
  rest.restore(reader);
  while (!rest.finished()) rest.advance();
  EXPECT_EQ(rest.state().q, whole.state().q);
  EXPECT_EQ(rest.state().v, whole.state().v);
  EXPECT_EQ(rest.energy().mechanical, whole.energy().mechanical);
}

/// The stiffer the axle, the nearer it is to a rigid one.
TEST(FlexibleWheelset, AStiffAxleIsRigid) {
  FlexibleAxle stiff = manchester(2, 1);
  for (BendingMode& mode : stiff.bending) mode.stiffness *= 1e6;
  for (TorsionMode& mode : stiff.torsion) mode.stiffness *= 1e6;
  const auto tracks = rails_on_springs(200.0, 6e7, 5e4);
  const VehicleOnTrack rigid = on_hertz_springs(flexible_vehicle({}), tracks, 20.0, 9e10, 1e5),
                       bending = on_hertz_springs(flexible_vehicle(stiff), tracks, 20.0, 9e10, 1e5),
                       soft = on_hertz_springs(flexible_vehicle(manchester(2, 1)), tracks, 20.0, 9e10, 1e5);
  EXPECT_EQ(rigid.system.size() + 5, bending.system.size());
  const auto height = [](const VehicleOnTrack& v) {
    const Equilibrium e = find_equilibrium(v, {1e-12, 1e-6, 60});
    EXPECT_EQ(e.report.status, Status::ok);
    return e.state.q[coordinate_at(v.system, "mass.z")];
  };
  EXPECT_NEAR(height(bending), height(rigid), 1e-9);
  EXPECT_GT(height(soft) - height(rigid), 1e-4);
}

struct WrongAxle {
  const char* expected;
  void (*change)(VehicleModel&);
};
class FlexibleWheelsetError : public ::testing::TestWithParam<WrongAxle> {};
TEST_P(FlexibleWheelsetError, IsTold) {
  VehicleModel model = flexible_vehicle(manchester(2, 1));
  assemble(model, {}, 20.0, kGravity);
  GetParam().change(model);
  try {
    assemble(model, {}, 20.0, kGravity);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_THAT(error.what(), ::testing::HasSubstr(GetParam().expected));
  }
}
INSTANTIATE_TEST_SUITE_P(
    All, FlexibleWheelsetError,
    ::testing::Values(
        WrongAxle{"cannot move in yaw", [](VehicleModel& v) { v.bodies[1].free[5] = false; }},
        WrongAxle{"the whole wheelset 'wheelset' 100", [](VehicleModel& v) { v.bodies[1].inertia.y() = 100.0; }},
        WrongAxle{"'wheelset' is held at 1.01 m", [](VehicleModel& v) { v.springs[0].position.y() = 1.01; }},
        WrongAxle{"mass and frequency must be positive",
                  [](VehicleModel& v) { v.wheelsets[0].axle->bending[1].mass = 0.0; }},
        WrongAxle{"bending mode 2 of axle 'test' has 3 displacements and 4 slopes for 4 places",
                  [](VehicleModel& v) { v.wheelsets[0].axle->bending[1].shape.pop_back(); }},
        WrongAxle{"does not bend",
                  [](VehicleModel& v) {
                    v.wheelsets[0].axle->bending[0].shape = {-1.0, -0.75, 0.75, 1.0};
                    v.wheelsets[0].axle->bending[0].slope = {1.0, 1.0, 1.0, 1.0};
                  }},
        WrongAxle{"turning wheels alone make",
                  [](VehicleModel& v) {
                    for (double& slope : v.wheelsets[0].axle->bending[0].slope) slope *= 10.0;
                  }},
        WrongAxle{"turning wheels alone make", [](VehicleModel& v) { v.wheelsets[0].axle->torsion[0].inertia = 50.0; }},
        WrongAxle{"does not turn the wheels",
                  [](VehicleModel& v) {
                    v.wheelsets[0].axle->torsion[0].wheel_rotation = {0.0, 0.0};
                  }},
        WrongAxle{"neither bends nor twists",
                  [](VehicleModel& v) { v.wheelsets[0].axle->bending.clear(), v.wheelsets[0].axle->torsion.clear(); }},
        WrongAxle{"increasing", [](VehicleModel& v) { v.wheelsets[0].axle->places[1] = -1.0; }},
        WrongAxle{"the wheels stand at", [](VehicleModel& v) { v.wheelsets[0].axle->wheel_distance = 2.2; }}));

}  // namespace
}  // namespace treadmark::vehicle
