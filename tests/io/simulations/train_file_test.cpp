// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/model/vehicle/train.hpp"
#include "treadmark/tests/io/simulations/samples.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using ::testing::HasSubstr;

const std::string kExample = std::string(TREADMARK_SOURCE_DIR) + "/examples/train.toml";

SimulationFile example(const std::vector<std::string>& changes = {}) { return read_simulation_file(kExample, changes); }

std::string refusal_of(const std::vector<std::string>& changes) {
  try {
    example(changes);
  } catch (const Error& e) {
    return e.what();
  }
  return "nothing was refused";
}

TEST(TrainFile, HangsVehiclesBehindEachOther) {
  const SimulationFile file = example();
  const VehicleModel& train = file.vehicle;
  EXPECT_EQ(vehicle_count(train), 5);
  ASSERT_EQ(train.couplers.size(), 4u);
  EXPECT_EQ(file.wheels.size(), 40u);
  EXPECT_EQ(train.wheelsets.back().body, "v5_wheelset4");
  const CouplerSpec& last = train.couplers.back();
  EXPECT_EQ(last.front, "v4_car");
  EXPECT_EQ(last.rear, "v5_car");
  EXPECT_DOUBLE_EQ(last.position.x(), -3 * 14.0 - 7.0);
  EXPECT_DOUBLE_EQ(last.slack, 0.02);
  EXPECT_DOUBLE_EQ(last.travel.back(), 0.08);
  EXPECT_DOUBLE_EQ(train.bodies.back().position.x(), -4 * 14.0 - 5.4);
  for (const BodySpec& body : train.bodies)
    if (body.name.ends_with("car")) {
      EXPECT_TRUE(body.free.front()) << body.name;
    }
  for (const DryFrictionSpec& f : train.frictions)
    if (f.name.starts_with("v3_") && !f.load_of.empty()) {
      EXPECT_TRUE(f.load_of.starts_with("v3_")) << f.load_of;
    }
}

TEST(TrainFile, SpeedsFollowFromForces) {
  const SimulationFile file = example();
  ASSERT_TRUE(file.free_run);
  EXPECT_DOUBLE_EQ(file.settings.profile.speed.front(), 15.0);
  EXPECT_LT(file.settings.profile.speed.back(), 14.5);
  EXPECT_NEAR(travel_at(file.settings.profile, file.settings.duration).distance, 100.0, 1e-9);
}

TEST(TrainFile, RefusesWhatMakesNoSense) {
  for (const auto& [change, text] :
       {std::pair{"simulation.train.0.between=[\"car\", \"nobody\"]", "nobody"},
        {"simulation.train.0.between=[\"car\"]", "two bodies"},
        {"simulation.train.0.count=101", "count"},
        {"simulation.train.0.count=100", "more than 100 vehicles"},
        {"simulation.train.0.travel_mm=[1, 2, 3]", "increase from 0"},
        {"simulation.train.0.force_N=[0, 1]", "2 values for 3 travels"},
        {"simulation.train.0.vehicle=\"none.toml\"", "none.toml"},
        {"simulation.free_run.gradient_at_m=[0]", "gradient"},
        {"simulation.free_run.resistance_N=4e6", "comes to rest"},
        {"simulation.duration_s=1", "duration_s"},
        {"simulation.train.0.colour=1", "colour"},
        {"simulation.train.0.behind_m=1", "9.8 m ahead of the last one of the vehicle"},
        {"simulation.train.0.behind_m=11.3", "0.5 m behind the last one of the vehicle"},
        {"simulation.train.0.at_m=[7, 0, -1]", "not between the bodies that it couples"},
        {"simulation.train.0.at_m=[-700, 0, -1]", "whose centres of mass are at 0 and -14"},
        {"simulation.torques.0.wheelset=5", "names of vehicle 2 begin with v2_"},
        {"simulation.torques.0.reaction=\"v3_bogie1\"", "is in vehicle 3 of the train"},
        {"simulation.torques.0.reaction=\"wheelset1\"", "the axle that the torque turns"}})
    EXPECT_THAT(refusal_of({change}), HasSubstr(text)) << change;
  EXPECT_THAT(refusal_of({"simulation.free_run.gradient_at_m=[0, 9]", "simulation.free_run.gradient_per_mille=[1]"}),
              HasSubstr("give one for each place"));
}

