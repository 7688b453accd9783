// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/contact_program/read_inp.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/tests/io/cases/contact_writer.hpp"
#include "treadmark/tests/io/cases/same_cases.hpp"
#include "treadmark/tests/support/refusal.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::io {
namespace {

namespace fs = std::filesystem;
using testing::ContactWriter;
using testing::expect_same_cases;
using ::testing::HasSubstr;
using treadmark::testing::refusal_of;

std::vector<fs::path> files_with(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == extension) files.push_back(entry.path());
  ranges::sort(files);
  return files;
}

bool of_one_kind(const CaseFile& f) {
  return ranges::all_of(f.cases, [&](const Case& c) { return c.content.index() == f.cases.front().content.index(); });
}

void expect_both_round_trips(const CaseFile& file) {
  const fs::path folder = file.path.parent_path();
  const std::string inp = contact_input_text(file, folder);
  SCOPED_TRACE(inp);
  expect_same_cases(file, parse_contact_input(inp, folder / "again.inp"));
  if (!of_one_kind(file)) return;
  const std::string toml = case_file_text(file, folder);
  SCOPED_TRACE(toml);
  expect_same_cases(file, parse_case_text(toml, folder / "again.toml"));
}

TEST(WrittenCase, ARollingWheelStaysOne) {
  const CaseFile file = parse_case_text(
      "rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\n[wheelset]\nvertical_force_N = 1e5\n"
      "velocity_km_h = 100\nrolling = \"nominal\"\n",
      "rolling.toml");
  const std::string text = case_file_text(file, {});
  EXPECT_THAT(text, HasSubstr("velocity_km_h = 100\nrolling = 'nominal'"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("vpitch")));
  expect_same_cases(file, parse_case_text(text, "again.toml"));
}

TEST(WrittenCase, SaysInWordsWhatIsAskedFor) {
  const CaseFile file = parse_case_text(
      "rail.shape.standard = \"60E1\"\nwheel.shape.file = \"worn/w.csv\"\ntrack.cant = \"1:40\"\n[wheelset]\n"
      "vertical_force_N = 1e5\nvelocity_km_h = 100\nrolling = \"nominal\"\n[[cases]]\nwheelset.y_mm = [-2, 0, 2]\n",
      "rolling.toml");
  const Inputs inputs = inputs_of(file.cases, file.path.parent_path());
  const auto value = [&](const char* name) {
    const auto found = ranges::find(inputs, name, &Inputs::value_type::first);
    return found == inputs.end() ? std::string("nothing") : found->second;
  };
  EXPECT_EQ(value("wheelset: vertical force"), "100 kN");
  EXPECT_EQ(value("wheelset: velocity"), "100 km/h");
  EXPECT_EQ(value("wheelset: y"), "-2, 0, 2 mm");
  EXPECT_EQ(value("wheelset: nominal radius"), "460 mm");  // these are as without their keys
  EXPECT_EQ(value("track: gauge"), "1435 mm");
  EXPECT_EQ(value("friction: coefficient"), "0.3");
  EXPECT_EQ(value("discretisation: dx"), "auto");
  EXPECT_EQ(value("solver: tangential model"), "full");
  EXPECT_EQ(value("track: cant"), "1:40");
  EXPECT_EQ(value("wheel shape: file"), "worn/w.csv");
  EXPECT_EQ(value("rail shape: standard"), "60E1");
  EXPECT_EQ(value("material: shear modulus"), "nothing");
}

TEST(WrittenCase, InputOfTheReferenceProgramReadsAsTheSame) {
  TREADMARK_REQUIRE_SHARED();
  const auto files = files_with(*shared / "data", ".inp");
  EXPECT_GE(files.size(), 25u);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    expect_both_round_trips(read_contact_input(file));
  }
}

