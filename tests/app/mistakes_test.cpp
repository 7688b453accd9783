// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "treadmark/io/files/replaced.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

// What people do wrong at the command line and in files: each message says what, where, and what to do instead.

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kCase =
    "title = \"mine\"\n[wheel]\nshape.standard = \"S1002\"\n[rail]\nshape.standard = \"60E1\"\n"
    "[track]\ncant = \"1:40\"\ngauge_mm = 1435\n[wheelset]\nvertical_force_N = 100e3\n"
    "[discretisation]\ndx_mm = 1\nds_mm = 1\n[case]\nregime = \"none\"\n";

/// A folder with a case, one of four positions, a wheel and a binary file. '@' in commands stands for it.
class Mistakes : public ::testing::Test {
 protected:
  void SetUp() override {
    write("my.toml", kCase);
    write("four.toml", std::string(kCase) + "[[cases]]\nwheelset.y_mm = [-1, 0, 1, 2]\n");
    write("binary.toml", std::string("\x7f"
                                     "ELF\0\1\2",
                                     7));
    ASSERT_EQ(run_program({"convert", "S1002", at("wheel.csv")}).status, 0);
  }
  std::string at(const std::string& name) const { return (folder_.path() / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
  }
  ProgramResult call(std::vector<std::string> words) const {
    for (std::string& word : words) word = io::replaced(word, "@", folder_.path().string());
    return run_program(words);
  }
  /// words: of standard error.
  void expect(const std::vector<std::string>& command, int status, const std::vector<std::string>& words) const {
    const ProgramResult r = call(command);
    SCOPED_TRACE(::testing::PrintToString(command));
    EXPECT_EQ(r.status, status) << r.err;
    for (const std::string& word : words)
      EXPECT_THAT(r.err, HasSubstr(io::replaced(word, "@", folder_.path().string())));
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Mistakes, OptionsAndPlacesAreNamed) {
  expect({"run", "@/my.toml", "--ouput", "x"}, 2,
         {"treadmark run: there is no option '--ouput' (did you mean '--output'?)",
          "usage: treadmark run [OPTIONS] CASE...; treadmark run --help shows all"});
  expect({"run", "@/my.toml", "-output", "x"}, 2, {"there is no option '-output' (did you mean '--output'?)"});
  expect({"run", "@/my.toml", "--repor=x"}, 2, {"did you mean '--report'?"});
  expect({"run", "@/my.toml", "--out", "x"}, 2, {"did you mean '--output'?"});
  expect({"run", "@/my.toml", "--gauges-mm", "3"}, 2, {"it belongs to treadmark geometry"});
  expect({"run"}, 2, {"treadmark run: CASE is missing", "usage: treadmark run [OPTIONS] CASE..."});
  expect({"convert", "@/wheel.csv"}, 2,
         {"treadmark convert: OUT is missing", "usage: treadmark convert [OPTIONS] IN OUT;"});
  expect({"diff", "a", "b", "c"}, 2, {"'c' is one word too many: diff takes FIRST and SECOND"});
  expect({"geometry", "@/wheel.csv", "60E1"}, 2, {"'60E1' is one word too many", "--wheel and --rail"});
  expect({"geometry", "@/wheel.csv"}, 2,
         {"is a profile, and CASE is a case file (name profiles with --wheel and --rail)"});
  expect({"geometry", "60E1"}, 2, {"name profiles with --wheel and --rail"});
  expect({"run", "@/my.toml", "wheelset.y_mm=3"}, 2, {"'wheelset.y_mm=3' is no file", "--set KEY=VALUE"});
  expect({"geometry", "@/my.toml", "track.gauge_mm=1440"}, 2, {"write --set track.gauge_mm=1440"});
  expect({"check", "@/wheel.csv", "--body", "weel"}, 2,
         {"--body cannot be 'weel': choose wheel, rail (did you mean 'wheel'?)"});
  expect({"schema", "cas"}, 2, {"WHAT cannot be 'cas'", "did you mean 'case'?"});
  expect({"convert", "@/wheel.csv", "x.stl", "--nominal-radius", "460,5"}, 2,
         {"must be a number from 0 on, not '460,5' (write 460.5)"});
  expect({"list", "profile"}, 2, {"cannot list 'profile' (did you mean 'profiles'?)"});
  expect({"run", "@/my.toml", "--backend", "splin"}, 2, {"unknown backend 'splin' (did you mean 'spline'?)"});
  expect({"compare", "@/my.toml", "--detectors", "gird"}, 2, {"there is no detector 'gird' (did you mean 'grid'?)"});
  expect({"run", "@/my.toml", "--set", "rail.shape.standard=60E3"}, 2, {"did you mean"});
}

TEST_F(Mistakes, VerbsAreNamed) {
  expect({"Run", "@/my.toml"}, 2, {"there is no verb 'Run' (did you mean 'run'?)"});
  expect({"@/my.toml"}, 2, {"the verb stands first: treadmark run @/my.toml"});
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"help", "run"}, {"run", "help"}, {"--quiet", "help", "run"}}) {
    const ProgramResult help = call(words);
    EXPECT_EQ(help.status, 0) << help.err;
    EXPECT_EQ(help.out, call({"run", "--help"}).out);
  }
  EXPECT_EQ(call({"help"}).out, call({"--help"}).out);
  expect({"help", "rum"}, 2, {"there is no verb 'rum' (did you mean 'run'?)"});
  const ProgramResult list = call({"list"});
  EXPECT_EQ(list.status, 0);
  for (const char* kind : {"backends", "defects", "laws", "profiles", "remarks", "solvers", "verbs"}) {
    EXPECT_THAT(list.out, HasSubstr(std::string("treadmark list ") + kind));
    EXPECT_EQ(call({"list", kind}).status, 0);
  }
}

