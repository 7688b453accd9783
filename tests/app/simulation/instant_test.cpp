// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
constexpr double kSolver = 1e-5;  // its tolerance: in a simulation it starts from the solution of the instant before

class Instant : public ::testing::Test {
 protected:
  void SetUp() override {
    input.edit("simulation.toml", "\"transient\"", "\"steady\"");
    const ProgramResult r = run_program({"simulate", input.path("simulation.toml"), "-o", input.path("out")});
    ASSERT_EQ(r.status, 0) << r.err;
  }
  ProgramResult convert(std::vector<std::string> options) const {
    options.insert(options.begin(), {"convert", input.path("out/simulation.h5")});
    return run_program(options);
  }
  SampleSimulation input;
};

TEST_F(Instant, RunsToTheNumbersOfTheHistory) {
  const io::SimulationResult history = io::read_simulation(input.path("out/simulation.h5"));
  const auto column = [&](const std::string& name) { return column_values(history, column_index(history, name)); };
  const std::size_t rows = history.rows();
  ASSERT_GT(rows, 4u);
  for (const std::size_t row : {std::size_t{0}, rows / 2, rows - 1}) {
    SCOPED_TRACE(row);
    const ProgramResult r = convert({"-o", input.path("case.toml"), "--at", std::to_string(column("t_s").at(row))});
    ASSERT_EQ(r.status, 0) << r.err;
    const io::RunResult run = app::run_cases(io::read_any_case(input.path("case.toml")));
    ASSERT_FALSE(run.cases.empty());
    for (std::size_t i = 0; i < run.cases.size(); ++i) {
      SCOPED_TRACE(i);
      const std::string prefix = i == 0 ? "" : "ws1_right.";
      const io::CaseResult& c = run.cases[i];
      double pmax = 0.0, fn = 0.0;
      for (const io::PatchResult& p : c.patches) {
        pmax = std::max(pmax, p.pmax);
        fn += p.fn;
      }
      EXPECT_EQ(static_cast<double>(c.patches.size()), column(prefix + "patches").at(row));
      EXPECT_NEAR(pmax, column(prefix + "pmax_Pa").at(row), kSolver * pmax);
      EXPECT_NEAR(fn, column(prefix + "Fn_N").at(row), kSolver * fn);
    }
  }
}

TEST_F(Instant, IsWrittenAsInputOfContact) {
  ASSERT_EQ(convert({"-o", input.path("case.toml"), "--at", "0"}).status, 0);
  ASSERT_EQ(convert({"-o", input.path("instant.inp"), "--at", "0"}).status, 0);
  const io::RunResult one = app::run_cases(io::read_any_case(input.path("case.toml"))),
                      other = app::run_cases(io::read_any_case(input.path("instant.inp")));
  ASSERT_EQ(one.cases.size(), other.cases.size());
  for (std::size_t i = 0; i < one.cases.size(); ++i) {
    ASSERT_EQ(one.cases[i].patches.size(), other.cases[i].patches.size());
    ASSERT_FALSE(one.cases[i].patches.empty());
    for (std::size_t k = 0; k < one.cases[i].patches.size(); ++k) {
      // Shapes by formula are written within 10 um.
      EXPECT_NEAR(other.cases[i].patches[k].pmax, one.cases[i].patches[k].pmax, 1e-2 * one.cases[i].patches[k].pmax);
      EXPECT_NEAR(other.cases[i].patches[k].fn, one.cases[i].patches[k].fn, 1e-3 * one.cases[i].patches[k].fn);
    }
  }
}

/// Simulations take the slip of the surfaces with FASTSIM, which such a file cannot say.
TEST_F(Instant, OfASimplifiedTheoryNeedsAPlaneForContact) {
  input.edit("simulation.toml", "[simulation]", "solver.tangential_model = \"fastsim\"\n[simulation]");
  const ProgramResult r = run_program({"simulate", input.path("simulation.toml"), "-o", input.path("out")});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(convert({"-o", input.path("case.toml"), "--at", "0"}).status, 0);
  const std::vector<std::string> to_inp{"-o", input.path("instant.inp"), "--at", "0"};
  const ProgramResult refused = convert(to_inp);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("contact.reference_surface = \"plane\""));
  std::vector<std::string> plane = to_inp;
  plane.insert(plane.end(), {"--set", "contact.reference_surface=plane"});
  EXPECT_EQ(convert(plane).status, 0);
}

TEST_F(Instant, WhatCannotBeIsRefused) {
  const auto error = [&](std::vector<std::string> options) {
    const ProgramResult r = convert(std::move(options));
    EXPECT_EQ(r.status, 2) << r.out;
    return r.err;
  };
  const std::string toml = input.path("instant.toml");
  EXPECT_THAT(error({"-o", toml}), HasSubstr("--at TIME"));
  EXPECT_THAT(error({"-o", toml, "--at", "99"}), HasSubstr("outside the history"));
  EXPECT_THAT(error({"-o", toml, "--at", "0", "--simulation", input.path("vehicle.toml")}), HasSubstr("vehicle.toml"));
  EXPECT_THAT(error({"-o", toml, "--at", "0", "--set", "case.regime=transient"}), HasSubstr("in transient rolling"));
  input.edit("simulation.toml", "dx_mm = 2", "dx_mm = 2.0");
  EXPECT_THAT(error({"-o", toml, "--at", "0"}), HasSubstr("has changed since"));
  EXPECT_FALSE(std::filesystem::exists(toml));
}

}  // namespace
}  // namespace treadmark::testing
