// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "samples.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"

namespace treadmark::io {
namespace {

using samples::kTrack;
using samples::kVehicle;

const std::string kExamples = std::string(TREADMARK_SOURCE_DIR) + "/examples/";

double total_mass(const std::vector<BodySpec>& bodies) {
  double sum = 0.0;
  for (const BodySpec& body : bodies) sum += body.mass;
  return sum;
}

const BodySpec& body_of(const std::vector<BodySpec>& bodies, const std::string& name) {
  for (const BodySpec& body : bodies)
    if (body.name == name) return body;
  ADD_FAILURE() << "no body " << name;
  return bodies.at(0);
}

TEST(VehicleFile, ReadsPartsInSIUnits) {
  const VehicleModel vehicle = parse_vehicle_text(kVehicle, "v.toml");
  EXPECT_EQ(vehicle.name, "small");
  ASSERT_EQ(vehicle.bodies.size(), 2u);
  const BodySpec& axle = vehicle.bodies[1];
  EXPECT_EQ(axle.mass, 1800.0);
  EXPECT_EQ(axle.inertia, Vec3(1100.0, 110.0, 1100.0));
  EXPECT_EQ(axle.position, Vec3(0.0, 0.0, -0.46));
  EXPECT_TRUE(std::all_of(axle.free.begin(), axle.free.end(), [](bool free) { return free; }));
  EXPECT_EQ(vehicle.bodies[0].free, (std::array<bool, 6>{false, false, true, false, false, false}));
  EXPECT_EQ(axle.where.to_string(), "v.toml:10:1");
  ASSERT_EQ(vehicle.springs.size(), 2u);
  EXPECT_EQ(vehicle.springs[0].name, "primary1");
  EXPECT_EQ(vehicle.springs[1].name, "primary2");
  EXPECT_EQ(vehicle.springs[1].position, Vec3(0.0, 1.0, -0.46));
  EXPECT_EQ(vehicle.springs[1].stiffness, (SixValues{30e6, 4e6, 1.2e6, 0, 0, 0}));
  EXPECT_EQ(vehicle.springs[1].damping, (SixValues{0, 0, 4e3, 0, 0, 0}));
  EXPECT_EQ(vehicle.springs[1].damper_stiffness, (SixValues{0, 0, 1e6, 0, 0, 0}));
  ASSERT_EQ(vehicle.bump_stops.size(), 1u);
  EXPECT_EQ(vehicle.bump_stops[0].name, "stop");
  EXPECT_EQ(vehicle.bump_stops[0].direction, Freedom::y);
  EXPECT_THAT(vehicle.bump_stops[0].displacement,
              ::testing::ElementsAre(::testing::DoubleEq(0.025), ::testing::DoubleEq(0.030)));
  EXPECT_THAT(vehicle.bump_stops[0].force, ::testing::ElementsAre(0.0, 600.0));
  ASSERT_EQ(vehicle.wheelsets.size(), 1u);
  EXPECT_EQ(vehicle.wheelsets[0].body, "axle");
  EXPECT_DOUBLE_EQ(vehicle.wheelsets[0].nominal_radius, 0.46);
}

TEST(VehicleFile, DryFrictionIsPressedByWhatItNames) {
  const std::string text = samples::with(kVehicle, "[[bump_stops]]", R"([[frictions]]
name = "leaf"
between = ["axle", "mass"]
at_m = [[0, -1, -0.46], [0, 1, -0.46]]
directions = ["y", "z"]
stiffness_N_per_m = 2e7
damping_N_s_per_m = 1e4
coefficient = 0.3
static_ratio = 1.2
normal_force_N = 100
load_of = ["primary"]
load_share = 0.5

[[frictions]]
name = "pivot"
between = ["axle", "mass"]
at_m = [[0, 0, -0.6]]
directions = ["yaw"]
arm_mm = 120
stiffness_N_per_m = 1e7
coefficient = 0.1
coefficient_back = 0.2
load_of = ["stop"]

[[damper_curves]]
name = "yaw"
between = ["axle", "mass"]
at_m = [[0, 1.3, -0.6]]
direction = "x"
velocity_m_s = [0, 0.01, 0.2]
force_N = [0, 10e3, 12e3]
series_stiffness_N_per_m = 6e6

[[bump_stops]])");
  const VehicleModel vehicle = parse_vehicle_text(text, "v.toml", std::vector{parse_override("scale_damping=2")});
  ASSERT_EQ(vehicle.frictions.size(), 3u);
  const DryFrictionSpec &leaf = vehicle.frictions[1], &pivot = vehicle.frictions[2];
  EXPECT_EQ(leaf.name, "leaf2");
  EXPECT_EQ(leaf.position, Vec3(0.0, 1.0, -0.46));
  EXPECT_EQ(leaf.directions, (std::array<bool, 6>{false, true, true, false, false, false}));
  EXPECT_EQ(leaf.stiffness, 2e7);
  EXPECT_EQ(leaf.damping, 1e4);
  EXPECT_EQ(leaf.coefficient, 0.3);
  EXPECT_FALSE(leaf.coefficient_back);
  EXPECT_EQ(leaf.static_ratio, 1.2);
  EXPECT_EQ(leaf.normal_force, 100.0);
  EXPECT_EQ(vehicle.frictions[0].load_of, "primary1");
  EXPECT_EQ(leaf.load_of, "primary2");
  EXPECT_EQ(leaf.load_share, 0.5);
  EXPECT_EQ(pivot.name, "pivot");
  EXPECT_NEAR(pivot.arm, 0.12, 1e-15);
  EXPECT_EQ(pivot.coefficient_back, 0.2);
  EXPECT_EQ(pivot.load_of, "stop");
  ASSERT_EQ(vehicle.damper_curves.size(), 1u);
  EXPECT_EQ(vehicle.damper_curves[0].velocity, (std::vector{0.0, 0.01, 0.2}));
  EXPECT_EQ(vehicle.damper_curves[0].force, (std::vector{0.0, 20e3, 24e3}));  // scaled
  EXPECT_EQ(vehicle.damper_curves[0].series_stiffness, 6e6);
  EXPECT_TRUE(parse_vehicle_text(text, "v.toml", std::vector{parse_override("scale_damping=0")}).damper_curves.empty());
}

TEST(VehicleFile, AirSpringsAreRead) {
  const VehicleModel vehicle = parse_vehicle_text(samples::with(kVehicle, "[[bump_stops]]", R"([[air_springs]]
name = "air"
between = ["axle", "mass"]
at_m = [[0, -1, -0.46], [0, 1, -0.46]]
load_N = 40e3
area_m2 = 0.2
bellows_m3 = 0.02
reservoir_m3 = 0.03
orifice_mm = 20
loss_coefficient = 1.5

[[bump_stops]])"),
                                                  "v.toml");
  ASSERT_EQ(vehicle.air_springs.size(), 2u);
  const AirSpringSpec& air = vehicle.air_springs[1];
  EXPECT_EQ(air.name, "air2");
  EXPECT_EQ(air.position, Vec3(0.0, 1.0, -0.46));
  EXPECT_EQ(air.load, 40e3);
  EXPECT_EQ(air.area, 0.2);
  EXPECT_EQ(air.bellows, 0.02);
  EXPECT_EQ(air.reservoir, 0.03);
  EXPECT_NEAR(air.orifice, 0.02, 1e-15);
  EXPECT_EQ(air.loss, 1.5);
  EXPECT_EQ(air.exponent, 1.4);
}

TEST(VehicleFile, RotationalValuesAreTheLastThree) {
  const std::string text = samples::with(
      kVehicle, "damping_N_s_per_m = [0, 0, 4e3]",
      "damping_N_s_per_m = [0, 0, 4e3]\nrotational_stiffness_N_m_per_rad = [1, 2, 3]\n"
      "rotational_damping_N_m_s_per_rad = [4, 5, 6]\nrotational_damper_stiffness_N_m_per_rad = [7, 8, 9]");
  const SpringSpec spring = parse_vehicle_text(text, "v.toml").springs.at(0);
  EXPECT_EQ(spring.stiffness, (SixValues{30e6, 4e6, 1.2e6, 1, 2, 3}));
  EXPECT_EQ(spring.damping, (SixValues{0, 0, 4e3, 4, 5, 6}));
  EXPECT_EQ(spring.damper_stiffness, (SixValues{0, 0, 1e6, 7, 8, 9}));
}

TEST(TrackFile, ReadsRailsAndPlaces) {
  const TrackModel track = parse_track_text(kTrack, "t.toml");
  EXPECT_EQ(track.left_rail, "left");
  EXPECT_EQ(track.right_rail, "right");
  ASSERT_EQ(track.springs.size(), 2u);
  EXPECT_EQ(track.springs[0].body_a, kGround);
  EXPECT_EQ(track.springs[0].body_b, "left");
  EXPECT_EQ(track.springs[1].name, "pad2");
  EXPECT_EQ(track.springs[1].position.y(), 0.75);
}

TEST(VehicleFile, OverridesByName) {
  const std::vector<CaseOverride> changes{parse_override("bodies.mass.mass_kg=30000"),
                                          parse_override("springs.primary.stiffness_N_per_m=[1e6, 2e6, 3e6]"),
                                          parse_override("springs.primary.damping_N_s_per_m.2=5e3"),
                                          parse_override("wheelsets.0.nominal_radius_mm=500"),
                                          parse_override("bump_stops.stop.rotational=1"),
                                          parse_override("name=other")};
  const std::vector<CaseOverride> good = {changes[0], changes[1], changes[2], changes[3], changes[5]};
  const VehicleModel vehicle = parse_vehicle_text(kVehicle, "v.toml", good);
  EXPECT_EQ(vehicle.name, "other");
  EXPECT_EQ(vehicle.bodies[0].mass, 30000.0);
  EXPECT_EQ(vehicle.springs[1].stiffness, (SixValues{1e6, 2e6, 3e6, 0, 0, 0}));
  EXPECT_EQ(vehicle.springs[0].damping[2], 5e3);
  EXPECT_DOUBLE_EQ(vehicle.wheelsets[0].nominal_radius, 0.5);
  EXPECT_THAT(samples::error_of([&] { parse_vehicle_text(kVehicle, "v.toml", changes); }),
              ::testing::HasSubstr("override 'bump_stops.stop.rotational=1': unknown key 'bump_stops.rotational'"));
}

TEST(TrackFile, ScalesAllMassesStiffnessesAndDampings) {
  const TrackModel plain = parse_track_text(kTrack, "t.toml");
  const std::vector<CaseOverride> changes{parse_override("scale_mass=1.5"), parse_override("scale_stiffness=0.5"),
                                          parse_override("scale_damping=3")};
  const TrackModel scaled = parse_track_text(kTrack, "t.toml", changes);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_DOUBLE_EQ(scaled.bodies[i].mass, 1.5 * plain.bodies[i].mass);
    for (std::size_t d = 0; d < 6; ++d) {
      EXPECT_DOUBLE_EQ(scaled.springs[i].stiffness[d], 0.5 * plain.springs[i].stiffness[d]);
      EXPECT_DOUBLE_EQ(scaled.springs[i].damping[d], 3.0 * plain.springs[i].damping[d]);
    }
  }
}

TEST(ShippedVehicle, ManchesterHasItsMassesAndIsSymmetric) {
  const VehicleModel vehicle = read_vehicle_file(kExamples + "vehicles/manchester.toml");
  EXPECT_NEAR(total_mass(vehicle.bodies), 44482.0, 1e-9);
  EXPECT_NEAR(total_mass(vehicle.bodies) * 9.81 / 8.0, 54.55e3, 5.0);
  EXPECT_EQ(vehicle.bodies.size(), 7u);
  EXPECT_EQ(vehicle.wheelsets.size(), 4u);
  EXPECT_EQ(vehicle.springs.size(), 8u + 4u + 2u + 2u);
  EXPECT_EQ(vehicle.bump_stops.size(), 2u);
  // Leading wheelset first; wheelbase 2.56 m, bogies 19 m apart.
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_GT(body_of(vehicle.bodies, vehicle.wheelsets[i - 1].body).position.x(),
              body_of(vehicle.bodies, vehicle.wheelsets[i].body).position.x());
  EXPECT_NEAR(body_of(vehicle.bodies, "wheelset1").position.x() - body_of(vehicle.bodies, "wheelset2").position.x(),
              2.56, 1e-12);
  EXPECT_NEAR(body_of(vehicle.bodies, "bogie1").position.x() - body_of(vehicle.bodies, "bogie2").position.x(), 19.0,
              1e-12);
  // Weights balance about the middle, and every spring has its mirror images.
  Vec3 moment = Vec3::Zero();
  for (const BodySpec& body : vehicle.bodies) moment += body.mass * body.position;
  EXPECT_NEAR(moment.x(), 0.0, 1e-9);
  EXPECT_NEAR(moment.y(), 0.0, 1e-9);
  double primary = 0.0, secondary = 0.0;
  for (const SpringSpec& spring : vehicle.springs) {
    const bool mirrored = std::any_of(vehicle.springs.begin(), vehicle.springs.end(), [&](const SpringSpec& other) {
      return (other.position - Vec3(-spring.position.x(), -spring.position.y(), spring.position.z())).norm() < 1e-12 &&
             other.stiffness == spring.stiffness && other.damping == spring.damping;
    });
    EXPECT_TRUE(mirrored) << spring.name;
    (spring.name.starts_with("primary") ? primary : secondary) += spring.stiffness[2];
  }
  EXPECT_DOUBLE_EQ(primary, 8 * 1.220e6);
  EXPECT_DOUBLE_EQ(secondary, 4 * 0.430e6);
}

TEST(ShippedVehicle, SmallOnesCarryTheSameWheelLoad) {
  for (const char* name : {"vehicles/single-wheelset.toml", "vehicles/wheel-on-mass.toml"}) {
    const VehicleModel vehicle = read_vehicle_file(kExamples + name);
    EXPECT_EQ(vehicle.wheelsets.size(), 1u);
    EXPECT_NEAR(total_mass(vehicle.bodies) * 9.81 / 2.0, 44482.0 * 9.81 / 8.0, 1e-6) << name;
  }
}

/// The derivation that the file states, again from Zhai's data by another way: the characteristic length of the beam on
/// its bed.
TEST(ShippedTrack, ZhaiIsWhatItsDataSay) {
  const TrackModel track = read_track_file(kExamples + "tracks/zhai-equivalent.toml");
  const double bending = 2.059e11 * 3.217e-5, bed = 65e6 / 0.545;
  const double wave_number = std::pow(bed / (4.0 * bending), 0.25);
  const double point = 8.0 * std::pow(wave_number, 3) * bending, seats = point / 65e6;
  const auto spring = [&](const std::string& name) {
    for (const SpringSpec& one : track.springs)
      if (one.name == name) return one;
    ADD_FAILURE() << name;
    return SpringSpec{};
  };
  constexpr double kRounding = 1e-4;
  for (const char* pad : {"pad1", "pad2"}) {
    EXPECT_NEAR(spring(pad).stiffness[2] / point, 1.0, kRounding);
    EXPECT_NEAR(spring(pad).damping[2] / (seats * 75e3), 1.0, kRounding);
    EXPECT_NEAR(spring(pad).stiffness[3] / (point * 0.15 * 0.15 / 12.0), 1.0, kRounding);
  }
  EXPECT_NEAR(spring("ballast1").stiffness[2] / (seats * 137.75e6), 1.0, kRounding);
  EXPECT_NEAR(spring("ballast2").damping[2] / (seats * 58.8e3), 1.0, kRounding);
  EXPECT_NEAR(body_of(track.bodies, "left_rail").mass / (60.64 * point / bed), 1.0, kRounding);
  EXPECT_NEAR(body_of(track.bodies, "sleepers").mass / (seats * 251.0), 1.0, kRounding);
}

TEST(ShippedTrack, P2ValuesAndFrequency) {
  const TrackModel track = read_track_file(kExamples + "tracks/gm-tt0088.toml");
  EXPECT_EQ(body_of(track.bodies, track.left_rail).mass, 245.0);
  EXPECT_EQ(track.springs.at(0).stiffness[2], 62e6);
  // Half a wheelset of 1813 kg on it: the P2 frequency of 36.9 Hz.
  EXPECT_NEAR(std::sqrt(62e6 / (906.5 + 245.0)) / (2.0 * 3.141592653589793), 36.9, 0.1);
}

}  // namespace
}  // namespace treadmark::io
