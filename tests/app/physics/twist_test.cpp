// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "treadmark/app/assessment/assess_result.hpp"
#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

/// A body on two axles 6 m apart, by a spring of 3 MN/m on each axle box, a metre from the middle. It is so soft
/// sideways that axles which roll about the rails do not push each other aside.
const char* const kOnFourSprings = R"([vehicle]
name = "on four springs"

[[bodies]]
name = "car"
mass_kg = 20e3
inertia_kg_m2 = [30e3, 200e3, 200e3]
position_m = [0, 0, -1.5]
free = ["y", "z", "roll", "pitch", "yaw"]

[[bodies]]
name = "axle"
mass_kg = 1000
inertia_kg_m2 = [600, 80, 600]
positions_m = [[3, 0, -0.46], [-3, 0, -0.46]]
free = ["x", "y", "z", "roll", "pitch", "yaw"]

[[wheelsets]]
body = "axle1"
nominal_radius_mm = 460
[[wheelsets]]
body = "axle2"
nominal_radius_mm = 460

[[springs]]
name = "box"
stiffness_N_per_m = [10e6, 20e3, 3e6]
damping_N_s_per_m = [20e3, 20e3, 20e3]
places = [
  { between = ["axle1", "car"], at_m = [[3, -1, -0.46], [3, 1, -0.46]] },
  { between = ["axle2", "car"], at_m = [[-3, -1, -0.46], [-3, 1, -0.46]] },
]
)";

std::vector<measures::Assessed> unloading(const io::SimulationFile& file) {
  SurfaceStore store;
  auto result = std::make_shared<io::SimulationResult>(run_simulation(file, store, {}, {}));
  EXPECT_EQ(result->status, "complete") << result->message;
  AssessmentRequest request;
  RunningLimits& limits = request.limits.emplace();
  limits.edition = "made up";
  limits.limits.push_back({.quantity = "dQ_Q", .constant = 0.6});
  std::vector<measures::Assessed> found;
  for (const measures::Assessed& a : assess_result("twist", result, request).quantities)
    if (a.quantity == "dQ_Q") found.push_back(a);
  return found;
}

/// Axles roll by the cross level over the distance of the contacts, s = 1.5 m, and the body stays upright, so that a
/// wheel loses 2 k b^2 c / s^2 of its load.
TEST(TwistTest, UnloadsWheelsOnSpringsAsByHand) {
  const testing::TemporaryFolder folder;
  folder.write("vehicle.toml", kOnFourSprings);
  const io::SimulationFile file = io::read_simulation_file(
      std::string(TREADMARK_SOURCE_DIR) + "/examples/twist-test.toml",
      std::vector<std::string>{"simulation.vehicle=" + (folder.path() / "vehicle.toml").string(),
                               "simulation.distance_m=5", "simulation.twist.period_s=10",
                               "simulation.twist.wheelsets_per_bogie=1"});
  const std::vector<measures::Assessed> wheels = unloading(file);
  ASSERT_EQ(wheels.size(), 4u);
  constexpr double kLevel = 3e-3 * 3.0, kLost = 2.0 * 3e6 * kLevel / (1.5 * 1.5);
  constexpr double kAtRest = 0.5 * 9.81 * (0.5 * 20e3 + 1000.0);
  // By 0.7 % for each 2.4 mm that both contacts of an axle stand aside of its middle, as it leans and profiles roll.
  constexpr double kByContacts = 0.06;
  for (const measures::Assessed& wheel : wheels) {
    EXPECT_NEAR(wheel.value * kAtRest / kLost, 1.0, kByContacts) << wheel.place;
    EXPECT_NEAR(wheel.least * kAtRest / kLost, -1.0, kByContacts) << wheel.place;  // as much on the other side
    EXPECT_EQ(wheel.limit, 0.6);
  }
}

/// With dry friction wheels lose more than by springs alone; the loads of both sides stay that of the wagon.
TEST(TwistTest, FrictionUnloadsWheelsOfAWagonByMore) {
  const std::string example = std::string(TREADMARK_SOURCE_DIR) + "/examples/twist-test.toml";
  const auto with = [&](std::vector<std::string> changes) {
    changes.insert(changes.end(), {"simulation.distance_m=10.5", "simulation.twist.period_s=20"});
    const std::vector<measures::Assessed> wheels = unloading(io::read_simulation_file(example, changes));
    double most = 0.0;
    for (const measures::Assessed& wheel : wheels) {
      EXPECT_EQ(wheel.status, measures::AssessedStatus::ok);
      most = std::max(most, wheel.value);
    }
    EXPECT_EQ(wheels.size(), 8u);
    return most;
  };
  const double rubbing = with({});
  const double smooth = with({"vehicle.frictions.lenoir.coefficient=0.001", "vehicle.frictions.bowl.coefficient=0.001",
                              "vehicle.frictions.bearer.coefficient=0.001"});
  EXPECT_GT(rubbing, smooth + 0.02);
  EXPECT_LT(rubbing, 1.0);
  EXPECT_GT(smooth, 0.02);
}

}  // namespace
}  // namespace treadmark::app
