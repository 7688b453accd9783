// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/support/parts.hpp"

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

TEST(ReportCommand, FoldersWithoutAPageOfTheirOwnHaveNumbersPicturesAndTables) {
  const SampleInput input;
  const std::string folder = (input.folder() / "geometry").string();
  ASSERT_EQ(run_program({"geometry", "--wheel", "S1002", "--rail", "60E1", "--cant", "1:40", "--gauge-mm", "1435", "-o",
                         folder})
                .status,
            0);
  const ProgramResult made = run_program({"report", folder});
  ASSERT_EQ(made.status, 0) << made.err;
  const std::string html = input.read("geometry/report.html");
  EXPECT_THAT(html, HasSubstr("<dt>track: gauge</dt><dd>1435 mm</dd>"));
  EXPECT_THAT(html, HasSubstr("id=\"picture-charts\""));
  input.write("geometry/geometry.json", "no JSON");
  EXPECT_EQ(run_program({"report", folder}).status, 3);
}

TEST(ReportCommand, TracksHaveAReport) {
  TREADMARK_NEEDS("vehicle");
  const SampleInput input;
  const std::string track = std::string(TREADMARK_SOURCE_DIR) + "/examples/tracks/gm-tt0088.toml";
  const std::string html = (input.folder() / "track.html").string();
  const ProgramResult made = run_program({"track", track, "--report", html});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(input.read("track.html"), HasSubstr("<h1>One mass for each rail, P2 values</h1>"));
  EXPECT_THAT(input.read("track.html"), HasSubstr("id=\"receptance\""));
}

TEST(ReportCommand, OtherFilesThanPagesAreRefusedBeforeTheWork) {
  const SampleInput input;
  const std::string folder = input.folder().string();
  for (const char* name : {"/x.png", "/x.PNG"}) {
    const ProgramResult picture = run_program({"run", folder + "/missing.inp", "--report", folder + name});
    EXPECT_EQ(picture.status, 2);
    EXPECT_THAT(picture.err, HasSubstr("a report is a page (.html) or its print (.pdf)"));
  }
  const std::string before = std::getenv("PATH");
  setenv("PATH", folder.c_str(), 1);  // where there is no browser
  for (const char* name : {"/x.pdf", "/x.PDF"}) {
    const ProgramResult print = run_program({"run", folder + "/missing.inp", "--report", folder + name});
    EXPECT_EQ(print.status, 2);
    EXPECT_THAT(print.err, HasSubstr("Chromium, which is not installed"));
  }
  setenv("PATH", before.c_str(), 1);
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
  EXPECT_THAT(empty.err, HasSubstr("track.json (how a track gives way)"));
  input.write("fields.h5", "this is no HDF5 file");
  EXPECT_EQ(run_program({"report", folder}).status, 3);
  const ProgramResult several =
      run_program({"run", input.inp().string(), input.inp().string(), "--report", folder + "/x.html"});
  EXPECT_EQ(several.status, 2);
  EXPECT_THAT(several.err, HasSubstr("one case file"));
}

/// The full numbers of a row of a table in a page: data-value of its cells, NaN without.
std::vector<double> row_of(const std::string& html, const std::string& table, std::size_t row) {
  std::size_t at = html.find("id=\"table-" + table + "\"");
  at = html.find("<tbody>", at);
  for (std::size_t k = 0; k <= row; ++k) at = html.find("<tr", at + 1);
  const std::string text = html.substr(at, html.find("</tr>", at) - at);
  std::vector<double> out;
  for (std::size_t cell = text.find("<td"); cell != std::string::npos; cell = text.find("<td", cell + 1)) {
    constexpr std::string_view kValue = "data-value=\"";
    const std::string one = text.substr(cell, text.find("</td>", cell) - cell);
    const std::size_t value = one.find(kValue);
    out.push_back(value == std::string::npos ? NAN : std::stod(one.substr(value + kValue.size())));
  }
  return out;
}