TEST_F(Mistakes, FilesThatAreNotThereAreLookedForBesideTheirName) {
  const std::string near = "did you mean @/my.toml?";
  for (const char* verb : {"run", "check", "compare", "geometry"})
    for (const char* name : {"@/MY.toml", "@/my.tom", "@/mz.toml"}) expect({verb, name}, 2, {near});
  expect({"run", "@/my"}, 2, {near});
  expect({"run", "@/my.tml"}, 2, {near});
  expect({"run", "@/nothing_like_it_here.toml"}, 2, {"does not exist (check its name and folder)"});
  expect({"run", "@/no/such/my.toml"}, 2, {"there is no folder @/no/such"});
  const std::string wheel = "did you mean @/wheel.csv?";
  expect({"check", "@/WHEEL.csv"}, 3, {wheel});
  expect({"check", "@/wheels.csv"}, 3, {wheel});
  expect({"check", "@/wheel.prw"}, 3, {wheel});
  expect({"convert", "@/Wheel.csv", "@/x.stl", "--body", "wheel"}, 3, {wheel});
  expect({"trace", "@/Wheel.csv", "--section-deg", "0", "--body", "wheel"}, 3, {wheel});
  expect({"measure", "wheel", "@/Wheel.csv"}, 3, {wheel});
  expect({"measure", "wheel", "@/wheel.csv", "--nominal", "@/Wheel.csv"}, 2, {wheel});
  expect({"geometry", "--wheel", "@/Wheel.csv", "--rail", "60E1", "--gauge-mm", "1435"}, 3, {wheel});
  expect({"geometry", "--wheel", "S1003", "--rail", "60E1", "--gauge-mm", "1435"}, 3,
         {"neither a file nor a profile that is built in (did you mean S1002?)"});
  expect({"convert", "S1O02", "@/x.csv"}, 3, {"did you mean S1002?"});
  expect({"run", "@/my.toml", "--set", "wheel.shape.file=@/Wheel.csv"}, 3, {wheel});
  if (has_part("report")) {
    ASSERT_EQ(call({"run", "@/my.toml", "-o", "@/results"}).status, 0);
    expect({"report", "@/result"}, 3, {"did you mean @/results?"});
    expect({"plot", "@/Results"}, 3, {"did you mean @/results?"});
  }
  if (has_part("scans")) {
    expect({"import", "@/Wheel.csv", "-o", "@/x.slcw"}, 3, {wheel});
    expect({"import", "@/wheel.csv", "-o", "@/x.slcw", "--settings", "@/My.toml"}, 2, {near});
    expect({"scan", "@/Wheel.csv", "-o", "@/x.xyz", "--body", "wheel"}, 3, {wheel});
  }
  if (has_part("vehicle")) {
    for (const char* name : {"@/My.toml", "@/my.tml"}) {
      expect({"simulate", name}, 2, {near});
      expect({"sweep", name, "-o", "@/x"}, 2, {near});
      expect({"evolve", name, "-o", "@/x"}, 2, {near});
      expect({"stability", name}, 2, {near});
      expect({"response", name}, 2, {near});
      expect({"track", name}, 2, {near});
    }
    write("sim.toml", "[simulation]\nvehicle = \"My.toml\"\nspeed_m_s = 1\ndistance_m = 1\n");
    expect({"check", "@/sim.toml"}, 2, {"sim.toml:2:11", "simulation.vehicle: there is no file", near});
    write("study.toml", "[study]\nbase = \"My.toml\"\n[[study.vary]]\nkey = \"wheelset.y_mm\"\nvalues = [1]\n");
    expect({"check", "@/study.toml"}, 2, {"study.toml:2:8", "there is no file", near});
  }
}

