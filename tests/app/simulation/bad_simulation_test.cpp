// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

// Bad input of simulations gets one clear message that says where, exit status 2, and nothing runs or is written.

namespace treadmark::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class BadSimulation : public ::testing::Test {
 protected:
  ProgramResult run(const std::string& verb, const std::string& file,
                    const std::vector<std::string>& options = {}) const {
    std::vector<std::string> words{verb, input.path(file), "-o", input.path("out")};
    words.insert(words.end(), options.begin(), options.end());
    return run_program(words);
  }
  void expect_refused(const std::vector<std::string>& words, const std::vector<std::string>& options = {}) const {
    expect_refusal(run("simulate", "simulation.toml", options), words);
    EXPECT_FALSE(std::filesystem::exists(input.path("out")));
    // What `simulate` refuses, `check` finds.
    std::vector<std::string> check{"check", input.path("simulation.toml")};
    check.insert(check.end(), options.begin(), options.end());
    EXPECT_EQ(run_program(check).status, 2);
  }
  static void expect_refusal(const ProgramResult& r, const std::vector<std::string>& words) {
    EXPECT_EQ(r.status, 2) << r.err << r.out;
    EXPECT_EQ(r.out, "");
    for (const std::string& word : words) EXPECT_THAT(r.err, ContainsRegex(word));
    EXPECT_EQ(ranges::count(r.err, '\n'), 1) << "one message: " << r.err;
  }
  SampleSimulation input;
};

TEST_F(BadSimulation, NegativeMass) {
  input.edit("vehicle.toml", "mass_kg = 9000", "mass_kg = -9000");
  expect_refused({"vehicle\\.toml:6:[0-9]+", "mass_kg"});
}

TEST_F(BadSimulation, RailsThatAreNotThereToBeShared) {
  expect_refused({"simulation\\.shared_rails = true", "lumped", "flexible"}, {"--set", "simulation.shared_rails=true"});
  input.edit("simulation.toml", "track = \"track.toml\"\n", "shared_rails = true\n");
  expect_refused({"simulation\\.toml:5:[0-9]+", "there is no flexible track"});
}

TEST_F(BadSimulation, WheelsTooCloseForTheElementsOfTheirRail) {
  input.share_rails();
  input.edit("vehicle.toml", "[-0.9, 0, -0.46]]", "[0.89, 0, -0.46]]");
  expect_refused({"0\\.01 m apart", "bay_elements"});
}

TEST_F(BadSimulation, ShapeThatCannotBeRead) {
  input.write("bad.prr", "0 0\n1 what\n");
  const std::vector<std::string> options{"--set", "rail.shape.file=" + input.path("bad.prr")};
  const ProgramResult refused = run("simulate", "simulation.toml", options);
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, ContainsRegex("bad\\.prr:1:1"));
  EXPECT_FALSE(std::filesystem::exists(input.path("out")));
}

TEST_F(BadSimulation, MissingSpring) {
  std::string text = input.read("vehicle.toml");
  const auto begin = text.find("[[springs]]"), end = text.find("[[bump_stops]]");
  input.write("vehicle.toml", text.erase(begin, end - begin));
  expect_refused({"vehicle\\.toml:[0-9]+:[0-9]+", "mass"});
}

TEST_F(BadSimulation, SpringThatHoldsNothing) {
  input.edit("vehicle.toml", "stiffness_N_per_m = [30e6, 4e6, 1.2e6]", "stiffness_N_per_m = [30e6, 4e6, 0]");
  expect_refused({"vehicle\\.toml:[0-9]+:[0-9]+", "mass"});
}

TEST_F(BadSimulation, UnknownWheel) {
  input.edit("simulation.toml", "wheelset = 1", "wheelset = 9");
  expect_refused({"simulation\\.toml:11:[0-9]+", "wheelset"});
}

TEST_F(BadSimulation, StepsTooLongForTransientRolling) {
  input.edit("simulation.toml", "speed_m_s = 20", "max_step_elements = 3\nspeed_m_s = 20");
  expect_refused({"simulation\\.toml:6:[0-9]+", "max_step_elements"});
}

TEST_F(BadSimulation, SpeedZero) {
  input.edit("simulation.toml", "speed_m_s = 20", "speed_m_s = 0");
  expect_refused({"simulation\\.toml:6:[0-9]+", "speed_m_s"});
}

