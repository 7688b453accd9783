// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "treadmark/core/parts.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class NewFile : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (input.folder() / name).string(); }
  SampleInput input;
};

/// Kinds with the part that they need.
constexpr std::pair<const char*, const char*> kKinds[] = {{"case", nullptr},         {"study", "vehicle"},
                                                          {"vehicle", "vehicle"},    {"track", "vehicle"},
                                                          {"simulation", "vehicle"}, {"import", "scans"}};

TEST_F(NewFile, PassesCheckAndIsNotOverwritten) {
  for (const auto& [kind, part] : kKinds) {
    if (part != nullptr && !has_part(part)) continue;
    SCOPED_TRACE(kind);
    fs::create_directory(path(kind));
    const std::string file = path(std::string(kind) + "/mine.toml");
    const ProgramResult made = run_program({"new", kind, file});
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr(file));
    const ProgramResult checked = run_program({"check", file});
    EXPECT_EQ(checked.status, 0) << checked.err;
    EXPECT_THAT(checked.out, HasSubstr("no errors"));
    const std::string text = input.read(std::string(kind) + "/mine.toml");
    EXPECT_THAT(text, HasSubstr("mine.toml"));
    EXPECT_THAT(text, ::testing::Not(HasSubstr("FILE")));
    const ProgramResult again = run_program({"new", kind, file});
    EXPECT_EQ(again.status, 2);
    EXPECT_THAT(again.err, HasSubstr("is there already"));
    EXPECT_EQ(input.read(std::string(kind) + "/mine.toml"), text);
  }
}

TEST_F(NewFile, CommentsAreThoseOfTheSchema) {
  ASSERT_EQ(run_program({"new", "case", path("case.toml")}).status, 0);
  const std::string text = input.read("case.toml");
  EXPECT_THAT(text, HasSubstr("# lateral position\n"));
  EXPECT_THAT(text, HasSubstr("# yaw_deg = 0                      # yaw angle\n"));
  EXPECT_THAT(text, HasSubstr("(free, nominal)"));
}

TEST_F(NewFile, WhatAFileNamesIsWrittenBesideItUnlessItIsThere) {
  if (!has_part("vehicle")) GTEST_SKIP() << "simulations are left out of this build";
  ASSERT_EQ(run_program({"new", "vehicle", path("vehicle.toml")}).status, 0);
  const auto before = fs::last_write_time(path("vehicle.toml"));
  const ProgramResult made = run_program({"new", "simulation", path("simulation.toml")});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_TRUE(fs::exists(path("track.toml")));
  EXPECT_EQ(fs::last_write_time(path("vehicle.toml")), before);
  EXPECT_EQ(run_program({"new", "simulation", path("track.toml")}).status, 2);
}

TEST_F(NewFile, ACaseRunsAsItIs) {
  ASSERT_EQ(run_program({"new", "case", path("case.toml")}).status, 0);
  const ProgramResult r = run_program({"run", path("case.toml")});
  EXPECT_EQ(r.status, 0) << r.out << r.err;
}

TEST_F(NewFile, AFreelyRollingWheelHasNoLongitudinalForce) {
  ASSERT_EQ(run_program({"new", "case", path("case.toml")}).status, 0);
  const auto rates = [&](const std::string& rolling) {
    const ProgramResult r = run_program(
        {"run", path("case.toml"), "--json", "-", "--set", "wheelset.rolling=" + rolling, "--set", "wheelset.y_mm=3"});
    EXPECT_EQ(r.status, 0) << r.err;
    const auto first = nlohmann::json::parse(r.out).at("cases").at(0);
    return std::pair(first.at("wheelset_velocity").at("vpitch_rad_s").get<double>(),
                     first.at("force_on_rail").at("fx_tr_N").get<double>());
  };
  const auto [free_rate, free_force] = rates("free");
  const auto [nominal_rate, nominal_force] = rates("nominal");
  constexpr double kNominal = -100.0 / 3.6 / 0.46;
  EXPECT_NEAR(nominal_rate, kNominal, 1e-9);  // twelve digits in the file
  EXPECT_NEAR(free_rate, kNominal, 0.01 * -kNominal);
  EXPECT_NE(free_rate, kNominal);
  // At y = 3 mm the wheel runs on a larger radius than the nominal one, and is dragged.
  EXPECT_GT(std::abs(nominal_force), 1e3);
  EXPECT_LT(std::abs(free_force), 1e-3 * std::abs(nominal_force));
}

TEST_F(NewFile, OtherWordsAreRefused) {
  EXPECT_EQ(run_program({"new", "wish"}).status, 2);
  EXPECT_THAT(run_program({"new", "case", path("case.txt")}).err, HasSubstr("does not end with .toml"));
  EXPECT_EQ(run_program({"new", "case", path("no.inp")}).status, 2);
}

}  // namespace
}  // namespace treadmark::testing
