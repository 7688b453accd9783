// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <toml++/toml.h>
#include <nlohmann/json.hpp>

#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"
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
  EXPECT_THAT(write_examples(folder), ::testing::ElementsAre("flexible-track.toml", "simulation.toml", "study.toml",
                                                             "track.toml", "vehicle.toml"));
  EXPECT_EQ(std::get<FlexibleTrack>(read_any_track_file(folder.path() / "flexible-track.toml")).seats.size(), 160u);
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

TEST(SimulationDocs, TablesOfKeysAreUpToDate) {
  const std::string text = documentation();
  for (const std::string& table : {vehicle_key_table(), track_key_table(), simulation_key_table(), study_key_table()})
    EXPECT_NE(text.find(table), std::string::npos) << "docs/simulation-files.md must contain:\n" << table;
}

using Json = nlohmann::json;

/// Every table and key of a file must stand in its schema.
void expect_described(const toml::table& table, const Json& schema, const std::string& path) {
  for (const auto& [key, value] : table) {
    const std::string name(key.str());
    ASSERT_TRUE(schema.contains("properties") && schema.at("properties").contains(name)) << path << '.' << name;
    const Json& own = schema.at("properties").at(name);
    if (const toml::table* inner = value.as_table()) expect_described(*inner, own, path + '.' + name);
    if (const toml::array* list = value.as_array(); list != nullptr && list->is_array_of_tables())
      for (const toml::node& one : *list)
        if (own.contains("items") && own.at("items").contains("properties"))
          expect_described(*one.as_table(), own.at("items"), path + '.' + name);
  }
}

TEST(SimulationSchema, DescribesTheExamples) {
  const treadmark::testing::TemporaryFolder folder;
  write_examples(folder);
  const std::pair<const char*, std::string> schemas[] = {{"vehicle.toml", vehicle_file_schema()},
                                                         {"track.toml", track_file_schema()},
                                                         {"flexible-track.toml", track_file_schema()},
                                                         {"simulation.toml", simulation_file_schema()},
                                                         {"study.toml", study_file_schema()}};
  for (const auto& [name, text] : schemas) {
    SCOPED_TRACE(name);
    const Json schema = Json::parse(text);
    EXPECT_EQ(schema.at("additionalProperties"), false);
    expect_described(toml::parse(read_text(folder.path() / name)), schema, name);
  }
}

TEST(SimulationSchema, DescribesEvolutionsOfBothBases) {
  const Json schema = Json::parse(evolve_file_schema());
  for (const char* name : {"flat-in-motion.toml", "spread-of-rails.toml"})
    expect_described(toml::parse(read_text(std::filesystem::path(TREADMARK_SOURCE_DIR) / "examples" / name)), schema,
                     name);
}

TEST(SimulationSchema, HasLimitsAndDefaults) {
  const Json schema = Json::parse(simulation_file_schema());
  const Json& simulation = schema.at("properties").at("simulation");
  EXPECT_EQ(simulation.at("properties").at("tolerance_um").at("default"), 0.1);
  EXPECT_EQ(simulation.at("properties").at("speed_m_s").at("maximum"), 1000.0);
  EXPECT_EQ(simulation.at("required"), Json({"vehicle"}));
  EXPECT_EQ(schema.at("required"), Json({"simulation"}));
  const Json springs = Json::parse(vehicle_file_schema()).at("properties").at("springs").at("items").at("properties");
  EXPECT_EQ(springs.at("stiffness_N_per_m").at("minItems"), 3);
  EXPECT_EQ(springs.at("stiffness_N_per_m").at("items").at("minimum"), 0.0);
}

}  // namespace
}  // namespace treadmark::io
