// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/core/parts.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"

// Bad input gets one clear message that says where, the right exit status, and no result file.

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class BadInput : public ::testing::Test {
 protected:
  void expect_refused(int status, const std::vector<std::string>& words) {
    const auto json = input.folder() / "result.json", folder = input.folder() / "results";
    const ProgramResult r = run_program({"run", input.inp().string(), "--json", json.string(), "-o", folder.string()});
    EXPECT_EQ(r.status, status) << r.err;
    for (const auto& word : words) EXPECT_THAT(r.err, HasSubstr(word));
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << "one message: " << r.err;
    EXPECT_TRUE(r.out.empty()) << r.out;
    EXPECT_FALSE(std::filesystem::exists(json));
    EXPECT_FALSE(std::filesystem::exists(folder / "result.json"));
  }
  SampleInput input;
};

TEST_F(BadInput, TheSampleItselfIsFine) {
  const ProgramResult r = run_program({"run", input.inp().string()});
  EXPECT_EQ(r.status, 0) << r.err;
}

TEST_F(BadInput, MissingCaseFile) {
  const ProgramResult r = run_program({"run", (input.folder() / "nothing.inp").string()});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("nothing.inp"));
}

TEST_F(BadInput, MissingProfile) {
  input.edit("case.inp", "wheel.txt", "absent.txt");
  expect_refused(3, {"absent.txt", "case.inp:14"});
}

TEST_F(BadInput, StandardProfilesThatThereAreNot) {
  for (const auto& [name, said] :
       {std::pair{"61E1", "there is no standard profile '61E1'"},
        std::pair{"S1002", "the standard profile S1002 belongs to a wheel, not to a rail"}}) {
    input.write("case.toml",
                "wheelset = { nominal_radius_mm = 460, vertical_force_N = 1e5 }\n[rail]\nshape.standard = \"" +
                    std::string(name) + "\"\n[wheel]\nshape.standard = \"S1002\"\n");
    const ProgramResult r = run_program({"run", (input.folder() / "case.toml").string()});
    EXPECT_EQ(r.status, 2);
    EXPECT_THAT(r.err, HasSubstr("case.toml:3:18"));
    EXPECT_THAT(r.err, HasSubstr(said));
  }
}

TEST_F(BadInput, MissingSliceFile) {
  input.use_slices();
  std::filesystem::remove(input.folder() / "slice_3.txt");
  expect_refused(3, {"slice_3.txt", "wheel.slcw:8"});
}

TEST_F(BadInput, SlicesOutOfOrder) {
  input.use_slices();
  input.edit("wheel.slcw", "\n0.200000 ", "\n0.050000 ");
  expect_refused(3, {"wheel.slcw:11"});
}

TEST_F(BadInput, TruncatedProfile) {
  const std::string rail = input.read("rail.prr");
  input.write("rail.prr", rail.substr(0, rail.size() / 2));
  expect_refused(3, {"rail.prr"});
}

TEST_F(BadInput, NotANumberInAProfileIsLeftOutWithANote) {
  input.edit("wheel.txt", "\n10 -0.5\n", "\n10 nan\n");
  const ProgramResult r = run_program({"run", input.inp().string()});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("1 point without a value was left out (line 101)"));
}

TEST_F(BadInput, ProfileInMetres) {
  input.edit("case.inp", "'wheel.txt'   0   1.0", "'wheel.txt'   0   0.001");
  expect_refused(3, {"wheel.txt", "metres"});
}

TEST_F(BadInput, UnsupportedDigit) {
  input.edit("case.inp", "1203100", "1203200");
  expect_refused(2, {"case.inp:3"});
}

TEST_F(BadInput, ElementsTooSmallForMemoryAreEnlargedAndSaidToBe) {
  input.edit("case.inp", "  0.500   0.500   1.000", "  1e-9   1e-9   1.000");
  const ProgramResult r = run_program({"run", input.inp().string()});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("enlarged"));
}

TEST_F(BadInput, SearchTooFineForMemory) {
  input.use_slices();  // an out-of-round wheel is searched on a grid that follows dx, ds
  input.edit("case.inp", "  0.500   0.500   1.000", "  1e-9   1e-9   1.000");
  expect_refused(2, {"dx"});
}

