// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"
#include "treadmark/tests/interfaces/fmi/resources_of.hpp"

namespace treadmark::testing {
namespace {

const std::vector<std::string> kShort = {"simulation.distance_m=0.02"};

/// The simulation itself, by the name of its columns.
std::map<std::string, std::vector<double>> history_of(const std::string& file) {
  app::SurfaceStore store;
  const io::SimulationResult result =
      app::run_simulation(io::read_simulation_file(file, kShort), store, {}, Progress{});
  EXPECT_EQ(result.status, "complete") << result.message;
  std::map<std::string, std::vector<double>> columns;
  for (std::size_t i = 0; i < result.values.size(); ++i)
    columns[result.columns[i % result.columns.size()].name].push_back(result.values[i]);
  return columns;
}

class VehicleVersions : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Fmi, VehicleVersions, ::testing::Values(2, 3));

TEST_P(VehicleVersions, AVehicleTakesTheStepsOfTheSimulation) {
  const SampleSimulation sample;
  const auto history = history_of(sample.path("simulation.toml"));
  const std::vector<double>& times = history.at("t_s");
  ASSERT_GT(times.size(), 10u);
  const Fmu fmu(std::filesystem::path(sample.path("simulation.toml")), GetParam(), kShort);
  const auto it = fmu.open();
  ASSERT_EQ(it->initialize(), kOk) << it->messages();
  const auto expect = [&](std::size_t i) {
    for (const auto& [name, values] : history) EXPECT_EQ(it->number(name), values[i]) << name << ' ' << i;
  };
  expect(0);
  // At its own instants, some left out: bit for bit.
  double time = 0.0;
  std::size_t i = 0;
  const auto go_to = [&](double to) {
    double length = to - time;
    while (time + length < to) length = std::nextafter(length, 1.0);
    ASSERT_EQ(it->step(time, length), kOk) << it->messages();
    time += length;
  };
  while (i + 4 < times.size() / 2) {
    i += 1 + i % 3;
    go_to(times[i]);
    expect(i);
  }
  // Between two of them: on a straight line.
  void* saved = nullptr;
  ASSERT_EQ(it->save(&saved), kOk);
  const double saved_time = time, share = 0.25;
  go_to(times[i] + share * (times[i + 1] - times[i]));
  const auto& force = history.at("Q_N");
  EXPECT_NEAR(it->number("Q_N"), force[i] + share * (force[i + 1] - force[i]), 1e-9 * force[i]);
  go_to(times[i + 1]);
  expect(i + 1);
  go_to(times.back());
  expect(times.size() - 1);
  // From the saved state, also in another instance, to the same bits.
  std::string bytes;
  ASSERT_EQ(it->to_bytes(saved, bytes), kOk);
  ASSERT_EQ(it->restore(saved), kOk);
  time = saved_time;
  go_to(times[i + 2]);
  expect(i + 2);
  it->free_state(&saved);
  const auto other = fmu.open();
  ASSERT_EQ(other->from_bytes(bytes, &saved), kOk) << other->messages();
  ASSERT_EQ(other->restore(saved), kOk) << other->messages();
  EXPECT_EQ(other->number("time"), saved_time);
  ASSERT_EQ(other->step(saved_time, times[i + 2] - saved_time), kOk) << other->messages();
  for (const auto& [name, values] : history) EXPECT_EQ(other->number(name), values[i + 2]) << name;
  other->free_state(&saved);

  // The end, and the beginning again.
  go_to(times.back());
  EXPECT_EQ(it->step(time, 1e-3), kError);
  EXPECT_THAT(it->messages(), ::testing::HasSubstr("the simulation ends"));
  std::vector<double> none(1);
  EXPECT_EQ(it->derivative(it->variables().at("Q_N").references, {}, {}, none), kError);
  ASSERT_EQ(it->reset(), kOk);
  ASSERT_EQ(it->initialize(), kOk);
  expect(0);
}

}  // namespace
}  // namespace treadmark::testing