const std::string kFolder = std::string(TREADMARK_SOURCE_DIR) + "/examples/";

/// The example without its free run and torques, with something else in their place.
std::string instead(const std::string& tables) {
  std::string text = treadmark::testing::content_of(kExample);
  const std::size_t from = text.find("[simulation.free_run]"), to = text.find("[case]");
  return text.replace(from, to - from, tables);
}

std::string refusal_of_text(const std::string& text) {
  return samples::error_of([&] { parse_simulation_text(text, kFolder + "changed.toml", {}); });
}

TEST(TrainFile, FrictionOfACouplerNeedsBothItsNumbers) {
  EXPECT_THAT(refusal_of_text(samples::with(instead(""), "friction = 0.3\nfriction_stiffness", "friction_stiffness")),
              HasSubstr("friction_stiffness_N_per_m does nothing without friction"));
  EXPECT_THAT(refusal_of_text(samples::with(instead(""), "friction_stiffness_N_per_m = 100e6\n", "")),
              HasSubstr("friction_stiffness_N_per_m is missing"));
  EXPECT_EQ(refusal_of({"simulation.train.0.friction=0"}), "nothing was refused") << "a study of friction";
}

// Of five wagons of 79.4 t, with four axles of 100 kg m2 on wheels of 0.46 m each.
constexpr double kRadius = 0.46, kRunning = 5.0 * (79400.0 + 4.0 * 100.0 / (kRadius * kRadius));

std::string on_all_axles(const std::string& table) {
  std::string all;
  for (int i = 1; i <= 20; ++i)
    all += "[[simulation.torques]]\nwheelset = " + std::to_string(i) + "\nreaction = \"ground\"\n" + table;
  return all;
}

const std::string kProfile = "[simulation.speed_profile]\ntime_s = [0.5, 3.5]\nspeed_m_s = [15, 10]\n";

TEST(TrainFile, ProfilesThatNothingDrivesTheTrainAlongAreRefused) {
  const std::string refused = refusal_of_text(instead(kProfile));
  EXPECT_THAT(refused, HasSubstr("run at 15 m/s then: nothing drives or brakes them"));
  EXPECT_THAT(refused, HasSubstr("-1.667 m/s2 that are wanted take -3.116e+05 N m in all"));  // M a R
  EXPECT_THAT(refusal_of_text(instead("[simulation.speed_profile]\ntime_s = [3]\nspeed_m_s = [10]\n")),
              HasSubstr("nothing drives or brakes them"))
      << "from the start on";
  const auto braked = [&](double share) {
    const std::string torque = std::to_string(-share * kRunning * 5.0 / 3.0 * kRadius / 20.0);
    return refusal_of_text(
        instead(kProfile + on_all_axles("time_s = [0.4999, 0.5001, 3.4999, 3.5001]\ntorque_N_m = [0, " + torque + ", " +
                                        torque + ", 0]\n")));
  };
  EXPECT_EQ(braked(1.0), "no error");
  EXPECT_THAT(braked(0.9), HasSubstr("under torques and forces along x"));
}