TEST(WrittenCase, ExamplesReadAsTheSameOrAreRefusedByName) {
  int written = 0, patches = 0;
  for (const fs::path& file : files_with(fs::path(TREADMARK_SOURCE_DIR) / "examples", ".toml")) {
    SCOPED_TRACE(file.string());
    CaseFile f;
    try {
      f = read_any_case(file, {});
    } catch (const Error&) {
      continue;  // a simulation, a study, a vehicle or a track
    }
    ++written;
    expect_same_cases(f, parse_case_text(case_file_text(f, file.parent_path()), file.parent_path() / "again.toml"));
    if (std::holds_alternative<BasicCase>(f.cases.front().content)) {
      ++patches;
      expect_both_round_trips(f);
      continue;
    }
    const std::string error = refusal_of([&] { contact_input_text(f, file.parent_path()); });
    EXPECT_THAT(error, HasSubstr("cannot be written as input of CONTACT (.inp)"));  // shapes by formula
    EXPECT_THAT(error, HasSubstr("treadmark convert"));
  }
  EXPECT_GE(written, 8);
  EXPECT_GE(patches, 1);
}

TEST(WrittenCase, EveryDigitReadsAsTheSame) {
  std::vector<ContactWriter> cases;
  for (const int law : {0, 2, 3, 4, 5}) cases.push_back(ContactWriter(1).set("FRCLAW", law));
  for (const int v : {1, 2}) cases.push_back(ContactWriter(1).set("VARFRC", v).set("FRCLAW", 4));
  for (const int d : {3, 4, 5, 6, 7}) cases.push_back(ContactWriter(1).set("DISCNS", d));
  for (const int b : {1, 5, 6}) cases.push_back(ContactWriter(1).set("BOUND", b));
  for (const int m : {1, 2, 3, 4, 5}) cases.push_back(ContactWriter(1).set("MATER", m));
  for (const int t : {0, 1, 2}) cases.push_back(ContactWriter(1).set("TANG", t));
  for (const int c : {0, 4, 5}) cases.push_back(ContactWriter(1).set("CONFIG", c));
  for (const int a : {1, 2}) cases.push_back(ContactWriter(1).set("MATFIL", a));
  for (const int g : {2, 4}) cases.push_back(ContactWriter(1).set("GAUSEI", g));
  cases.push_back(ContactWriter(1).set("NORM", 0).set("EWHEEL", 5).set("INFLCF", 3).set("STRESS", 3));
  cases.push_back(ContactWriter(1).set("FORCE", 1));
  cases.push_back(ContactWriter(1).set("FORCE", 3));
  cases.push_back(ContactWriter(1).set("DISCNS", 4).set("INFLCF", 4));
  cases.push_back(ContactWriter(1).set("HEAT", 3).set("FRCLAW", 6));
  cases.push_back(ContactWriter(1).line("word2", "0022033 12").line("damping", "1. 2. 3. 4."));
  cases.push_back(ContactWriter(1)
                      .line("rail", "'rail.prr' 1 1000. 2.5 1 2\n 1 100d 20d 5d 0.0\n 0 0.25")
                      .line("track", "0.0 -750. 0.2 0.025 1e-7")
                      .line("wheelset", "1360. -70. 460. 3.5")
                      .line("grid", "0.3 0.7 0.9 1.5 9.1 3.3 11.7 0.013"));
  for (const int e : {0, 2, 3, 9}) cases.push_back(ContactWriter(3).set("EXRHS", e));
  for (const int t : {0, 1, 2, 3}) cases.push_back(ContactWriter(3).set("TANG", t).set("EXRHS", 9));
  for (const int f : {0, 1, 2})
    cases.push_back(ContactWriter(3).set("FORCE", f).line("kinematics", "9e3 .1 .2 .3 .4 .5"));
  for (const int m : {1, 2, 3, 4, 5}) cases.push_back(ContactWriter(3).set("MATER", m));
  for (const int c : {3, 4, 9}) cases.push_back(ContactWriter(3).set("INFLCF", c));
  for (const int law : {0, 2, 3, 4}) cases.push_back(ContactWriter(3).set("VARFRC", 3).set("FRCLAW", law));
  cases.push_back(ContactWriter(3).set("NORM", 0).set("BOUND", 1).set("STRESS", 3));
  cases.push_back(ContactWriter(3).set("HEAT", 3).set("FRCLAW", 6).set("MATER", 4));
  const std::pair<const char*, const char*> hertz[] = {{"-1", "20 10 0.013 0.021 1.1"}, {"-2", "20 10 0.013 0.6 1.1"},
                                                       {"-3", "20 10 4.1 2.3 1.1"},     {"-4", "20 10 0.013 2.3 1.1"},
                                                       {"-5", "20 10 4.1 2.3 1.1"},     {"-6", "20 10 4. 2. 3. 1.1"}};
  for (const auto& [kind, numbers] : hertz)
    cases.push_back(ContactWriter(3)
                        .set("BOUND", kind[1] == '6' ? 4 : 0)
                        .line("ipotcn", kind)
                        .line("potcon", numbers)
                        .line("hertz", ""));
  for (const char* gap : {"1 2", "1 3", "2 1", "3 1", "9 1"}) {
    const std::string base(gap, 1), plan(gap + 2);
    const std::string lines = base == "1"   ? "0.001 0.1 0.002 0.3 0.4 0.5"
                              : base == "2" ? "2 0.1 460.3 -10.7 20.1\n 0.3 1.7"
                              : base == "3" ? "0.1 0.2 0.3 0.4 0.5 0.6 700. 800."
                                            : "1 2 3 4 5 6.7";
    cases.push_back(ContactWriter(3)
                        .line("ibase", gap)
                        .line("gap", lines + (plan == "2"   ? "\n 0.1 0 0.1 0.2 0.3 -5"
                                              : plan == "3" ? "\n 0 1 0 1 0 1 2 3"
                                                            : "")));
  }
  cases.push_back(ContactWriter(3)
                      .set("NORM", 0)
                      .line("ibase", "1 4")
                      .line("gap", "1 0 1 0 0 0\n 3\n 0 1 0 1\n 0 1 2 3\n 0 1 4 5\n 0.5 0.25\n 0.125"));
  for (const ContactWriter& one : cases) {
    const std::string text = one.str() + "0\n";
    SCOPED_TRACE(text);
    expect_both_round_trips(parse_contact_input(text, "folder/case.inp"));
  }
}

