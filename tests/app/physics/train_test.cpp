// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"

namespace treadmark::app {
namespace {

/// Two equal wagons of which the leading one is braked: it takes half of its brakes' force from the one behind.
TEST(TrainOfWagons, RunsUpAgainstTheBrakedOne) {
  const io::SimulationFile file = io::read_simulation_file(
      std::string(TREADMARK_SOURCE_DIR) + "/examples/train.toml",
      std::vector<std::string>{"simulation.train.0.count=1",
                               "simulation.channels=[\"coupler.*\", \"line.*speed*\", \"car.x_m\"]"});
  SurfaceStore store;
  const io::SimulationResult r = run_simulation(file, store, {}, {});
  ASSERT_EQ(r.status, "complete") << r.message;
  EXPECT_EQ(r.message.find("energies"), std::string::npos) << r.message;
  EXPECT_EQ(r.message.find("balance"), std::string::npos)
      << "each wagon's wheels take 25 N, which no other force bears";
  EXPECT_EQ(r.message.find("keep their speed"), std::string::npos) << r.message;
  const auto column = [&](const std::string& name) {
    return [&r, at = io::column_index(r, name)](std::size_t row) { return r.values[row * r.columns.size() + at]; };
  };
  const auto time = column("t_s"), force = column("coupler.1.force_N"), speed = column("line.speed_m_s"),
             mean_speed = column("line.mean_speed_m_s");
  constexpr double kBrakes = 4 * 5e3 / 0.46, kSettled = 2.0;  // [N], before the end [s]
  const std::size_t rows = r.values.size() / r.columns.size();
  double sum = 0.0, duration = 0.0;
  for (std::size_t row = 1; row < rows; ++row) {
    EXPECT_NEAR(mean_speed(row), speed(row), 0.01 * speed(row));
    if (time(row) < time(rows - 1) - kSettled) continue;
    sum += force(row) * (time(row) - time(row - 1));
    duration += time(row) - time(row - 1);
  }
  EXPECT_NEAR(sum / duration, -0.5 * kBrakes, 0.05 * kBrakes);
  EXPECT_LT(column("coupler.1.stretch_m")(rows - 1), -0.01) << "pushed through its free play";
}

}  // namespace
}  // namespace treadmark::app
