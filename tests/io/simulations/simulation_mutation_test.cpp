// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include "samples.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

/// One line is lost or said twice, one value is another one, or the file ends early.
std::string damaged(const std::string& text, Random& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.uniform() * static_cast<double>(n)); };
  const std::size_t start = text.find('\n', below(text.size() - 2)), end = text.find('\n', start + 1);
  if (start == std::string::npos || end == std::string::npos) return text.substr(0, below(text.size()));
  const std::string line = text.substr(start, end - start), key = line.substr(0, line.find('=') + 1);
  constexpr const char* kValues[] = {"0",    "-1",          "1e308", "nan",  "\"\"", "\"x\"",    "[]",
                                     "[[]]", "[[1, 2], 3]", "{}",    "[{}]", "true", "[1, 2, 3]"};
  std::string result = text;
  switch (below(4)) {
    case 0:
      return result.erase(start, end - start);
    case 1:
      return result.insert(start, line);
    default:
      return result.replace(start, end - start, key.size() > 1 ? key + kValues[below(std::size(kValues))] : line + "x");
  }
}

constexpr int kMutants = 2000;

/// Anything but Error ends the test; most of what is damaged must be noticed.
template <class Parse>
void expect_errors(const std::string& text, std::uint64_t seed, Parse parse) {
  Random random(seed);
  int accepted = 0;
  for (int i = 0; i < kMutants; ++i) {
    try {
      parse(damaged(text, random));
      ++accepted;
    } catch (const Error& error) {
      EXPECT_FALSE(error.message().empty());
      EXPECT_FALSE(error.where().file.empty()) << error.what();
    }
  }
  EXPECT_LT(accepted, kMutants / 2);
}

TEST(SimulationMutation, VehicleOnlyThrowsError) {
  expect_errors(samples::kVehicle, 1, [](const std::string& text) { parse_vehicle_text(text, "v.toml"); });
}

TEST(SimulationMutation, FlexibleWheelsetOnlyThrowsError) {
  expect_errors(samples::kWithAxle, 5, [](const std::string& text) { parse_vehicle_text(text, "v.toml"); });
}

TEST(SimulationMutation, TrackOnlyThrowsError) {
  expect_errors(samples::kTrack, 2, [](const std::string& text) { parse_track_text(text, "t.toml"); });
}

TEST(SimulationMutation, SimulationOnlyThrowsError) {
  const treadmark::testing::TemporaryFolder folder;
  folder.write("vehicle.toml", samples::kVehicle);
  folder.write("track.toml", samples::kTrack);
  const auto name = folder.path() / "s.toml";
  expect_errors(samples::kSimulation, 3, [&](const std::string& text) { parse_simulation_text(text, name); });
}

TEST(SimulationMutation, OverridesOnlyThrowError) {
  const treadmark::testing::TemporaryFolder folder;
  folder.write("vehicle.toml", samples::kVehicle);
  folder.write("track.toml", samples::kTrack);
  for (const std::string& path :
       {std::string("simulation"), std::string("simulation."), std::string("vehicle."), std::string("vehicle.bodies"),
        std::string("vehicle.vehicle"), std::string("track_model.springs.pad"), std::string("title.a"),
        "simulation" + std::string(100000, '.'), "vehicle" + [] {
          std::string deep;
          for (int i = 0; i < 50000; ++i) deep += ".a";
          return deep;
        }()})
    for (const char* value : {"3", "[]", "{}", "word", "[{}]"})
      EXPECT_THROW(parse_simulation_text(samples::kSimulation, folder.path() / "s.toml",
                                         std::vector<std::string>{path + '=' + value}),
                   Error)
          << path.substr(0, 50) << '=' << value;
}

}  // namespace
}  // namespace treadmark::io