TEST(WrittenCase, HistoryAndSequencesStay) {
  std::string text;
  for (const char* id : {"3 7", "3 2"})
    for (const int p : {2, 0, 1, 3}) text += ContactWriter(3).set("TANG", 1).set("PVTIME", p).line("module", id).str();
  const CaseFile f = parse_contact_input(text + "0\n", "case.inp");
  expect_both_round_trips(f);
  const CaseFile again = parse_contact_input(contact_input_text(f, ""), "case.inp");
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(again.cases.at(i).sequence, i < 4 ? 0 : 1);
}

TEST(WrittenCase, OwnSettingsOfTreadmarkStandInComments) {
  const char* toml = R"(
[rail]
shape.file = "rail.prr"
backend = "spline"
[wheel]
shape.file = "sub/wheel.slcw"
[wheelset]
vertical_force_N = 1e5
velocity_m_s = 30
vpitch_rad_s = -60
[discretisation]
prune = false
[heat]
rail_bulk_temperature_C = 30
[[case.uncertainty]]
key = "wheelset.vertical_force_N"
sigma = 2e3
[[case.uncertainty]]
key = "rail.shape"
sigma = 0.005
length_mm = 0.5
)";
  const CaseFile f = parse_case_text(toml, "folder/case.toml");
  const std::string text = contact_input_text(f, "folder");
  EXPECT_THAT(text, HasSubstr(" %treadmark discretisation.reference_search_mesh = false\n"));
  EXPECT_THAT(text, HasSubstr(" %treadmark rail.backend = 'spline'\n"));
  EXPECT_THAT(text, HasSubstr(" %treadmark case.uncertainty = [ "));
  const CaseFile again = parse_contact_input(text, "folder/case.inp");
  expect_same_cases(f, again);
  const WheelRailCase& c = std::get<WheelRailCase>(again.cases.at(0).content);
  EXPECT_FALSE(c.discretisation.prune);
  for (const Conventions kept : {c.discretisation.conventions, c.conventions, c.thermal->conventions})
    EXPECT_EQ(kept, Conventions::treadmark);
  EXPECT_FALSE(std::get<GeometryFile>(c.wheel.geometry).open_seam);
  EXPECT_EQ(std::get<GeometryFile>(c.wheel.geometry).file, fs::path("folder/sub/wheel.slcw"));
  // Elsewhere the files are still those.
  EXPECT_THAT(contact_input_text(f, "other/place"), HasSubstr("'../../folder/sub/wheel.slcw'"));
}