TEST_F(Mistakes, OtherThingsThanCases) {
  for (const char* verb : {"run", "check", "compare"}) {
    expect({verb, "@"}, 2, {"is expected, this is a folder (name a file in it)"});
    expect({verb, "@/binary.toml"}, 2, {"zero bytes"});
  }
  expect({"run", "@/wheel.csv"}, 2, {"'.csv' is no kind of case file", "wheel.shape.file"});
  write("result.json", "{}");
  expect({"run", "@/result.json"}, 2, {"'.json' is no kind of case file", "treadmark report"});
  write("noext", kCase);
  expect({"run", "@/noext"}, 2, {"this has no extension"});
}

/// Every kind of file in TOML, with one line that has a slip in place of SLIP, and how it is read.
TEST_F(Mistakes, SlipsOfTomlAreNamedAlikeInAllKindsOfFiles) {
  struct Kind {
    const char* text;
    const char* part;  ///< without which nobody reads it; null: none
    std::vector<std::string> command;
  };
  const std::vector<Kind> kinds{
      {"[wheel]\nSLIP\n", nullptr, {"run", "@/kind.toml"}},
      {"[wheel]\nSLIP\n", nullptr, {"check", "@/kind.toml"}},
      {"[wheel]\nSLIP\n", nullptr, {"geometry", "@/kind.toml"}},
      {"[wheel]\nSLIP\n", nullptr, {"compare", "@/kind.toml"}},
      {"[wheel]\nSLIP\n", nullptr, {"convert", "@/kind.toml", "@/x.inp"}},
      {"[simulation]\nSLIP\n", "vehicle", {"simulate", "@/kind.toml"}},
      {"[study]\nSLIP\n", "vehicle", {"sweep", "@/kind.toml", "-o", "@/x"}},
      {"[evolve]\nSLIP\n", "vehicle", {"evolve", "@/kind.toml", "-o", "@/x"}},
      {"[design]\nSLIP\n", "nlopt", {"design", "@/kind.toml", "-o", "@/x"}},
      {"[vehicle]\nSLIP\n", "vehicle", {"stability", "@/kind.toml"}},
      {"[track]\nSLIP\n", "vehicle", {"track", "@/kind.toml"}},
      {"[scan]\nSLIP\n", "scans", {"import", "@/wheel.csv", "-o", "@/x.slcw", "--settings", "@/kind.toml"}},
      {"[wheel]\nSLIP\n", nullptr, {"measure", "wheel", "@/wheel.csv", "--limits", "@/kind.toml"}}};
  const std::vector<std::pair<std::string, std::string>> slips{
      {"file = wheel.csv",
       "not valid TOML: 'wheel.csv' is text, and text stands in quotes (write file = \"wheel.csv\")"},
      {"file = \"C:\\data\\w.csv\"", "write file = \"C:/data/w.csv\", or single quotes round it"},
      {"force = 100,000", "write force = 100000, or 100.000"},
      {"force = 0,5", "write force = 0.5"},
      {"force == 5", "'=' stands twice (write force = 5)"},
      {"a = 1\na = 2", "the key a stands in line 2 already"},
      {"name = \"R\xE4"
       "der\"",
       "the byte 0xE4 is not of UTF-8"}};
  for (const Kind& kind : kinds) {
    if (kind.part != nullptr && !has_part(kind.part)) continue;
    for (const auto& [slip, said] : slips) {
      write("kind.toml", io::replaced(kind.text, "SLIP", slip));
      expect(kind.command, 2, {"kind.toml:", said});
    }
  }
}