TEST(ReportCommand, TwoRunsHaveTheNumbersOfTheirFiles) {
  const SampleInput input;
  input.write("case.toml", flat_wheel_case());
  const std::string toml = (input.folder() / "case.toml").string(), folder = input.folder().string();
  ASSERT_EQ(run_program({"run", toml, "-o", folder + "/before"}).status, 0);
  ASSERT_EQ(run_program({"run", toml, "-o", folder + "/after", "--set", "wheelset.vertical_force_N=100e3"}).status, 0);
  const ProgramResult made = run_program({"report", folder + "/before", folder + "/after/result.json"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.out, folder + "/before/overlay.html\n");
  const std::string html = input.read("before/overlay.html");
  EXPECT_LT(html.size(), 8'000'000u);
  EXPECT_THAT(html, HasSubstr("<td>wheelset: vertical force</td><td>80 kN</td><td>100 kN</td>"));
  const auto json = [&](const char* which) {
    return nlohmann::json::parse(input.read(which + std::string("/result.json")));
  };
  const auto before = json("before"), after = json("after");
  for (std::size_t k = 0; k < 2; ++k) {
    const auto most = [k](const nlohmann::json& result) {
      double out = 0.0;
      for (const auto& patch : result["cases"][k]["patches"]) out = std::max(out, patch["pmax_MPa"].get<double>());
      return out;
    };
    const double a = most(before), b = most(after);
    // case, status, pitch, then largest pressure of both, difference and change
    const std::vector<double> cells = row_of(html, "cases", k);
    ASSERT_GT(cells.size(), 12u);
    EXPECT_EQ(cells[0], static_cast<double>(k + 1));
    EXPECT_NEAR(cells[3], a, 1e-9 * a);
    EXPECT_NEAR(cells[4], b, 1e-9 * a);
    EXPECT_GT(b, 1.02 * a);
    EXPECT_NEAR(cells[5], b - a, 1e-9 * a);
    EXPECT_NEAR(cells[6], 100.0 * (b - a) / a, 1e-6);
    const auto force = [k](const nlohmann::json& result) {
      return 1e-3 * result["cases"][k]["force_on_rail"]["fz_tr_N"].get<double>();
    };
    EXPECT_NEAR(cells[9], force(after) - force(before), 1e-8);
  }
  const ProgramResult fixed =
      run_program({"report", folder + "/before", folder + "/after", "--static", "-o", folder + "/s.html"});
  ASSERT_EQ(fixed.status, 0) << fixed.err;
  EXPECT_THAT(input.read("s.html"), Not(HasSubstr("<script")));
}

TEST(ReportCommand, ResultsThatCannotBeLaidOverEachOtherAreNamed) {
  const SampleInput input;
  const std::string folder = input.folder().string(), a = folder + "/one/a", b = folder + "/two/a";
  ASSERT_EQ(run_program({"run", input.inp().string(), "-o", a}).status, 0);
  fs::create_directories(b);
  for (const char* file : {"fields.h5", "result.json"}) fs::copy_file(fs::path(a) / file, fs::path(b) / file);
  const std::string out = folder + "/page.html";
  const auto refused = [&](std::vector<std::string> folders, int status) {
    folders.insert(folders.begin(), "report");
    folders.insert(folders.end(), {"-o", out});
    const ProgramResult result = run_program(folders);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_FALSE(fs::exists(out));
    return result.err;
  };
  EXPECT_THAT(refused({a, folder + "/nowhere"}, 3), HasSubstr("nowhere: there is no such folder"));
  EXPECT_THAT(refused({a, folder}, 3), HasSubstr("holds no results"));
  EXPECT_THAT(refused({a, a, a, a, a}, 2), HasSubstr("5 results are too many for a page (give at most 4)"));
  fs::create_directories(folder + "/sim");
  fs::create_directories(folder + "/study");
  input.write("sim/simulation.h5", "not looked at");
  input.write("study/study.id", "not looked at");
  EXPECT_THAT(refused({a, folder + "/sim"}, 3), HasSubstr("the folder holds a simulation, " + a + " holds a run"));
  EXPECT_THAT(refused({a, folder + "/study"}, 3), HasSubstr("the folder holds a sweep (runs (treadmark run)"));
  EXPECT_THAT(refused({folder + "/study", folder + "/study"}, 3), HasSubstr("holds a sweep"));
  input.write("one/a/other.h5", input.read("one/a/fields.h5"));
  EXPECT_THAT(refused({a, a + "/other.h5"}, 3), HasSubstr("known by their folder or its fields.h5"));
  // A file that is cut off, and one of another format.
  const std::string whole = input.read("two/a/fields.h5");
  input.write("two/a/fields.h5", whole.substr(0, whole.size() / 2));
  EXPECT_THAT(refused({a, b}, 3), HasSubstr("two/a/fields.h5"));
  std::string other = whole;
  const std::string format = "treadmark result 1";
  const std::size_t at = other.find(format);
  ASSERT_NE(at, std::string::npos);
  other.replace(at, format.size(), "treadmark result 9");
  other.resize(other.find("treadmark-crc32 "));  // as other programs write it
  input.write("two/a/fields.h5", other);
  EXPECT_THAT(refused({a, b}, 3), HasSubstr("treadmark result 9"));
  // Numbers come from fields.h5: a cut result.json takes none of them.
  input.write("two/a/fields.h5", whole);
  input.write("two/a/result.json", "{\"cases\": [");
  const ProgramResult fine = run_program({"report", a, b, "-o", out});
  EXPECT_EQ(fine.status, 0) << fine.err;
  EXPECT_THAT(input.read("page.html"), HasSubstr("<h1>one/a and two/a</h1>"));
  EXPECT_THAT(input.read("page.html"), HasSubstr("No difference:"));
  const ProgramResult twice = run_program({"report", a, a + "/fields.h5", "-o", out});
  EXPECT_EQ(twice.status, 0) << twice.err;
  EXPECT_THAT(input.read("page.html"), HasSubstr("The same folder more than once:"));
  EXPECT_THAT(input.read("page.html"), HasSubstr("<h1>a (1) and a (2)</h1>"));
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