TEST(TrainFile, ConstantSpeedIsThatOfABalance) {
  EXPECT_EQ(refusal_of_text(instead("")), "no error");
  EXPECT_THAT(refusal_of_text(instead(on_all_axles("time_s = [0, 1]\ntorque_N_m = [0, 5e3]\n"))),
              HasSubstr("the speed is to stay 15 m/s"));
  const auto force = [](const std::string& body, const std::string& values) {
    return "[[simulation.forces]]\nbody = \"" + body + "\"\ndirection = \"x\"\ntime_s = [0, 1]\nforce_N = " + values +
           '\n';
  };
  const std::string pulled = force("car", "[0, 2e5]"), held = force("v5_car", "[0, -2e5]");
  EXPECT_EQ(refusal_of_text(instead(pulled + held)), "no error") << "drawn at both ends";
  EXPECT_THAT(refusal_of_text(instead(pulled)), HasSubstr("under torques and forces along x"));
  // A force that comes and goes leaves the speed at the end as it was.
  EXPECT_THAT(refusal_of_text(instead("[[simulation.forces]]\nbody = \"car\"\ndirection = \"x\"\ntime_s = [0, 5]\n"
                                      "force_N = [-3e5, 3e5]\n")),
              HasSubstr("under torques and forces along x"));
}

TEST(TrainFile, PointsOfForcesLieInTheirVehicle) {
  const auto at = [](const std::string& x) {
    return refusal_of_text(
        instead("[[simulation.forces]]\nbody = \"v2_car\"\ndirection = \"y\"\ntime_s = [0]\n"
                "force_N = [1e3]\nat_m = [" +
                x + ", 0, -2]\n"));
  };
  for (const char* x : {"-14", "-7", "-21.5"}) EXPECT_EQ(at(x), "no error") << x;
  for (const char* x : {"0", "-5.5", "-28"}) EXPECT_THAT(at(x), HasSubstr("is not in the vehicle of 'v2_car'")) << x;
}

/// 8 kN m on four axles of one wagon, in triangles of 50 ms from 0.2 s on: half of that as a mean.
TEST(TrainFile, TorquesFasterThanATenthOfASecondBrake) {
  std::string time, torque;
  for (int i = 0; i <= 40; ++i) {
    time += (i > 0 ? ", " : "") + std::to_string(0.2 + 0.025 * i);
    torque += (i > 0 ? ", " : "") + std::string(i % 2 == 0 ? "0" : "-8000");
  }
  std::vector<std::string> changes{"simulation.train=[]", "simulation.distance_m=14",
                                   "simulation.free_run.resistance_N=0",
                                   "simulation.free_run.resistance_N_s2_per_m2=0"};
  for (int i = 0; i < 4; ++i) {
    const std::string of = "simulation.torques." + std::to_string(i) + '.';
    changes.push_back(of + "time_s=[" + time + ']');
    changes.push_back(of + "torque_N_m=[" + torque + ']');
  }
  const SimulationFile file = example(changes);
  constexpr double kUntil = 0.9;  // a whole number of triangles
  EXPECT_NEAR(travel_at(file.settings.profile, kUntil).speed,
              15.0 - 4.0 * 4000.0 / kRadius / (0.2 * kRunning) * (kUntil - 0.2), 1e-6);
}

TEST(TrainFile, NamesThatVehiclesGetInATrainAreFree) {
  const treadmark::testing::TemporaryFolder folder;
  std::string wagon = treadmark::testing::content_of(kFolder + "vehicles/y25-wagon.toml");
  for (std::size_t at = wagon.find("\"car\""); at != std::string::npos; at = wagon.find("\"car\"", at))
    wagon.replace(at, 5, "\"v2_car\"");
  folder.write("leading.toml", wagon);
  EXPECT_THAT(refusal_of({"simulation.vehicle=\"" + (folder.path() / "leading.toml").string() + '"',
                          "simulation.train.0.vehicle=\"" + kFolder + "vehicles/y25-wagon.toml\"",
                          "simulation.train.0.between=[\"v2_car\", \"car\"]"}),
              ::testing::AllOf(HasSubstr("leading.toml:11:1: 'v2_car' of the leading vehicle"),
                               HasSubstr("'car' of vehicle 2")));
}

}  // namespace
}  // namespace treadmark::io
