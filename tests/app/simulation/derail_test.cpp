// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// A wheel that climbs its rail, from the program's side.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"
#include "treadmark/tests/io/simulations/samples.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A light vehicle that runs much too fast into a curve of 12 m, which no flange leads it through.
class Derail : public ::testing::Test {
 protected:
  Derail() {
    input.write("simulation.toml", R"(title = "too fast"

[simulation]
vehicle = "vehicle.toml"
track = "track.toml"
speed_m_s = 60
distance_m = 8

[layout]
[[layout.elements]]
kind = "straight"
length_m = 0.2
[[layout.elements]]
kind = "transition"
length_m = 0.1
[[layout.elements]]
kind = "curve"
length_m = 20
radius_m = 12

[case]

[wheel]
shape.standard = "S1002"

[rail]
shape.standard = "60E1"

[track]
cant = "1:40"
)");
    input.write("study.toml", R"([study]
title = "Fast and slow"
base = "simulation.toml"

[[study.vary]]
key = "simulation.speed_m_s"
values = [5, 60]
)");
  }
  ProgramResult run(std::vector<std::string> words) const {
    words.insert(words.begin(), "treadmark");
    return RunningProgram(words).wait();
  }
  ProgramResult simulate(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"simulate", input.path("simulation.toml"), "-o", input.path("out")};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  SampleSimulation input;
};

TEST_F(Derail, ARunThatDerailsEndsWithWhatThereIs) {
  const ProgramResult r = simulate();
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.out, HasSubstr("derailed, ws1_left: the flange has climbed the rail"));
  EXPECT_THAT(r.err, HasSubstr("warning: derailed: ws1_left"));
  const std::string history = input.read("out/history.csv");
  EXPECT_THAT(history, HasSubstr("lift_m"));
  EXPECT_TRUE(std::filesystem::exists(input.path("out/simulation.h5")));
  EXPECT_FALSE(std::filesystem::exists(input.path("out/unfinished.h5"))) << "there is nothing to go on with";

  // It has ended: to resume it changes nothing, and does not hide it.
  const ProgramResult again = simulate({"--resume"});
  EXPECT_EQ(again.status, 1);
  EXPECT_THAT(again.err, HasSubstr("has ended already"));
  EXPECT_THAT(again.err, HasSubstr("warning: derailed: ws1_left"));
  EXPECT_EQ(input.read("out/history.csv"), history);

  const ProgramResult told = simulate({"--anew", "--json", "-"});
  EXPECT_EQ(told.status, 1);
  EXPECT_THAT(told.out, HasSubstr("\"status\": \"derailed\""));
  EXPECT_EQ(input.read("out/history.csv"), history);
}

TEST_F(Derail, SlowlyItRunsThrough) {
  const ProgramResult r = simulate({"--set", "simulation.speed_m_s=5"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out + r.err, Not(HasSubstr("derailed")));
}

TEST_F(Derail, ASweepNamesTheRunsThatDerail) {
  const std::vector<std::string> sweep{"sweep", input.path("study.toml"), "-o", input.path("swept")};
  const ProgramResult r = run(sweep);
  EXPECT_EQ(r.status, 1) << r.err;
  const std::string table = input.read("swept/sweep.csv");
  EXPECT_THAT(table, HasSubstr("complete"));
  EXPECT_THAT(table, HasSubstr("derailed"));
  EXPECT_THAT(table, Not(HasSubstr("failed")));
  std::vector<std::string> resume = sweep;
  resume.emplace_back("--resume");
  const ProgramResult again = run(resume);
  EXPECT_EQ(again.status, 1) << "a run that derailed stays one";
  EXPECT_THAT(again.err, HasSubstr("2 of 2 runs were finished already"));
  EXPECT_EQ(input.read("swept/sweep.csv"), table);
}

}  // namespace
}  // namespace treadmark::testing
