// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "treadmark/core/parts.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"

namespace treadmark::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A request for a part, and what a build without it calls what it leaves out.
struct Request {
  const char* part;
  const char* what;
  std::vector<std::string> arguments;
};

/// A build that has the part gets as far as to the files, which are none; every other one names option and package.
TEST(LeftOut, RequestsEndAsWrongUsageAndNameTheOption) {
  const std::string nowhere = "/nowhere/x.toml";
  const Request requests[] = {
      {"vehicle", "treadmark simulate", {"simulate", nowhere, "-o", "/nowhere/out", "--modes"}},
      {"vehicle", "treadmark assess", {"assess", "/nowhere/out", "--from", "2"}},
      {"vehicle", "treadmark sweep", {"sweep", nowhere, "--resume", "-o", "/nowhere/out"}},
      {"vehicle", "treadmark evolve", {"evolve", nowhere, "-o", "/nowhere/out"}},
      {"nlopt", "treadmark design", {"design", nowhere, "-o", "/nowhere/out"}},
      {"vehicle", "treadmark stability", {"stability", nowhere, "--to", "50"}},
      {"vehicle", "treadmark response", {"response", nowhere, "--to", "50"}},
      {"vehicle", "treadmark track", {"track", nowhere, "--fit", "2"}},
      {"vehicle", "treadmark table", {"table", nowhere, "-o", "/nowhere/t.h5"}},
      {"vehicle", "the schema of study files", {"schema", "study"}},
      {"scans", "treadmark import", {"import", "/nowhere/x.ply", "--unit", "mm"}},
      {"scans", "treadmark scan", {"scan", nowhere, "-o", "/nowhere/x.ply"}},
      {"scans", "the schema of import settings", {"schema", "import"}},
      {"scans", "the schema of import reports", {"schema", "import-report"}},
      {"report", "treadmark report", {"report", "/nowhere/x", "--static"}},
      {"report", "treadmark plot", {"plot", "/nowhere/x", "--what", "pressure"}},
      {"report_scripts", "treadmark live", {"live", nowhere, "--no-open"}},
      {"report", "--report", {"run", nowhere, "--report", "/nowhere/x.html"}},
      {"report", "--report", {"compare", nowhere, "--report", "/nowhere/x.html"}},
  };
  for (const Request& request : requests) {
    SCOPED_TRACE(request.what);
    const ProgramResult r = run_program(request.arguments);
    if (has_part(request.part)) {
      EXPECT_THAT(r.err, Not(HasSubstr("leaves out")));
      EXPECT_EQ(r.status == 0, request.arguments.front() == "schema") << r.err;
      continue;
    }
    EXPECT_EQ(r.status, 2);
    EXPECT_EQ(r.out, "");
    EXPECT_THAT(r.err, AllOf(HasSubstr(left_out_message(request.part, request.what)),
                             HasSubstr(left_out_advice(request.part))));
  }
}

TEST(LeftOut, BackendsAreRefusedByName) {
  const SampleInput input;
  const bool there = has_part("openvdb");
  const ProgramResult list = run_program({"list", "backends"}),
                      r = run_program(
                          {"run", input.inp().string(), "--rail-backend", "level-set", "--resolution", "2"});
  EXPECT_THAT(list.out, HasSubstr("\nmesh-flat\n"));  // whether there is Embree or not
  EXPECT_THAT(list.out,
              HasSubstr(there ? "\nlevel-set\n" : "level-set - left out of this build: " + left_out_advice("openvdb")));
  EXPECT_EQ(r.err.find("leaves out") == std::string::npos, there) << r.err;
  if (there) return;
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, AllOf(HasSubstr(left_out_message("openvdb", "the backend 'level-set'")),
                           HasSubstr(left_out_advice("openvdb"))));
}

/// Parts that packages of their own bring: what is built need not be installed.
TEST(LeftOut, ModulesThatAreNotInstalledAreNamed) {
  const SampleInput input;
  const std::string inp = input.inp().string(), step = TREADMARK_SOURCE_DIR "/tests/io/cad/data/rail.step";
  setenv("TREADMARK_MODULES", "/nowhere", 1);
  for (const auto& [part, arguments] :
       {std::pair{"openvdb", std::vector<std::string>{"run", inp, "--rail-backend", "level-set", "--resolution", "2"}},
        std::pair{"cad", std::vector<std::string>{"check", step}}}) {
    if (!has_part(part)) continue;
    const ProgramResult r = run_program(arguments);
    EXPECT_EQ(r.status, 2) << part;
    EXPECT_THAT(r.err, HasSubstr(std::string("install the Debian package treadmark-") + part));
  }
  unsetenv("TREADMARK_MODULES");
}

/// A program called by its name alone knows no more of its place than that.
TEST(LeftOut, ModulesAreNotTakenFromTheWorkingDirectory) {
  if (!has_part("cad")) GTEST_SKIP();
  namespace fs = std::filesystem;
  const SampleInput input;
  const fs::path folder = input.inp().parent_path(), trap = folder / "treadmark" / "treadmark-opencascade";
  fs::create_directory(folder / "bin");
  fs::create_directory(folder / "treadmark");
  fs::copy_file(TREADMARK_PROGRAM, folder / "bin" / "treadmark");
  std::ofstream(trap) << "#!/bin/sh\ntouch '" << folder.string() << "/taken'\n";
  fs::permissions(trap, fs::perms::owner_all);
  const std::string call = "cd '" + folder.string() + "' && PATH=\"$PWD/bin:$PATH\" treadmark check " +
                           TREADMARK_SOURCE_DIR "/tests/io/cad/data/rail.step >out 2>&1";
  EXPECT_EQ(std::system(call.c_str()), 0);
  EXPECT_FALSE(fs::exists(folder / "taken"));
}

TEST(LeftOut, SimulationsAreCheckedOrRefused) {
  const ProgramResult r = run_program({"check", TREADMARK_SOURCE_DIR "/examples/flat-at-speed.toml"});
  EXPECT_EQ(r.status, has_part("vehicle") ? 0 : 2) << r.err;
  if (!has_part("vehicle")) {
    EXPECT_THAT(r.err, HasSubstr(left_out_advice("vehicle")));
  }
}

TEST(LeftOut, VersionNamesWhatIsInAndWhatIsNot) {
  const std::string text = run_program({"--version"}).out;
  const std::size_t cut = text.find("left out: ");
  for (const Part& part : parts()) {
    const std::size_t place = text.find(part.name);
    ASSERT_NE(place, std::string::npos) << part.name;
    EXPECT_EQ(place < cut, part.built) << part.name;
  }
}

/// Loops are shared among threads with and without oneTBB.
TEST(LeftOut, ThreadsChangeNoResult) {
  const SampleInput input;
  const auto results = [&](const char* threads) {
    const ProgramResult r = run_program({"run", input.inp().string(), "--quiet", "--threads", threads});
    EXPECT_EQ(r.status, 0) << r.err;
    std::istringstream lines(r.out);
    std::string numbers;
    for (std::string line; std::getline(lines, line);)
      if (!line.starts_with("case")) numbers += line + '\n';  // those tell times
    return numbers;
  };
  EXPECT_EQ(results("1"), results("2"));
}

}  // namespace
}  // namespace treadmark::testing
