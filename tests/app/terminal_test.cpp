// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/sample_input.hpp"

namespace treadmark::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

/// What the program shows on a terminal of 60 columns.
std::string on_terminal(const std::string& words, const std::string& variables = "NO_COLOR=") {
  const std::string call = "stty cols 60; TERM=xterm " + variables + " " TREADMARK_PROGRAM " " + words;
  return RunningProgram({"script", "-qec", call, "/dev/null"}).wait().out;
}

/// The longest line, without colours.
std::size_t width_of(const std::string& shown) {
  std::size_t most = 0;
  std::istringstream lines(std::regex_replace(shown, std::regex("\x1b\\[[0-9;]*m|\r"), ""));
  for (std::string line; std::getline(lines, line);) most = std::max(most, line.size());
  return most;
}

TEST(Terminal, LongLinesAreFoldedThereAndNowhereElse) {
  const auto letters = [](const std::string& text) { return std::regex_replace(text, std::regex("\\s+"), ""); };
  const std::string file = run_program({"list", "remarks"}).out, shown = on_terminal("list remarks");
  EXPECT_GT(width_of(file), 80u);
  EXPECT_LE(width_of(shown), 60u);
  EXPECT_THAT(shown, ContainsRegex("grid_cuts_contact +warning +more pressure[^\n]*\n {20,}[a-z]"));
  EXPECT_EQ(letters(shown), letters(file)) << "nothing is lost";
  EXPECT_LE(width_of(on_terminal("run there-is-no-file-of-such-a-name-in-this-folder.toml")), 60u);
  EXPECT_LE(width_of(on_terminal("report --help")), 60u);
}

TEST(Terminal, MessagesHaveColoursUnlessNobodyWantsThem) {
  EXPECT_THAT(on_terminal("run none.toml"), HasSubstr("\x1b[1;31mtreadmark\x1b[0m: none.toml"));
  EXPECT_THAT(on_terminal("run none.toml", "NO_COLOR=1"), Not(HasSubstr("\x1b")));
  EXPECT_THAT(run_program({"run", "none.toml"}).err, Not(HasSubstr("\x1b")));
  EXPECT_THAT(on_terminal("\"$(printf '\\033[31mdance')\"", "NO_COLOR=1"), Not(HasSubstr("\x1b")))
      << "as others may write it";
}

TEST(Terminal, ProgressHasABar) {
  const SampleInput input;
  EXPECT_THAT(on_terminal("run " + input.inp().string()), ContainsRegex("\r\x1b\\[K\\[#*[.]*\\] [0-9]/2 \\("));
  EXPECT_THAT(on_terminal("run " + input.inp().string() + " --quiet"), Not(HasSubstr("[#")));
}

}  // namespace
}  // namespace treadmark::testing
