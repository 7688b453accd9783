// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <random>
#include <span>
#include <string>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/cases/contact_program/read_inp.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/support/mutation.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

io::RunResult solved(const fs::path& file) { return app::run_cases(io::read_any_case(file)); }

/// tolerance: relative, where the last bit of an input may differ.
void expect_same_results(const io::RunResult& a, const io::RunResult& b, double tolerance = 0.0) {
  ASSERT_EQ(a.cases.size(), b.cases.size());
  for (std::size_t i = 0; i < a.cases.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(a.cases[i].status, b.cases[i].status);
    ASSERT_EQ(a.cases[i].patches.size(), b.cases[i].patches.size());
    for (std::size_t k = 0; k < a.cases[i].patches.size(); ++k) {
      const io::PatchResult &p = a.cases[i].patches[k], &q = b.cases[i].patches[k];
      for (double io::PatchResult::*number :
           {&io::PatchResult::fn, &io::PatchResult::fx, &io::PatchResult::fs, &io::PatchResult::pmax,
            &io::PatchResult::approach, &io::PatchResult::xi, &io::PatchResult::eta, &io::PatchResult::phi})
        EXPECT_NEAR(p.*number, q.*number, tolerance * std::abs(p.*number));
    }
  }
}

TEST(ConvertedCases, InputOfContactRunsToTheSameNumbers) {
  SampleInput input;
  const fs::path toml = input.folder() / "written" / "case.toml", inp = input.folder() / "again.inp";
  const ProgramResult first = run_program({"convert", input.inp().string(), "-o", toml.string()});
  ASSERT_EQ(first.status, 0) << first.err;
  ASSERT_EQ(run_program({"convert", toml.string(), inp.string()}).status, 0);
  const io::RunResult expected = solved(input.inp());
  ASSERT_FALSE(expected.cases.at(0).patches.empty());
  expect_same_results(expected, solved(toml));
  expect_same_results(expected, solved(inp));
}

/// Not every number of one unit has one of the other that gives it to the last bit, and iterations may end a step
/// apart.
constexpr double kLastBit = 1e-5;

TEST(ConvertedCases, InputsWithOtherNumbersRunAsTheirTwins) {
  constexpr int kUsual = 60;
  constexpr std::size_t kMostCases = 3;
  const SampleInput input;
  const std::string valid = input.read("case.inp");
  std::mt19937 random(20261123);
  int compared = 0;
  const int trials = mutants(kUsual);
  for (int trial = 0; trial < trials && !::testing::Test::HasFailure(); ++trial) {
    const std::string text = with_other_numbers(valid, random);
    SCOPED_TRACE(text);
    io::CaseFile file, twin;
    try {
      file = io::parse_contact_input(text, input.folder() / "case.inp");
      twin = io::parse_case_text(io::case_file_text(file, input.folder()), input.folder() / "twin.toml");
    } catch (const Error&) {
      continue;  // not readable, or not to be said in the other format
    }
    if (file.cases.size() > kMostCases) continue;
    const auto solved_or_refused = [](const io::CaseFile& cases) -> std::optional<io::RunResult> {
      try {
        return app::run_cases(cases);
      } catch (const Error&) {
        return std::nullopt;
      }
    };
    const auto first = solved_or_refused(file), second = solved_or_refused(twin);
    ASSERT_EQ(first.has_value(), second.has_value());
    if (!first) continue;
    expect_same_results(*first, *second, kLastBit);
    ++compared;
  }
  EXPECT_GT(4 * compared, trials);
}

TEST(ConvertedCases, ACaseFileRunsToTheSameNumbersAsInputOfContact) {
  SampleInput input;
  input.write("case.toml", R"(
[rail]
shape.file = "rail.prr"
[wheel]
shape.file = "wheel.txt"
shape.mirror_z = "no"
[track]
rail_y_mm = 750
rail_z_mm = 0
cant_rad = 0.025
[wheelset]
vertical_force_N = 9e4
velocity_m_s = 20
vpitch_rad_s = -43.5
[discretisation]
dx_mm = 0.7
ds_mm = 0.7
)");
  const fs::path toml = input.folder() / "case.toml", inp = input.folder() / "out.inp";
  const ProgramResult r = run_program({"convert", toml.string(), inp.string(), "--set", "friction.coefficient=0.25"});
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string override = "friction.coefficient=0.25";
  expect_same_results(app::run_cases(io::read_any_case(toml, std::span(&override, 1))), solved(inp));
}

