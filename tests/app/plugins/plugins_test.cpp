// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Plug-ins of the program: their backends and detectors by name, and what is refused.
#include "treadmark/app/plugins/plugin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Words = std::vector<std::string>;

const std::string kFolder = TREADMARK_TEST_PLUGINS;
const std::string kChebyshev = kFolder + "/chebyshev.so", kWrong = kFolder + "/wrong.so";
const Words kList{"list", "backends"};

/// The program with a plug-in.
ProgramResult with(const std::string& plugin, Words words) {
  words.insert(words.begin(), {"--plugin", plugin});
  return run_program(words);
}

TEST(Plugins, AreChoicesOfEveryVerb) {
  const TemporaryFolder folder;
  const std::string file = folder.write("case.toml", standard_case("1")).string();
  EXPECT_THAT(with(kChebyshev, kList).out, AllOf(HasSubstr("analytic\n"), HasSubstr("\nchebyshev\n")));
  EXPECT_THAT(with(kChebyshev, {"list", "detectors"}).out, HasSubstr("fine-grid"));
  for (const Words& words :
       {Words{"run", file, "--backend", "chebyshev", "--json", "-", "--set", "discretisation.detector=fine-grid"},
        {"compare", file, "--backends", "spline,chebyshev", "--resolutions", "1"},
        {"bench", "--backends", "chebyshev", "--resolutions", "1", "--plugin", kChebyshev, "--seconds-per-measure",
         "0.001"}}) {
    const ProgramResult r = with(kChebyshev, words);
    EXPECT_EQ(r.status, 0) << words[0] << r.err;
    EXPECT_THAT(r.out, AllOf(HasSubstr("chebyshev"), Not(HasSubstr("failed:")), Not(HasSubstr("breaks")))) << words[0];
  }
}

TEST(Plugins, AreInCasesThatAreConvertedInReportsAndInStudies) {
  const TemporaryFolder folder;
  const std::string file = folder.write("case.toml", standard_case("1")).string(), written = file + ".again.toml",
                    results = (folder.path() / "results").string(), page = results + ".html";
  const Words chosen{"--set", "rail.backend=chebyshev"}, convert{"convert", file, written, chosen[0], chosen[1]};
  EXPECT_THAT(run_program(convert).err, HasSubstr("chebyshev"));
  EXPECT_EQ(with(kChebyshev, convert).err, "");
  const ProgramResult run = with(kChebyshev, {"run", written, "-o", results});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("rail as chebyshev"));
  if (has_part("report")) {
    EXPECT_EQ(with(kChebyshev, {"report", results, "-o", page}).status, 0);
    EXPECT_THAT(content_of(page), HasSubstr("chebyshev"));
  }
  if (has_part("vehicle")) {
    const std::string studied = results + ".study";
    const std::string study = folder
                                  .write("study.toml",
                                         "[study]\nbase = 'case.toml'\n[[study.vary]]\n"
                                         "key = 'rail.backend'\nvalues = ['spline', 'chebyshev']\n")
                                  .string();
    const ProgramResult swept = with(kChebyshev, {"sweep", study, "-o", studied});
    EXPECT_EQ(swept.status, 0) << swept.err;
    EXPECT_THAT(content_of(studied + "/sweep.csv"), HasSubstr("chebyshev"));
    EXPECT_NE(run_program({"sweep", study, "-o", studied + "-without"}).status, 0);
  }
}

TEST(Plugins, AreFoundByTheVariableAndInTheFolderOfModules) {
  const TemporaryFolder modules;
  const std::string folder = (modules.path() / "plugins").string();
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(kChebyshev, folder + "/chebyshev.so");
  for (const std::string& value : {kChebyshev, folder, ":" + kWrong + ":" + folder}) {
    setenv("TREADMARK_PLUGINS", value.c_str(), 1);
    EXPECT_THAT(run_program(kList).out, HasSubstr("\nchebyshev\n")) << value;
  }
  unsetenv("TREADMARK_PLUGINS");
  setenv("TREADMARK_MODULES", modules.path().c_str(), 1);
  EXPECT_THAT(with("chebyshev", kList).out, HasSubstr("chebyshev"));
  EXPECT_THAT(with("nobodys", kList).err, HasSubstr("it is neither here nor in " + folder));
  unsetenv("TREADMARK_MODULES");
}

