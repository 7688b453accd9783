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
  for (const auto& [change, text] : {std::pair{"simulation.train.0.between=[\"car\", \"nobody\"]", "nobody"},
                                     {"simulation.train.0.between=[\"car\"]", "two bodies"},
                                     {"simulation.train.0.count=101", "count"},
                                     {"simulation.train.0.count=100", "more than 100 vehicles"},
                                     {"simulation.train.0.travel_mm=[1, 2, 3]", "increase from 0"},
                                     {"simulation.train.0.force_N=[0, 1]", "2 values for 3 travels"},
                                     {"simulation.train.0.vehicle=\"none.toml\"", "none.toml"},
                                     {"simulation.free_run.gradient_at_m=[0]", "gradient"},
                                     {"simulation.free_run.resistance_N=4e6", "comes to rest"},
                                     {"simulation.duration_s=1", "duration_s"},
                                     {"simulation.train.0.colour=1", "colour"}})
    EXPECT_THAT(refusal_of({change}), HasSubstr(text)) << change;
}

}  // namespace
}  // namespace treadmark::io
