// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/stability/stability_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using treadmark::testing::ProgramResult;
using treadmark::testing::run_program;
using treadmark::testing::TemporaryFolder;

const std::string kFlat = TREADMARK_SOURCE_DIR "/examples/flat-at-speed.toml";

ProgramResult stability_of(std::vector<std::string> more) {
  std::vector<std::string> arguments{"stability", kFlat};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(arguments);
}

/// One wheelset on tables: `simulate --modes` linearises the same vehicle at one speed by itself.
TEST(StabilityCommand, ItsLeastDampedVibrationIsThatOfModesAndFilesAgree) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const std::vector<std::string> one{"--set", "simulation.vehicle=vehicles/single-wheelset.toml", "--set",
                                     "simulation.wheels=[]"};
  std::vector<std::string> arguments{"--from", "20", "--to", "40", "--count", "3", "-o", out};
  arguments.insert(arguments.end(), one.begin(), one.end());
  const ProgramResult r = stability_of(arguments);
  ASSERT_EQ(r.status, 0) << r.err;
  const auto json = nlohmann::json::parse(io::read_text(out + "/stability.json"));
  EXPECT_THAT(r.out, HasSubstr(json.at("message").get<std::string>()));
  EXPECT_THAT(io::read_text(out + "/eigenvalues.csv"), StartsWith("speed_m_s,branch,real_1_per_s"));
  EXPECT_THAT(io::read_text(out + "/stability.svg"), AllOf(HasSubstr("damping ratio"), HasSubstr("</svg>")));
  ASSERT_EQ(json.at("speeds").size(), 3u);
  EXPECT_EQ(json.at("speeds")[1].at("speed_m_s"), 30.0);

  std::vector<std::string> modes{"simulate", kFlat, "--modes", "--json", "-", "--set", "simulation.speed_m_s=30"};
  modes.insert(modes.end(), one.begin(), one.end());
  const ProgramResult simulated = run_program(modes);
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  double least = 1.0;
  const auto all = nlohmann::json::parse(simulated.out);
  for (const auto& mode : all.at("modes")) least = std::min(least, mode.at("damping_ratio").get<double>());
  EXPECT_NEAR(json.at("speeds")[1].at("least_damped").at("damping_ratio").get<double>(), least, 1e-9);
}

TEST(StabilityCommand, RefusesWhatItCannotDo) {
  EXPECT_EQ(stability_of({"--from", "50", "--to", "20"}).status, 2);
  EXPECT_EQ(stability_of({"--count", "1"}).status, 2);
  const ProgramResult full = stability_of({});
  EXPECT_EQ(full.status, 2);
  EXPECT_THAT(full.err, AllOf(HasSubstr("ws1_right has full contact"), HasSubstr("simulation.wheels=[]")));
  const ProgramResult slippery = stability_of(
      {"--set", "simulation.wheels=[]", "--set", "friction.along_track=[{ s_mm = 0, coefficient = 0.3 }]"});
  EXPECT_EQ(slippery.status, 2);
  EXPECT_THAT(slippery.err, HasSubstr("friction varies along the track"));
  EXPECT_THAT(stability_of({"--json", kFlat}).err, HasSubstr("would overwrite"));
}

}  // namespace
}  // namespace treadmark::app