TEST_F(Mistakes, WrongTypesSayWhatToWrite) {
  const std::vector<std::pair<std::string, std::string>> rows{
      {"track.cant = 40", "track.cant must be text, found an integer (write \"1:40\")"},
      {"track.cant = 0.025", "(write \"1:40\")"},
      {"wheel.shape.standard = 60E1", "(text stands in quotes)"},
      {"wheelset.y_mm = \"3\"", "must be a number, found text (write 3 without quotes)"},
      {"wheelset.y_mm = \"0,5\"", "decimals are separated by a point: write 0.5"},
      {"wheelset.y_mm = \"3 mm\"", "a number stands without its unit"},
      {"discretisation.max_elements = 1e4", "must be an integer, found a number (write 10000)"},
      {"discretisation.reference_search_mesh = 1", "must be true or false, found an integer (write true)"},
      {"discretisation.reference_search_mesh = \"no\"", "(write false without quotes)"},
      {"case.side = \"Rigth\"", "did you mean \"right\"?"},
      {"case.side = true", "(choose \"left\", \"right\")"},
      {"wheelset.y_mm = [1, 2]", "lists of values make cases in [[cases]]"},
      {"wheelset.Y_MM = 1", "did you mean 'wheelset.y_mm'?"},
      {"Wheelset.y_mm = 1", "unknown key 'Wheelset' (did you mean 'wheelset'?)"},
      {"wheel.shape.file = \"C:\\temp\\new.csv\"", "a backslash in double quotes begins one"}};
  for (const auto& [line, said] : rows) {
    write("type.toml", line + "\n");
    expect({"run", "@/type.toml"}, 2, {"type.toml:1:", said});
  }
}

TEST_F(Mistakes, ListsOfValuesAreTakenFromTheCommandLineToo) {
  const ProgramResult two = call({"run", "@/my.toml", "--set", "wheelset.y_mm=[0, 2]", "--verbose"});
  EXPECT_EQ(two.status, 0) << two.err;
  EXPECT_THAT(two.out, HasSubstr("case 2"));
  EXPECT_THAT(two.out, Not(HasSubstr("case 3")));
  write("two.toml", std::string(kCase) + "[[cases]]\nwheelset.y_mm = [0, 2]\n");
  EXPECT_EQ(call({"convert", "@/my.toml", "@/a.toml", "--set", "wheelset.y_mm=[0, 2]"}).status, 0);
  EXPECT_EQ(call({"convert", "@/two.toml", "@/b.toml"}).status, 0);
  const auto text = [&](const char* name) { return content_of(at(name)); };
  EXPECT_EQ(io::replaced(text("a.toml"), "my", "two"), text("b.toml"));
  EXPECT_THAT(call({"check", "@/four.toml", "--set", "wheelset.y_mm=[0, 2]"}).out, HasSubstr("2 cases, no errors"));
  expect({"check", "@/four.toml", "--set", "track.gauge_mm=[1435, 1437]"}, 2, {"has 4 values", "has 2"});
  expect({"check", "@/my.toml", "--set", "wheelset.y_mm=[]"}, 2, {"the list of wheelset.y_mm is empty"});
  expect({"check", "@/four.toml", "--set", "wheelset.y_mm=1"}, 0, {"only 1 of 4 different cases still differ"});
  EXPECT_THAT(call({"check", "@/four.toml", "--set", "track.gauge_mm=1437"}).err, Not(HasSubstr("differ")));
  expect({"check", "@/my.toml", "--set", "wheelset.y_mm=0,5"}, 2, {"decimals are separated by a point: write 0.5"});
}