TEST_F(BadInput, PotentialContactTooLarge) {
  input.write("case.inp", R"( 3  MODULE
  200100     P-B-T-N-F-S
  022020     L-D-C-M-Z-E
 0000331   H-G-I-A-O-W-R
   100   100    30     1   0.0001
  9.1954      0.000        0.000       0.000
  0.400       0.400
  0.420       0.420          200.        200.
    1
   1000000 1000000 -1.0 -1.0 0.001 0.001
    1    1
  0.0100    0.000     0.0100    0.000     0.000     0.000
 0 MODULE
)");
  expect_refused(2, {"too large"});
}

TEST_F(BadInput, UnknownKeyInACaseFile) {
  input.write("case.toml", "title = 'x'\nwheell = 3\n");
  const ProgramResult r = run_program({"run", (input.folder() / "case.toml").string()});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("case.toml:2:1"));
  EXPECT_THAT(r.err, HasSubstr("wheell"));
}

TEST_F(BadInput, WheelOffTheRailIsAStatusNotAnError) {
  input.edit("case.inp", "  0.0  0.0  60000.", "  0.0  300.0  60000.");
  const auto json = input.folder() / "result.json";
  const ProgramResult r = run_program({"run", input.inp().string(), "--json", json.string()});
  EXPECT_EQ(r.status, 1) << "no contact under a prescribed load is a doubt: " << r.err;
  EXPECT_THAT(input.read("result.json"), HasSubstr("\"no_contact\""));
  EXPECT_THAT(input.read("result.json"), HasSubstr("\"no_contact_under_load\""));
}

TEST_F(BadInput, OutputFolderThatCannotBeMade) {
  const ProgramResult r = run_program({"run", input.inp().string(), "-o", "/dev/null/results"});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("/dev/null/results"));
}

TEST_F(BadInput, WhatHasNoEndIsNotRead) {
  std::vector<std::vector<std::string>> commands{{"run", "@.toml"}, {"check", "@.toml"}, {"check", "@"}};
  const std::string out = (input.folder() / "out").string();
  for (const char* name : {"@", "@.toml"}) {
    commands.insert(commands.end(), {{"convert", name, out + ".csv"},
                                     {"trace", name, "--body", "rail", "--section-mm", "0"},
                                     {"measure", "wheel", name},
                                     {"geometry", "--wheel", name, "--rail", "60E1", "--cant", "1:40"},
                                     {"geometry", name},
                                     {"compare", name},
                                     {"bench", name},
                                     {"diff", name, name}});
    if (has_part("vehicle"))
      for (const char* verb : {"simulate", "evolve", "stability", "response", "track", "sweep", "table"})
        commands.push_back({verb, name, "-o", out});
    if (has_part("nlopt")) commands.push_back({"design", name, "-o", out});
    if (has_part("vehicle")) commands.push_back({"assess", name});
    if (has_part("scans")) commands.push_back({"scan", name, "-o", out + ".xyz", "--body", "rail"});
    if (has_part("scans")) commands.push_back({"import", name, "-o", out + ".slcs", "--body", "rail"});
    if (has_part("fmu")) commands.push_back({"fmu", name, "-o", out + ".fmu"});
    if (has_part("report")) commands.push_back({"report", name, "-o", out + ".html"});
    if (has_part("report")) commands.push_back({"plot", name, "-o", out + ".svg"});
  }
  if (has_part("scans")) commands.push_back({"import", "a.ply", "--settings", "@"});
  for (const char* device : {"/dev/zero", "/dev/full"}) {
    if (!std::filesystem::is_character_file(device)) GTEST_SKIP() << "no " << device;
    std::filesystem::remove(input.folder() / "x.toml");
    std::filesystem::create_symlink(device, input.folder() / "x.toml");
    for (std::vector<std::string> words : commands) {
      for (std::string& word : words)
        if (word == "@" || word == "@.toml") word = word == "@" ? device : (input.folder() / "x.toml").string();
      const ProgramResult r = run_program(words);
      EXPECT_TRUE(r.status == 2 || r.status == 3) << words[0] << ' ' << words[1] << r.err;
      EXPECT_THAT(r.err, Not(HasSubstr("memory"))) << words[0];
    }
  }
}

}  // namespace
}  // namespace treadmark::testing
