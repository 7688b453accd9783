// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"

namespace treadmark::testing {
namespace {

namespace fs = std::filesystem;

int lines_of_numbers(const fs::path& file) {
  std::ifstream in(file);
  int count = 0;
  for (std::string line; std::getline(in, line);) count += line.empty() || line.find('%') != std::string::npos ? 0 : 1;
  return count;
}

TEST(WheelRailTables, ElementsAndPointsBelowTheSurface) {
  const SampleInput input;
  input.edit("case.inp", " 1203100    C-P", " 1203103    C-P");
  input.edit("case.inp", " 0001321    H-G", " 0002321    H-G");
  input.edit("case.inp", " 10000. 0.0  0.0    0.0    0.0    -21.73\n",
             " 10000. 0.0  0.0    0.0    0.0    -21.73\n 2 1\n 1\n 2 0.5 1.0\n 9\n 1 1 1\n 0.\n 0.\n 3.\n 0\n");
  const fs::path folder = input.folder() / "out";
  const ProgramResult r = run_program({"run", input.inp().string(), "-o", folder.string()});
  ASSERT_EQ(r.status, 0) << r.err;
  std::ifstream in(folder / "result.json");
  const auto run = nlohmann::json::parse(in);
  const auto& patch = run["cases"][0]["patches"][0];
  const int npot = patch["elements"]["npot"];
  EXPECT_EQ(lines_of_numbers(folder / "case.0001a.mat"), 6 + npot);
  EXPECT_EQ(lines_of_numbers(folder / "case.0001a.subs"), 1 + 2 * npot + 1 + 1);
  EXPECT_EQ(lines_of_numbers(folder / "case.0002a.mat"),
            6 + run["cases"][1]["patches"][0]["elements"]["ncon"].get<int>());
  EXPECT_FALSE(fs::exists(folder / "case.0002a.subs"));
}

TEST(WheelRailTables, WhatCannotBeSolvedIsAnErrorOfItsCase) {
  const SampleInput input;
  input.edit("case.inp", " 1203100    C-P", " 5203100    C-P");
  input.edit("case.inp", "   -1.0   750.0     0.0   0.025\n", "   -1.0   750.0     0.0   0.0\n");
  const ProgramResult r = run_program({"check", input.inp().string()});
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, ::testing::HasSubstr("NOMRAD of a roller must not be 0"));
}

}  // namespace
}  // namespace treadmark::testing