TEST_F(Mistakes, AProfileIsTakenForWhatItsShapeSays) {
  const std::string said = "taken for a wheel by its shape: say --body if it is none";
  expect({"convert", "@/wheel.csv", "@/w.ply", "--nominal-radius", "460", "--range-deg", "-1,1", "--resolution", "5"},
         0, {said});
  expect({"trace", "@/wheel.csv", "--section-deg", "0", "--nominal-radius", "460"}, 0, {said});
  ASSERT_EQ(call({"convert", "60E1", "@/rail.csv"}).status, 0);
  expect({"convert", "@/rail.csv", "@/r.ply", "--range-mm", "0,20", "--resolution", "5"}, 0,
         {"taken for a rail by its shape"});
  expect({"convert", "@/wheel.csv", "@/w.stl", "--nominal-radius", "0.46"}, 2, {"no wheel has a radius of 0.00046 m"});
}

TEST_F(Mistakes, NumbersInOtherUnitsAreRefusedOrDoubted) {
  EXPECT_THAT(call({"run", "@/my.toml"}).out, Not(HasSubstr("  warning: ")));
  struct Row {
    std::string assignment;
    int status;
    std::string words;
  };
  const std::vector<Row> rows{{"track.gauge_mm=1.435", 2, "the number is in mm: 1435 is meant?"},
                              {"wheelset.nominal_radius_mm=0.46", 2, "the number is in mm: 460 is meant?"},
                              {"wheelset.nominal_radius_mm=460000", 2, "the number is in mm: 460 is meant?"},
                              {"wheelset.y_mm=2000", 2, "the number is in mm: 2 is meant?"},
                              {"wheelset.nominal_radius_mm=920", 1, "920 mm, more than 750: is it the diameter?"},
                              {"wheelset.vertical_force_N=100", 1, "100 N, less than 500: is it in kN?"},
                              {"wheelset.vertical_force_N=1e8", 1, "more than 1e+06"},
                              {"wheelset.y_mm=-20", 1, "the flange of its other wheel has climbed the rail"},
                              {"track.gauge_mm=143.5", 1, "is it in another unit?"},
                              {"track.cant_rad=0.4", 1, "1:40 is 0.025 rad"},
                              {"track.gauge_height_mm=0.014", 1, "less than 2"}};
  for (const Row& row : rows) {
    SCOPED_TRACE(row.assignment);
    const ProgramResult run = call({"run", "@/my.toml", "--set", row.assignment});
    const ProgramResult check = call({"check", "@/my.toml", "--set", row.assignment});
    EXPECT_EQ(run.status, row.status) << run.err;
    EXPECT_THAT(run.out + run.err, HasSubstr(row.words));
    EXPECT_THAT(check.out + check.err, HasSubstr(row.words));
    if (row.status == 1) {
      EXPECT_THAT(run.out, HasSubstr("\n  warning: "));
    }
  }
  const auto noted = [&](const std::string& wheelset) {
    write("moving.toml",
          io::replaced(std::string(kCase), "regime = \"none\"", "regime = \"steady\"") + "[[cases]]\n" + wheelset);
    return call({"check", "@/moving.toml"}).err;
  };
  EXPECT_THAT(noted("wheelset.velocity_m_s = 20\n"), HasSubstr("the wheel slides without turning"));
  EXPECT_THAT(noted("wheelset.rolling = \"nominal\"\n"), HasSubstr("no speed is given: nothing moves"));
  EXPECT_EQ(noted("wheelset.velocity_m_s = 20\nwheelset.rolling = \"nominal\"\n"), "");
}

}  // namespace
}  // namespace treadmark::testing
