// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include <nlohmann/json.hpp>

#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/simulations/read_design.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kDesignBase = R"([wheel]
shape.standard = "S1002"
[rail]
shape.standard = "60E1"
[wheelset]
vertical_force_N = 80e3
velocity_m_s = 2
vpitch_rad_s = -4.3478
)";
const std::string kDesignDepth =
    "[design.depth]\nfrom_mm = -10\nto_mm = 10\nstep_mm = 10\nleast_mm = [0, -0.1, 0]\nmost_mm = [0.2]\n";
const std::string kDesignGoal = "[[design.goals]]\nquantity = \"pmax_MPa\"\n";

class DesignFiles : public ::testing::Test {
 protected:
  DesignFile read(const std::string& design, const std::vector<std::string>& overrides = {}) const {
    return read_design_file(folder_.write("design.toml", "[design]\n" + design + kDesignBase), overrides);
  }
  std::string error(const std::string& design) const {
    try {
      read(design);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }
  treadmark::testing::TemporaryFolder folder_;
};

TEST_F(DesignFiles, SayWhatIsSoughtReachedAndKept) {
  const DesignFile file = read(
      "weights = [1, 3]\nmethod = \"mma\"\n[[design.vary]]\nkey = \"wheelset.y_mm\"\nvalues = [0, 2]\n" + kDesignDepth +
          "ends = \"level\"\n[[design.parameters]]\nkey = \"track.gauge_mm\"\nfrom = 1430\nto = 1440\n" + kDesignGoal +
          "over = \"largest\"\nweight = 2\n[[design.goals]]\nquantity = \"conicity\"\namplitudes_mm = [2, 3]\n"
          "target = 0.1\n[[design.limits]]\nquantity = \"bend_1_per_m\"\nat_most = 5\n",
      {"design.solutions=7", "wheelset.vertical_force_N=70e3"});
  EXPECT_EQ(file.positions.runs.size(), 2u);
  EXPECT_THAT(file.weights, ElementsAre(0.25, 0.75));
  EXPECT_EQ(file.method, DesignFile::Method::mma);
  EXPECT_EQ(file.solutions, 7);
  EXPECT_EQ(file.tolerance, 1e-4);
  ASSERT_TRUE(file.depth);
  EXPECT_EQ(file.depth->body, Body::rail);
  EXPECT_THAT(file.depth->least, ElementsAre(0.0, -0.1e-3, 0.0));
  EXPECT_THAT(file.depth->most, ElementsAre(0.2e-3, 0.2e-3, 0.2e-3));
  EXPECT_TRUE(file.depth->level_ends);
  ASSERT_EQ(file.parameters.size(), 1u);
  EXPECT_EQ(file.parameters[0].key, "track.gauge_mm");
  EXPECT_EQ(file.parameters[0].to, 1440.0) << "in the unit of the key";
  ASSERT_EQ(file.goals.size(), 2u);
  EXPECT_TRUE(file.goals[0].largest);
  EXPECT_EQ(file.goals[0].weight, 2.0);
  EXPECT_EQ(file.goals[0].of.name, "pmax_MPa");
  EXPECT_THAT(file.goals[1].of.amplitudes, ElementsAre(2e-3, 3e-3));
  EXPECT_EQ(file.goals[1].target, 0.1);
  ASSERT_EQ(file.limits.size(), 1u);
  EXPECT_EQ(file.limits[0].at_most, 5.0);
  EXPECT_FALSE(file.limits[0].at_least);
  EXPECT_EQ(file_kind(folder_.path() / "design.toml"), FileKind::design);
  const auto run = std::get<CaseFile>(read_study_run(file.positions, file.positions.runs[1]));
  EXPECT_EQ(std::get<WheelRailCase>(run.cases.at(0).content).vertical_force, 70e3);
}

TEST_F(DesignFiles, RefuseWhatMakesNoSenseWithItsPlace) {
  EXPECT_THAT(error(kDesignGoal), AllOf(HasSubstr("design.toml:1:"), HasSubstr("nothing is sought")));
  EXPECT_THAT(error(kDesignDepth), HasSubstr("design.goals is missing"));
  const auto depth = [&](const std::string& from, const std::string& to) {
    std::string text = kDesignDepth;
    return error(text.replace(text.find(from), from.size(), to) + kDesignGoal);
  };
  EXPECT_THAT(depth("step_mm = 10", "step_mm = 7"), AllOf(HasSubstr("design.toml:5:"), HasSubstr("no whole number")));
  EXPECT_THAT(depth("step_mm = 10", "step_mm = 0.01"), HasSubstr("2001 places are more"));
  EXPECT_THAT(depth("to_mm = 10", "to_mm = -20"), HasSubstr("no whole number"));
  EXPECT_THAT(depth("[0, -0.1, 0]", "[0, 0]"), HasSubstr("2 numbers for 3 places"));
  EXPECT_THAT(depth("most_mm = [0.2]", "most_mm = [-0.05]"), HasSubstr("is less than design.depth.least_mm"));
  EXPECT_THAT(depth("most_mm = [0.2]", "most_mm = [0, -0.1, 0]"), HasSubstr("no depth is sought"));
  EXPECT_THAT(depth("most_mm = [0.2]", "mosst_mm = [0.2]"), HasSubstr("did you mean 'design.depth.most_mm'?"));
  const auto goal = [&](const std::string& more) { return error(kDesignDepth + kDesignGoal + more); };
  EXPECT_THAT(goal("over = \"largest\"\ntarget = 1\n"), HasSubstr("target is for means"));
  EXPECT_THAT(goal("target = 0\n"), HasSubstr("needs design.goals.scale"));
  EXPECT_THAT(goal("amplitudes_mm = [3, 2]\n"), HasSubstr("must increase"));
  EXPECT_THAT(goal("weight = -1\n"), HasSubstr("must be greater than 0"));
  EXPECT_THAT(goal("[[design.limits]]\nquantity = \"pmax_MPa\"\n"), HasSubstr("at_least is missing"));
  EXPECT_THAT(goal("[[design.limits]]\nquantity = \"pmax_MPa\"\nat_most = 1\nat_least = 2\n"),
              HasSubstr("is more than design.limits.at_most"));
  EXPECT_THAT(goal("[[design.parameters]]\nkey = \"track.gauge_mm\"\nfrom = 2\nto = 1\n"), HasSubstr("more than"));
  EXPECT_THAT(error("weights = [1, 2]\n" + kDesignDepth + kDesignGoal), HasSubstr("2 values for 1 positions"));
  folder_.write("simulation.toml", "[design]\n" + kDesignDepth + kDesignGoal + "[simulation]\nspeed_m_s = 1\n");
  EXPECT_THROW(read_design_file(folder_.path() / "simulation.toml"), Error);
  EXPECT_THROW(read_case_file(folder_.write("design.toml", "[design]\n" + kDesignBase)), Error) << "a design, no case";
}

TEST(DesignDocs, TablesOfKeysAndTheExampleAreUpToDate) {
  const std::string root = TREADMARK_SOURCE_DIR;
  EXPECT_THAT(read_text(root + "/docs/design.md"), HasSubstr(design_key_table()));
  const DesignFile example = read_design_file(root + "/examples/ground-rail.toml");
  EXPECT_EQ(example.positions.runs.size(), 5u);
  EXPECT_EQ(example.depth->most.size(), 9u);
  const nlohmann::json schema = nlohmann::json::parse(design_file_schema());
  EXPECT_TRUE(schema.at("properties").at("design").at("properties").contains("goals"));
  EXPECT_EQ(schema.at("required"), nlohmann::json({"design"}));
}

}  // namespace
}  // namespace treadmark::io