TEST(WrittenCase, AskingForTheNumbersOfKeysMakesNothing) {
  for (const bool patch : {false, true}) {
    Case c = case_without_keys(patch);
    for (const CaseKey& key : case_keys()) {
      if (!key.get || (key.info.scope != KeyScope::any && (key.info.scope == KeyScope::patch) != patch)) continue;
      key.get(c);
      const auto* rail = std::get_if<WheelRailCase>(&c.content);
      EXPECT_FALSE(rail != nullptr && (rail->roller || rail->rail_springs || rail->damping)) << key.info.path;
      EXPECT_FALSE(std::visit([](const auto& content) { return content.thermal.has_value(); }, c.content))
          << key.info.path;
    }
  }
}

TEST(WrittenCase, OwnSettingsThatAreWrongAreNamedWithTheirPlace) {
  const std::string first = ContactWriter(1).str(), word = "%treadmark ";
  const auto error_with = [&](const std::string& setting) {
    return refusal_of([&] { parse_contact_input(word + setting + "\n" + first + "0\n", "a.inp"); });
  };
  EXPECT_THAT(error_with("wheelset.y_nm = 3"), HasSubstr("a.inp:1:1: "));
  EXPECT_THAT(error_with("wheelset.y_mm = \"x\""), HasSubstr("a.inp:1:1: "));
  EXPECT_THAT(error_with("case.steps = 3"), HasSubstr("a.inp:1:1: "));
}

struct Refused {
  const char *setting, *named;
};
class RefusedInput : public ::testing::TestWithParam<Refused> {};
TEST_P(RefusedInput, IsNamed) {
  const std::vector<std::string> overrides{"wheelset.z_mm=0.1", GetParam().setting};
  const std::string error = refusal_of([&] {
    contact_input_text(
        parse_case_text("rail.shape.file = \"a.prr\"\nwheel.shape.file = \"a.prw\"\n", "a.toml", overrides), "");
  });
  EXPECT_THAT(error, HasSubstr(GetParam().named));
  EXPECT_THAT(error, HasSubstr("a.toml:1:1: case 1: "));
}
INSTANTIATE_TEST_SUITE_P(Settings, RefusedInput,
                         ::testing::Values(Refused{"rail.shape.standard=60E1", "rail.shape"},
                                           Refused{"wheel.shape.file=a.ply", "the wheel as .ply"},
                                           Refused{"wheel.shape.file=a.step", "the wheel as .step"},
                                           Refused{"rail.shape.file=a.xml", "the rail as .xml"},
                                           Refused{"rail.shape.crossing=nose", "rail.shape.crossing"},
                                           Refused{"wheel.flats=[{length_mm=40, depth_mm=0.1}]", "wheel.flats"},
                                           Refused{"rail.shape.file=\"it's.prr\"", "for its quote"},
                                           Refused{"solver.tangential_model=linear", "linear theory"}));

TEST(WrittenCase, FilesOfBothKindsAreNoCaseFile) {
  const CaseFile f = parse_contact_input(ContactWriter(1).str() + ContactWriter(3).str() + "0\n", "a.inp");
  EXPECT_THAT(refusal_of([&] { case_file_text(f, ""); }), HasSubstr("case 2: a case file holds either"));
}

}  // namespace
}  // namespace treadmark::io