TEST(Plugins, WhatCannotBeLoadedIsRefused) {
  const TemporaryFolder folder;
  const std::string text = folder.write("text.so", "no library\n").string(), again = text + ".again.so";
  std::filesystem::copy_file(kChebyshev, again);
  setenv("TREADMARK_PLUGINS", kChebyshev.c_str(), 1);
  for (const auto& [plugin, words] :
       {std::pair{kFolder + "/chebishev.so", "the plug-in does not exist (did you mean " + kChebyshev},
        {kFolder, "is a folder"},
        {text, "cannot be loaded as a library"},
        {TREADMARK_NO_PLUGIN, "no plug-in: it lacks treadmark_plugin_abi"},
        {kFolder + "/foreign.so", "'plug-in 0 of Treadmark 0.0.1', not '" + app::plugin_abi() + "'"},
        {again, "the backend 'chebyshev' exists already"}}) {
    const ProgramResult r = with(plugin, kList);
    EXPECT_EQ(r.status, 2) << r.err;
    EXPECT_THAT(r.err, AllOf(HasSubstr(plugin), HasSubstr(words)));
  }
  unsetenv("TREADMARK_PLUGINS");
}

TEST(Plugins, AreLoadedByProgramsToo) {
  app::load_plugins({kWrong, kWrong});
  EXPECT_EQ(backends().back()->name, "narrow");
  ASSERT_EQ(app::loaded_plugins().size(), 1u);
  EXPECT_EQ(app::loaded_plugins().front().first, std::filesystem::canonical(kWrong).string());
  EXPECT_THAT(app::plugin_identity(), HasSubstr("plug-in "));
  EXPECT_THROW(app::load_plugins({kFolder + "/foreign.so"}), Error);
}

TEST(Conform, IsAskedByConformBenchAndCompare) {
  const TemporaryFolder folder;
  const std::string file = folder.write("case.toml", standard_case("1", kWheelWithFlat)).string();
  for (const auto& [backend, promise] : {std::pair{"bent", "'curvatures'"}, {"narrow", "'bounds'"}})
    for (const Words& words : {Words{"conform", backend},
                               {"conform", file, "--set", std::string("wheel.backend=") + backend},
                               {"bench", "--backends", backend, "--resolutions", "1", "--seconds-per-measure", "0.001"},
                               {"compare", file, "--backends", backend, "--resolutions", "1"}}) {
      const ProgramResult r = with(kWrong, words);
      EXPECT_TRUE(r.status == 1 || words[0] == "compare") << words[0] << r.err;
      EXPECT_THAT(r.out,
                  HasSubstr((words[0] == "conform" ? "broken: " : "breaks the promise ") + std::string(promise)));
    }
  const ProgramResult kept = run_program({"conform", file});
  EXPECT_EQ(kept.status, 0) << kept.out << kept.err;
  EXPECT_THAT(kept.out, HasSubstr("kept by 2 of 2"));
  for (const auto& [words, said] : {std::pair{Words{"conform", "spilne"}, "did you mean 'spline'?"},
                                    {{"conform", file, "--resolution", "1"}, "--resolution is for a backend"},
                                    {{"conform", "spline", "--resolution=-1"}, "--resolution"},
                                    {{"conform", "spline", "--set", "wheelset.y_mm=1"}, "--set is for a case file"}}) {
    const ProgramResult r = run_program(words);
    EXPECT_EQ(r.status, 2) << r.out;
    EXPECT_THAT(r.err, HasSubstr(said));
  }
}

}  // namespace
}  // namespace treadmark::testing
