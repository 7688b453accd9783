// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "treadmark/app/cli/verbs.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/support/parts.hpp"

// Where the program writes: standard output that takes nothing, outputs over each other, names that are hostile.

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

/// With a redirection of the shell.
ProgramResult run_to(const std::string& redirection, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"sh", "-c", R"("$0" "$@" )" + redirection, "treadmark"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return RunningProgram(command).wait();
}

class OutputPlaces : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (input_.folder() / name).string(); }
  void write_case(const std::string& file) const {
    input_.write(file,
                 "rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\nwheelset.vertical_force_N = 1e5\n"
                 "wheelset.velocity_m_s = 2\nwheelset.vpitch_rad_s = -4.3\n");
  }
  SampleInput input_;
};

TEST_F(OutputPlaces, EveryVerbNoticesThatNothingIsTaken) {
  write_case("y.toml");
  const std::string inp = input_.inp().string(), toml = path("y.toml"), rail = path("rail.prr"), out = path("out");
  ASSERT_EQ(run_program({"run", inp, "-o", out}).status, 0);
  struct Use {
    std::vector<std::string> arguments;
    const char* part = nullptr;  ///< without which there is another error
  };
  const std::map<std::string, Use> uses{
      {"run", {{inp}}},
      {"compare", {{toml, "--backends", "spline", "--resolutions", "4"}}},
      {"diff", {{out, out}, "hdf5"}},
      {"bench", {{toml, "--backends", "spline", "--resolutions", "4", "--seconds-per-measure", "0.001"}}},
      {"conform", {{toml}}},
      {"geometry", {{"--wheel", "S1002", "--rail", "60E1", "--gauge-mm", "1435", "--cant", "1:40"}}},
      {"convert", {{rail, path("rail.csv")}}},
      {"trace", {{rail, "--section-mm", "0"}}},
      {"import", {{"--list-settings"}, "scans"}},
      {"scan", {{rail, "-o", path("rail.xyz"), "--points", "100", "--range-mm=0,10"}, "scans"}},
      {"measure", {{"wheel", "S1002"}}},
      {"stability",
       {{TREADMARK_SOURCE_DIR "/examples/flat-at-speed.toml", "--from", "20", "--to", "30", "--count", "2", "--set",
         "simulation.vehicle=vehicles/single-wheelset.toml", "--set", "simulation.wheels=[]"},
        "vehicle"}},
      {"response",
       {{TREADMARK_SOURCE_DIR "/examples/flat-at-speed.toml", "--count", "2", "--set",
         "simulation.vehicle=vehicles/single-wheelset.toml", "--set", "simulation.wheels=[]"},
        "vehicle"}},
      {"track", {{TREADMARK_SOURCE_DIR "/examples/tracks/gm-tt0088.toml", "--count", "10"}, "vehicle"}},
      {"table",
       {{toml, "--lateral-range-mm", "1", "--step-mm", "1", "--element-mm", "2", "--roll-intervals", "0",
         "--yaw-intervals", "0", "--creep-forces", "linear", "--check-points", "1"},
        "vehicle"}},
      {"fmu", {{toml, "-o", path("wheel.fmu")}, "fmu"}},
      {"report", {{out}, "report"}},
      {"plot", {{out, "--what", "pressure", "-o", "-"}, "report"}},
      {"new", {{"case", path("new.toml")}}},
      {"check", {{inp}}},
      {"list", {{"verbs"}}},
      {"schema", {{}}},
      {"completion", {{"bash"}}},
      {"man", {{}}}};
  for (const char* verb : {
#define VERB(name, ...) #name,
#include "treadmark/app/cli/verbs.def"
#undef VERB
       }) {
    const std::string name = verb;
    if (name == "simulate" || name == "assess" || name == "sweep" || name == "evolve" || name == "design")
      continue;                    // tests/app/simulation/full_output_test.cpp, tests/app/{evolve,design}
    if (name == "live") continue;  // needs the program for browsers: report/web/test/live.browser.mjs
    ASSERT_TRUE(uses.contains(name)) << name << " needs a line here";
    const Use& use = uses.at(name);
    std::vector<std::string> arguments{"--quiet", name};
    arguments.insert(arguments.end(), use.arguments.begin(), use.arguments.end());
    for (const char* redirection : {"> /dev/full", ">&-"}) {
      fs::remove(path("new.toml"));  // "new" overwrites nothing
      const ProgramResult r = run_to(redirection, arguments);
      EXPECT_GT(r.status, 0) << name << redirection;
      if (use.part == nullptr || has_part(use.part)) {
        EXPECT_THAT(r.err, HasSubstr("could not be written to standard output")) << name << redirection;
      }
    }
  }
  EXPECT_EQ(run_to("> /dev/full", {"--help"}).status, 1);
  EXPECT_EQ(run_to("> /dev/full", {"--version"}).status, 1);
}

TEST_F(OutputPlaces, StandardOutputThatIsClosedTakesNoFile) {
  // Without a file of its own for standard output, the next file that is opened would take its number.
  const std::string json = path("result.json");
  const ProgramResult r = run_to(">&-", {"run", input_.inp().string(), "--json", json});
  EXPECT_EQ(r.status, 1);
  EXPECT_EQ(input_.read("result.json").front(), '{');
  EXPECT_EQ(run_to(">&-", {"convert", path("rail.prr"), path("a.csv")}).status, 1);
  EXPECT_EQ(run_to("2>&-", {"run", input_.inp().string(), "--json", json}).status, 0);
}

