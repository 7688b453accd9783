// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <span>
#include <string>

#include "treadmark/io/cases/read_text.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

std::string documentation() { return read_text(std::string(TREADMARK_SOURCE_DIR) + "/docs/simulation-files.md"); }

/// Writes the examples of the documentation as the files that their first lines name.
std::set<std::string> write_examples(const treadmark::testing::TemporaryFolder& folder) {
  const std::string text = documentation(), start = "```toml\n# ", end = "```\n";
  std::set<std::string> names;
  for (std::size_t at = text.find(start); at != std::string::npos; at = text.find(start, at + 1)) {
    const std::size_t name_at = at + start.size(), name_end = text.find('\n', name_at), stop = text.find(end, name_end);
    const std::string name = text.substr(name_at, name_end - name_at);
    folder.write(name, text.substr(name_end, stop - name_end));
    names.insert(name);
  }
  return names;
}

TEST(SimulationDocs, ExamplesAreRead) {
  const treadmark::testing::TemporaryFolder folder;
  EXPECT_THAT(write_examples(folder),
              ::testing::ElementsAre("simulation.toml", "study.toml", "track.toml", "vehicle.toml"));
  const SimulationFile simulation = read_simulation_file(folder.path() / "simulation.toml");
  EXPECT_EQ(simulation.vehicle.bodies.size(), 3u);
  EXPECT_EQ(simulation.vehicle.springs.size(), 4u);
  EXPECT_EQ(simulation.wheels.size(), 4u);
  EXPECT_TRUE(simulation.track);
  EXPECT_TRUE(simulation.notes.empty());
  const StudyFile study = read_study_file(folder.path() / "study.toml");
  EXPECT_EQ(study.runs.size(), 24u);
  EXPECT_EQ(std::get<SimulationFile>(read_study_run(study, study.runs.back())).settings.speed, 40.0);
}

TEST(SimulationDocs, EveryKeyIsThere) {
  const std::string text = documentation();
  const auto all = [&](std::span<const std::string_view> keys) {
    for (const std::string_view key : keys)
      EXPECT_NE(text.find('`' + std::string(key) + '`'), std::string::npos) << key;
  };
  for (const std::span<const std::string_view> keys :
       {std::span<const std::string_view>(kVehicleKeys), std::span<const std::string_view>(kTrackKeys),
        std::span<const std::string_view>(kBodyKeys), std::span<const std::string_view>(kSpringKeys),
        std::span<const std::string_view>(kBumpStopKeys), std::span<const std::string_view>(kWheelsetKeys),
        std::span<const std::string_view>(kFieldKeys), std::span<const std::string_view>(kWheelKeys),
        std::span<const std::string_view>(kVaryKeys), std::span<const std::string_view>(kVaryValueKeys),
        std::span<const std::string_view>(kFigureKeys), std::span<const std::string_view>(kMarkKeys)})
    all(keys);
  for (const std::string_view key : kSimulationKeys) {
    const bool table = key == "fields" || key == "wheels" || key == "other_wheel";
    const std::string shown = table ? "simulation." + std::string(key) + ']' : '`' + std::string(key) + '`';
    EXPECT_NE(text.find(shown), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace treadmark::io
