// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/core/parts.hpp"
#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/faults/file_tree.hpp"
#include "treadmark/tests/faults/output_rows.hpp"

namespace treadmark::testing {
namespace {

/// Runs the program with its standard output redirected as the shell says.
ProgramResult redirected(const std::string& how, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"sh", "-c", "exec \"$@\" " + how, "sh", "treadmark", "--quiet", "--threads", "1"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return RunningProgram(command).wait();
}

const std::vector<OutputRow> kPrinting{
    {"run", "", "", "run $case.toml", nullptr, 0},
    {"run_json", "", "", "run $case.toml --json -", nullptr, 0},
    {"compare", "", "", "compare $case.toml --resolutions 8 --bodies rail --backends spline", nullptr, 0},
    {"diff", "hdf5", "run $case.toml -o $first", "diff $first $first", nullptr, 0},
    {"bench", "", "", "bench $case.toml --resolutions 4 --backends spline --seconds-per-measure 0.001", nullptr, 0},
    {"conform", "", "", "conform $case.toml", nullptr, 0},
    {"convert", "", "", "convert $rail.prr @rail.prr", nullptr, 0},
    {"scan", "scans", "", "scan $rail.prr -o @scan.xyz --range-mm -20 20 --points 300", nullptr, 0},
    {"import_settings", "scans", "", "import --list-settings", nullptr, 0},
    {"report", "report hdf5", "run $case.toml -o $first", "report $first -o @report.html", nullptr, 0},
    {"plot", "report hdf5", "run $case.toml -o $first", "plot $first --what pressure -o -", nullptr, 0},
    {"check", "", "", "check $case.toml", nullptr, 0},
    {"simulate", "vehicle hdf5", "", "simulate $short.toml -o @simulation", nullptr, 0},
    {"assess", "vehicle hdf5", "simulate $simulation.toml -o $simulated", "assess $simulated", nullptr, 0},
    {"sweep", "vehicle hdf5", "", "sweep $short-study.toml -o @sweep", nullptr, 0},
    {"stability", "vehicle", "",
     "stability " TREADMARK_SOURCE_DIR "/examples/flat-at-speed.toml --from 20 --to 30 --count 2 --set "
     "simulation.wheels=[] --set simulation.vehicle=vehicles/single-wheelset.toml",
     nullptr, 0},
    {"response", "vehicle", "",
     "response " TREADMARK_SOURCE_DIR "/examples/flat-at-speed.toml --count 2 --set simulation.wheels=[] --set "
     "simulation.vehicle=vehicles/single-wheelset.toml",
     nullptr, 0},
    {"track", "vehicle", "", "track " TREADMARK_SOURCE_DIR "/examples/tracks/gm-tt0088.toml --count 20", nullptr, 0},
    {"list", "", "", "list verbs", nullptr, 0},
    {"schema", "", "", "schema", nullptr, 0},
    {"completion", "", "", "completion bash", nullptr, 0},
    {"man", "", "", "man run", nullptr, 0},
    {"help", "", "", "--help", nullptr, 0},
    {"version", "", "", "--version", nullptr, 0},
};

class StandardOutput : public ::testing::TestWithParam<OutputRow> {};

TEST_P(StandardOutput, WhatCannotBePrintedIsSaid) {
  const OutputRow& row = GetParam();
  TREADMARK_NEEDS_PARTS_OF(row);
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const OutputScene scene;
  scene.prepare(row);
  ASSERT_EQ(redirected("> /dev/null", scene.words(row.command)).status, 0);
  restore(scene.out(), {});
  const ProgramResult full = redirected("> /dev/full", scene.words(row.command));
  EXPECT_GE(full.status, 1);
  EXPECT_LE(full.status, 4);
  EXPECT_NE(full.err, "");
}

INSTANTIATE_TEST_SUITE_P(Rows, StandardOutput, ::testing::ValuesIn(kPrinting),
                         [](const auto& which) { return std::string(which.param.name); });

/// The first file that a program opens gets the number of a standard output that is closed.
class ClosedOutput : public ::testing::TestWithParam<OutputRow> {};

TEST_P(ClosedOutput, NothingIsPrintedIntoFiles) {
  const OutputRow& row = GetParam();
  TREADMARK_NEEDS_PARTS_OF(row);
  const OutputScene scene;
  scene.prepare(row);
  ASSERT_EQ(redirected("> /dev/null", scene.words(row.command)).status, 0);
  const FileTree expected = tree_of(scene.out());
  for (const char* how : {">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
    restore(scene.out(), {});
    const ProgramResult end = redirected(how, scene.words(row.command));
    EXPECT_GE(end.status, 0) << how;
    EXPECT_LE(end.status, 4) << how;
    const FileTree found = tree_of(scene.out());
    if (end.status == 0) {
      EXPECT_EQ(found.size(), expected.size()) << how;
    }
    // times in the files differ, so only what is printed would make them longer
    for (const auto& [path, content] : found) {
      const auto same = expected.find(path);
      ASSERT_NE(same, expected.end()) << how << ": " << path;
      if (path.ends_with(".svg")) {
        // A diagram of times may have any number of lines: what is printed would stand before it or behind it.
        EXPECT_EQ(content.substr(0, 5), same->second.substr(0, 5)) << how << ": " << path;
        EXPECT_TRUE(content.ends_with("</svg>\n")) << how << ": " << path;
        continue;
      }
      const auto length = static_cast<double>(same->second.size());
      const double times = std::max(64.0, 0.03 * length);  // [bytes]
      EXPECT_NEAR(static_cast<double>(content.size()), length, times) << how << ": " << path;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, ClosedOutput, ::testing::ValuesIn(output_rows()),
                         [](const auto& which) { return std::string(which.param.name); });

}  // namespace
}  // namespace treadmark::testing