TEST_F(OutputPlaces, ResultsDoNotOverwriteEachOther) {
  for (const char* folder : {"a", "b"}) fs::create_directory(input_.folder() / folder);
  for (const char* file : {"a/x.toml", "b/x.toml", "y.toml", "...toml"}) write_case(file);
  for (const char* verb : {"run", "check"}) {
    const ProgramResult r = run_program({verb, path("a/x.toml"), path("y.toml"), path("b/x.toml"), "-o", path("out")});
    EXPECT_EQ(r.status, 2) << verb;
    for (const std::string& name : {path("a/x.toml"), path("b/x.toml"), path("out/x")})
      EXPECT_THAT(r.err, HasSubstr(name));
    EXPECT_FALSE(fs::exists(path("out"))) << "nothing runs";
    EXPECT_EQ(run_program({verb, path("y.toml"), path("...toml"), "-o", path("out")}).status, 2) << "would be out/..";
  }
  ASSERT_EQ(run_program({"check", path("a/x.toml"), path("y.toml"), "-o", path("out")}).status, 0);
  EXPECT_TRUE(fs::exists(path("out/x/position_0001.svg")));
  EXPECT_TRUE(fs::exists(path("out/y/position_0001.svg")));
}

TEST_F(OutputPlaces, OutputsAreNotWrittenOverInputsOrEachOther) {
  write_case("y.toml");
  const std::string before = input_.read("y.toml"), file = path("y.toml"), again = path("./out/../y.toml");
  fs::create_directory(path("out"));
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"run", file, "--json", again},
                                                    {"compare", file, "--json", again},
                                                    {"bench", file, "--json", again}}) {
    const ProgramResult r = run_program(arguments);
    EXPECT_EQ(r.status, 2) << arguments.front();
    EXPECT_THAT(r.err, HasSubstr("would overwrite " + file));
    EXPECT_EQ(input_.read("y.toml"), before);
  }
  if (has_part("report")) {
    EXPECT_EQ(run_program({"run", file, "--json", path("one"), "--report", path("one")}).status, 2);
  }
}

TEST_F(OutputPlaces, AFileBeyondTheLimitOfItsSizeIsAnError) {
  for (const char* words : {"run \"$1\" -o \"$2\"", "run \"$1\" --json \"$2\"",
                            "convert S1002 \"$2.ply\" --body wheel --nominal-radius 460"}) {
    const std::string out = path("limited");
    const ProgramResult r = RunningProgram({"sh", "-c", "ulimit -f 1; exec \"$0\" --quiet " + std::string(words),
                                            TREADMARK_PROGRAM, input_.inp().string(), out})
                                .wait();
    EXPECT_EQ(r.status, 2) << words << r.err;
    EXPECT_THAT(r.err, HasSubstr("File too large")) << words;
    for (const auto& entry : fs::recursive_directory_iterator(input_.folder()))
      EXPECT_EQ(entry.path().filename().string().find(".part"), std::string::npos) << entry.path();
    fs::remove_all(out);
  }
}

TEST_F(OutputPlaces, MessagesCannotCommandTheTerminal) {
  const std::string name = path("\x1b[31mred\x80\xc2\x9b\u00e4.toml");
  const ProgramResult missing = run_program({"run", name});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("?[31mred??ä.toml"));
  input_.write("bad.toml", "\"\\u001b]0;title\\u0007\" = 1\n");
  const ProgramResult unknown = run_program({"run", path("bad.toml")});
  EXPECT_THAT(unknown.err, HasSubstr("?]0;title?"));
  write_case("\x1b[2Jy.toml");
  const ProgramResult checked = run_program({"check", path("\x1b[2Jy.toml")});
  EXPECT_EQ(checked.status, 0) << checked.err;
  for (const std::string& text : {missing.err, unknown.err, checked.err, checked.out}) {
    EXPECT_THAT(text, Not(HasSubstr("\x1b")));
    EXPECT_THAT(text, Not(HasSubstr("\x80")));
  }
}

TEST_F(OutputPlaces, LoopsOfLinksAreNoUnexpectedFailure) {
  fs::create_symlink("b", input_.folder() / "a");
  fs::create_symlink("a", input_.folder() / "b");
  const std::string loop = path("a");
  const std::vector<std::vector<std::string>> all{{"report", loop},
                                                  {"plot", loop},
                                                  {"diff", loop, loop},
                                                  {"run", loop},
                                                  {"run", input_.inp().string(), "-o", loop},
                                                  {"run", input_.inp().string(), "--json", loop + "/x"},
                                                  {"convert", loop, path("x.prr"), "--body", "rail"},
                                                  {"import", loop + ".ply", "-o", loop + "/x.ply"},
                                                  {"simulate", loop},
                                                  {"sweep", loop, "-o", loop},
                                                  {"check", loop}};
  for (const auto& arguments : all) {
    const ProgramResult r = run_program(arguments);
    EXPECT_GE(r.status, 2) << arguments.front() << ": " << r.err;
    EXPECT_THAT(r.err, Not(HasSubstr("unexpected"))) << arguments.front();
  }
}

}  // namespace
}  // namespace treadmark::testing