TEST_F(BadSimulation, UnknownKeyWithWhatWasMeant) {
  input.edit("simulation.toml", "speed_m_s = 20", "sped_m_s = 20");
  expect_refused({"simulation\\.toml:6:[0-9]+", "sped_m_s", "speed_m_s"});
}

TEST_F(BadSimulation, UnknownKeyOfAnOverride) {
  expect_refused({"wheel\\.flts"}, {"--set", "wheel.flts.0.depth_mm=1"});
}

TEST_F(BadSimulation, ChannelsThatAreNone) {
  input.edit("simulation.toml", "speed_m_s = 20", "channels = [\"Q_N\", \"mass.zz_m\"]\nspeed_m_s = 20");
  expect_refused({"simulation\\.toml:6:[0-9]+", "no channel", "did you mean 'mass\\.z_m'"});
}

TEST_F(BadSimulation, SpectraOfChannelsThatAreNotKept) {
  input.edit("simulation.toml", "speed_m_s = 20", "channels = [\"Q_N\"]\nspeed_m_s = 20");
  input.edit("simulation.toml", "[case]", "[assessment]\nspectra = [\"mass.z_m\"]\n\n[case]");
  expect_refused({"simulation\\.toml", "no channel", "mass\\.z_m"});
}

TEST_F(BadSimulation, StepsOfAFlexibleTrackThatAreTooLong) {
  input.share_rails();
  expect_refused({"shortest step of 60 us exceeds the longest one of 50 us"},
                 {"--set", "simulation.min_step_us=60", "--set", "simulation.speed_m_s=0.5"});
}

TEST_F(BadSimulation, VehicleThatIsNotThere) {
  input.edit("simulation.toml", "vehicle = \"vehicle.toml\"", "vehicle = \"absent.toml\"");
  expect_refused({"absent\\.toml", "simulation\\.toml:4:[0-9]+"});
}

TEST_F(BadSimulation, ShapeThatIsNotThereIsBadData) {
  input.edit("simulation.toml", "shape.standard = \"60E1\"", "shape.file = \"absent.prr\"");
  const ProgramResult r = run("simulate", "simulation.toml");
  EXPECT_EQ(r.status, 3) << r.err;
  EXPECT_THAT(r.err, ContainsRegex("simulation\\.toml:[0-9]+:[0-9]+"));
  EXPECT_THAT(r.err, HasSubstr("absent.prr"));
  EXPECT_EQ(run_program({"check", input.path("simulation.toml")}).status, 3);
}

TEST_F(BadSimulation, StudyAndSimulationAreToldApart) {
  expect_refusal(run("simulate", "study.toml"), {"is a study", "treadmark sweep"});
  expect_refusal(run("sweep", "simulation.toml"), {"is not a study", "treadmark simulate"});
  expect_refusal(run_program({"run", input.path("simulation.toml")}), {"treadmark simulate"});
  expect_refusal(run_program({"run", input.path("study.toml")}), {"treadmark sweep"});
  EXPECT_FALSE(std::filesystem::exists(input.path("out")));
}

TEST_F(BadSimulation, ResumeNeedsAFolder) {
  expect_refusal(run_program({"simulate", input.path("simulation.toml"), "--resume"}), {"--resume", "-o FOLDER"});
}

TEST_F(BadSimulation, WrongValueOfAStudyIsFoundBeforeAnythingRuns) {
  input.edit("study.toml", "values = [20, 40]", "values = [20, -40]");
  expect_refusal(run("sweep", "study.toml"), {"study\\.toml:8:[0-9]+", "speed_m_s", "run 3"});
  EXPECT_FALSE(std::filesystem::exists(input.path("out")));
  EXPECT_EQ(run_program({"check", input.path("study.toml")}).status, 2);
}

TEST_F(BadSimulation, FiguresThatCannotBeDrawnAreFoundBeforeAnythingRuns) {
  input.edit("study.toml", "x = \"simulation.speed_m_s\"", "x = \"speed\"");
  expect_refusal(run("sweep", "study.toml"), {"study\\.toml", "force-by-speed\\.svg", "no varied key"});
  input.edit("study.toml", "kind = \"summary\"", "kind = \"patches\"");
  expect_refusal(run("sweep", "study.toml"), {"force-by-speed\\.svg", "contact patches"});
  EXPECT_FALSE(std::filesystem::exists(input.path("out")));
  EXPECT_EQ(run_program({"check", input.path("study.toml")}).status, 2);
}

}  // namespace
}  // namespace treadmark::testing