TEST(ConvertedCases, APatchRunsToTheSameNumbers) {
  SampleInput input;
  const fs::path inp = input.folder() / "onset.inp";
  const char* example = TREADMARK_SOURCE_DIR "/examples/onset-of-rolling.toml";
  const ProgramResult r = run_program({"convert", example, inp.string()});
  ASSERT_EQ(r.status, 0) << r.err;
  expect_same_results(solved(example), solved(inp));
}

/// What files of points leave out of formulas.
constexpr double kSampled = 0.01;

TEST(ConvertedCases, ShapesByFormulaAndDefectsBecomeFiles) {
  SampleInput input;
  const fs::path toml = input.folder() / "case.toml", inp = input.folder() / "out.inp";
  const std::string plain = standard_case("1.0");
  std::string damaged = plain + "[[rail.squats]]\nx_center_mm = 5\ndepth_mm = 0.2\nlength_mm = 40\nwidth_mm = 30\n";
  damaged.replace(damaged.find("cant ="), 0, "rail_y_mm = 753\n");  // slices have no gauge point
  for (const auto& [text, rail] :
       {std::pair{plain, "out_rail_1.prr: rail profile"}, {damaged, "out_rail_1.slcs: slices"}}) {
    input.write("case.toml", text);
    const ProgramResult r = run_program({"convert", toml.string(), inp.string()});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr(rail));
    EXPECT_THAT(r.out, HasSubstr("out_wheel_2.prw: wheel profile"));
    expect_same_results(solved(toml), solved(inp), kSampled);
  }
}

TEST(ConvertedCases, RefusedOnesLeaveNothing) {
  SampleInput input;
  const fs::path out = input.folder() / "out.inp";
  input.write("case.toml", standard_case("1.0") + "[solver]\ntangential_model = \"linear\"\n");
  const ProgramResult r = run_program({"convert", (input.folder() / "case.toml").string(), out.string()});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("cannot be written as input of CONTACT (.inp)"));
  EXPECT_FALSE(fs::exists(out));
  EXPECT_FALSE(fs::exists(input.folder() / "out_rail_1.prr"));
}

TEST(CaseFiles, NamesThatNobodyHasRegisteredAreRefusedByEveryVerb) {
  SampleInput input;
  input.write("case.toml", standard_case("1.0"));
  const std::string file = (input.folder() / "case.toml").string(), out = (input.folder() / "again.toml").string();
  for (const char* setting : {"wheel.backend=splines", "rail.backend=splines", "discretisation.detector=sight"})
    for (const std::string verb :
         {"run", "check", "compare", "bench", "conform", "convert", "table", "geometry", "measure", "fmu"}) {
      if (verb == "fmu" && !has_part("fmu")) continue;
      std::vector<std::string> words{verb, file, "--set", setting};
      if (verb == "convert") words.insert(words.begin() + 2, out);
      if (verb == "measure") words.insert(words.begin() + 1, "wheel");
      if (verb == "fmu") words.insert(words.end(), {"-o", out});
      const ProgramResult r = run_program(words);
      EXPECT_EQ(r.status, 2) << verb << ' ' << setting;
      EXPECT_THAT(r.err, HasSubstr(std::string(setting).substr(std::string(setting).find('=') + 1))) << verb;
    }
  EXPECT_FALSE(fs::exists(out));
}

/// A ball on a plane that rolls with spin; digit: E.
double lateral_force(int digit) {
  const std::string text = " 3 MODULE\n 203100\n 002202" + std::to_string(digit) +
                           "\n 0000111\n 999 100 30 1 1e-7\n 1000. 0. 0. 1e-6\n 0.3 0.3\n 0. 0.1 1000.\n"
                           " 0.28 0.28 82000. 82000.\n -1\n 40 40 0.001 0.001 1.1\n 0\n";
  const io::RunResult run = app::run_cases(io::parse_contact_input(text, "spin.inp"));
  return run.cases.at(0).patches.at(0).fs;
}

TEST(ConvertedCases, SpinInOneDirectionOnly) {
  // At small spin forces add up (Kalker's linear theory), and nearly all of the lateral one is from slip across.
  const double both = lateral_force(0), lengthwise = lateral_force(2), across = lateral_force(3);
  EXPECT_GT(std::abs(both), 0.0);
  EXPECT_NEAR(lengthwise + across, both, 0.02 * std::abs(both));
  EXPECT_GT(std::abs(across - lengthwise), 0.2 * std::abs(both));
}

}  // namespace
}  // namespace treadmark::testing
