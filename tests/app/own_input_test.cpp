// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "treadmark/core/parts.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

// No verb writes over what it reads.

namespace treadmark::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Options of a verb that take the name of a file or folder, in the order of its help; required: those that must stand.
std::vector<std::string> file_options(const std::string& verb, std::set<std::string>& required) {
  std::vector<std::string> options;
  std::istringstream help(run_program({verb, "--help"}).out);
  const std::regex row(R"(^  (?:-\w,)?(--[a-z0-9-]+) (FILE|FOLDER|TEXT REQUIRED))");
  for (std::string line; std::getline(help, line);) {
    std::smatch found;
    if (!std::regex_search(line, found, row)) continue;
    options.push_back(found[1]);
    if (line.find(" REQUIRED") != std::string::npos) required.insert(found[1]);
  }
  return options;
}

TEST(OwnInput, IsNoOutputOfAnyVerb) {
  struct Use {
    std::vector<std::string> words;  ///< '@': the file
    const char* part = nullptr;
  };
  const std::map<std::string, Use> uses{
      {"run", {{"@"}}},
      {"compare", {{"@"}}},
      {"bench", {{"@"}}},
      {"geometry", {{"@"}}},
      {"convert", {{"@"}}},
      {"trace", {{"@"}}},
      {"import", {{"@"}, "scans"}},
      {"scan", {{"@"}, "scans"}},
      {"measure", {{"wheel", "@"}}},
      {"simulate", {{"@"}, "vehicle"}},
      {"assess", {{"@"}, "vehicle"}},
      {"sweep", {{"@"}, "vehicle"}},
      {"evolve", {{"@"}, "vehicle"}},
      {"design", {{"@"}, "nlopt"}},
      {"stability", {{"@"}, "vehicle"}},
      {"response", {{"@"}, "vehicle"}},
      {"track", {{"@"}, "vehicle"}},
      {"table", {{"@"}, "vehicle"}},
      {"fmu", {{"@"}, "fmu"}},
      {"report", {{"@"}, "report"}},
      {"plot", {{"@"}, "report"}},
      {"live", {{"@", "--no-open"}, "report_scripts"}},
      {"check", {{"@"}}},
  };
  const std::set<std::string> without{"diff",       "conform", "list", "schema",
                                      "completion", "man",     "new"};  // files of both kinds
  const std::set<std::string> read{
      "import --settings",     "import --truth",       "measure --limits", "measure --mate",
      "geometry --wheel-left", "geometry --rail-left", "assess --limits",  "scan --line"};
  int tried = 0;
  for (const std::string verb : {
#define VERB(name, ...) #name,
#include "treadmark/app/cli/verbs.def"
#undef VERB
       }) {
    if (without.contains(verb)) continue;
    ASSERT_TRUE(uses.contains(verb)) << verb << " needs a line here";
    const Use& use = uses.at(verb);
    if (use.part != nullptr && !has_part(use.part)) continue;
    std::set<std::string> required;
    const std::vector<std::string> options = file_options(verb, required);
    EXPECT_FALSE(options.empty()) << verb;
    for (const std::string& option : options) {
      if (read.contains(verb + ' ' + option) || (option == "--report" && !has_part("report")) ||
          (option == "--hdf5" && !has_part("hdf5")))
        continue;
      const TemporaryFolder folder;
      const fs::path file = folder.write("in.toml", "# mine\n");
      fs::create_directory(folder.path() / "x");
      fs::create_symlink("in.toml", folder.path() / "link");
      fs::create_hard_link(file, folder.path() / "twin");
      for (const char* name : {"in.toml", "x/../in.toml", "link", "twin"}) {
        std::vector<std::string> words{"--quiet", verb};
        for (const std::string& word : use.words) words.push_back(word == "@" ? file.string() : word);
        for (const std::string& other : required)
          if (other != option) words.insert(words.end(), {other, (folder.path() / "other").string()});
        words.insert(words.end(), {option, (folder.path() / name).string()});
        const ProgramResult r = run_program(words);
        EXPECT_EQ(r.status, 2) << ::testing::PrintToString(words) << r.err;
        EXPECT_THAT(r.err, HasSubstr("would overwrite " + file.string())) << ::testing::PrintToString(words);
        EXPECT_EQ(content_of(file), "# mine\n");
        EXPECT_FALSE(fs::exists(folder.path() / "other"));
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 60);
}

TEST(OwnInput, IsNoOutputWhereAFileNamesIt) {
  const TemporaryFolder folder;
  const auto at = [&](const char* name) { return (folder.path() / name).string(); };
  ASSERT_EQ(run_program({"convert", "S1002", at("wheel.csv")}).status, 0);
  const fs::path file = folder.write("case.toml", standard_case("1.0", "shape.file = \"wheel.csv\"\n"));
  const std::string profile = content_of(at("wheel.csv")), text = content_of(file);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"run", at("case.toml"), "--json", at("wheel.csv")},
        {"convert", at("case.toml"), at("wheel.csv"), "--body", "wheel"},
        {"measure", "wheel", folder.path().string(), "--csv", at("wheel.csv")}}) {
    const ProgramResult r = run_program(words);
    EXPECT_EQ(r.status, 2) << words[0] << r.out;
    EXPECT_THAT(r.err, HasSubstr("would overwrite ")) << words[0];
    EXPECT_EQ(content_of(at("wheel.csv")), profile) << words[0];
  }
  // what is written anew is no input, and what was read may lie beside it
  EXPECT_EQ(run_program({"convert", at("case.toml"), at("other.toml")}).status, 0);
  EXPECT_EQ(run_program({"convert", at("case.toml"), at("other.toml")}).status, 0);
  EXPECT_EQ(content_of(file), text);
}

TEST(OwnInput, OfAReportIsInItsFolder) {
  TREADMARK_NEEDS("report");
  TREADMARK_NEEDS("hdf5");
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string(), store = out + "/fields.h5";
  ASSERT_EQ(run_program({"--quiet", "run", folder.write("case.toml", standard_case("1.0")).string(), "-o", out}).status,
            0);
  const std::string before = content_of(store);
  const ProgramResult r = run_program({"report", out, "-o", store});
  EXPECT_EQ(r.status, 2) << r.out;
  EXPECT_THAT(r.err, HasSubstr("would overwrite"));
  EXPECT_EQ(content_of(store), before);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(run_program({"report", out, "-o", out + "/report.html"}).status, 0);
}

}  // namespace
}  // namespace treadmark::testing
