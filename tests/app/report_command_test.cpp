// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

TEST(ReportCommand, OfAFolderEqualsThatOfTheRun) {
  const SampleInput input;
  const std::string folder = (input.folder() / "out").string();
  const ProgramResult run =
      run_program({"run", input.inp().string(), "-o", folder, "--report", folder + "/at-once.html"});
  ASSERT_EQ(run.status, 0) << run.err;
  const ProgramResult later = run_program({"report", folder});
  ASSERT_EQ(later.status, 0) << later.err;
  EXPECT_EQ(later.out, folder + "/report.html\n");
  EXPECT_EQ(input.read("out/report.html"), input.read("out/at-once.html"));
  EXPECT_EQ(run_program({"report", folder + "/result.json", "-o", folder + "/of-a-file.html"}).status, 0);
  EXPECT_EQ(input.read("out/of-a-file.html"), input.read("out/at-once.html"));
  const ProgramResult fixed = run_program({"report", folder, "--static", "-o", folder + "/static.html"});
  ASSERT_EQ(fixed.status, 0) << fixed.err;
  EXPECT_THAT(input.read("out/static.html"), Not(HasSubstr("<script")));
  EXPECT_THAT(input.read("out/static.html"), HasSubstr("data:image/svg+xml"));
}

TEST(ReportCommand, ReportsNeedNoFolder) {
  const SampleInput input;
  const std::string html = (input.folder() / "alone.html").string();
  ASSERT_EQ(run_program({"run", input.inp().string(), "--report", html}).status, 0);
  EXPECT_THAT(input.read("alone.html"), HasSubstr("<!doctype html>"));
}

TEST(ReportCommand, BadInputIsNamed) {
  const SampleInput input;
  const std::string folder = input.folder().string();
  const ProgramResult missing = run_program({"report", folder + "/nowhere"});
  EXPECT_EQ(missing.status, 3);
  EXPECT_THAT(missing.err, HasSubstr("nowhere"));
  const ProgramResult empty = run_program({"report", folder});
  EXPECT_EQ(empty.status, 3);
  EXPECT_THAT(empty.err, HasSubstr("holds no results"));
  input.write("fields.h5", "this is no HDF5 file");
  EXPECT_EQ(run_program({"report", folder}).status, 3);
  const ProgramResult several =
      run_program({"run", input.inp().string(), input.inp().string(), "--report", folder + "/x.html"});
  EXPECT_EQ(several.status, 2);
  EXPECT_THAT(several.err, HasSubstr("one case file"));
}

TEST(PlotCommand, ListsAndDraws) {
  const SampleInput input;
  const std::string folder = (input.folder() / "out").string();
  ASSERT_EQ(run_program({"run", input.inp().string(), "-o", folder}).status, 0);
  const ProgramResult list = run_program({"plot", folder});
  EXPECT_EQ(list.status, 0) << list.err;
  for (const char* name : {"pressure", "traction", "section", "forces"}) EXPECT_THAT(list.out, HasSubstr(name));
  for (const char* name : {"pressure", "traction_x", "state", "gap", "section", "forces"}) {
    const ProgramResult drawn = run_program({"plot", folder, "--what", name, "-o", "-"});
    EXPECT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_THAT(drawn.out, ::testing::StartsWith("<svg")) << name;
    EXPECT_THAT(drawn.out, ::testing::EndsWith("</svg>\n")) << name;
  }
  ASSERT_EQ(run_program({"plot", folder, "--what", "pressure", "--case", "1", "-o", folder + "/p.svg"}).status, 0);
  EXPECT_THAT(input.read("out/p.svg"), HasSubstr("case 1"));
  ASSERT_EQ(run_program({"plot", folder, "--what", "section", "--case", "1", "-o", folder + "/s.svg"}).status, 0);
  EXPECT_THAT(input.read("out/s.svg"), HasSubstr(", case 1"));
  EXPECT_THAT(run_program({"plot", folder, "--what", "section", "--case", "7", "-o", "-"}).err,
              HasSubstr("there is no case 7"));
  EXPECT_EQ(run_program({"plot", folder, "--what", "pressure"}).status, 2);
  const ProgramResult wrong = run_program({"plot", folder, "--what", "beauty", "-o", "-"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("pressure"));
}

}  // namespace
}  // namespace treadmark::testing
