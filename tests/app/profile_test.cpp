// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <tuple>

#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CheckProfiles, KnowsStandardProfilesByTheirPoints) {
  for (const char* name : {"60E1", "54E1", "49E1", "S1002", "1:40"}) {
    const SampleInput input;
    const Profile points = analytic::sample_profile(StandardProfile{name}, 0.5e-3);
    std::string text;
    for (std::size_t i = 0; i < points.y.size(); ++i)
      text += fmt::format("{:.4f} {:.4f}\n", 1e3 * points.y[i] + 3.0, 1e3 * points.z[i] - 20.0);
    input.write("points.txt", text);
    const ProgramResult r = run_program({"check", (input.folder() / "points.txt").string()});
    EXPECT_THAT(r.out, ContainsRegex("standard +nearest to [^:]*" + std::string(name))) << r.err;
  }
}

TEST(CheckProfiles, ShowsWhatWasUnderstoodOfACase) {
  SampleInput input;
  ProgramResult r = run_program({"check", input.inp().string()});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out,
              HasSubstr("rail profile " + (input.folder() / "rail.prr").string() + "\n  kind         Simpack\n"));
  EXPECT_THAT(r.out, HasSubstr("  y            -70.00 to 60.00 mm, to the right\n"));
  EXPECT_THAT(r.out, HasSubstr("a flange that reaches 30.4 mm beyond the tread"));
  EXPECT_THAT(r.out, Not(HasSubstr("warning")));
  // the wheel of the left side
  input.edit("case.inp", "'wheel.txt'   0 ", "'wheel.txt'   1 ");
  r = run_program({"check", input.inp().string()});
  EXPECT_THAT(r.out, HasSubstr("warning   flange_side: the flange at y = 63.2 mm, on the side of great y"));
  EXPECT_THAT(run_program({"run", input.inp().string()}).err, HasSubstr("flange_side"));
}

TEST(CheckProfiles, DoubtsStayWithTheResultAndHeadItsReport) {
  SampleInput input;
  input.edit("case.inp", "'wheel.txt'   0 ", "'wheel.txt'   1 ");
  const std::string folder = (input.folder() / "out").string(), html = (input.folder() / "run.html").string();
  run_program({"run", input.inp().string(), "-o", folder, "--report", html});
  const std::string page = input.read("run.html");
  const std::size_t banner = page.find("Warning about a profile:");
  ASSERT_NE(banner, std::string::npos);
  EXPECT_THAT(page.substr(banner, 400), HasSubstr("flange_side"));
  EXPECT_LT(banner, page.find("Largest pressure"));
  const auto result = nlohmann::json::parse(input.read("out/result.json"));
  EXPECT_THAT(result["input"]["doubts"].at(0).get<std::string>(), HasSubstr("flange_side"));
  ASSERT_EQ(run_program({"report", folder, "-o", folder + "/later.html"}).status, 0);
  EXPECT_EQ(input.read("out/later.html"), page);
}

TEST(CheckProfiles, ReportHasFactsDoubtsAndPositions) {
  SampleInput input;
  input.edit("case.inp", "'wheel.txt'   0 ", "'wheel.txt'   1 ");
  const std::string html = (input.folder() / "check.html").string(), pictures = (input.folder() / "pictures").string();
  const ProgramResult r = run_program(
      {"check", input.inp().string(), (input.folder() / "rail.prr").string(), "--report", html, "-o", pictures});
  ASSERT_EQ(r.status, 1) << "doubts";
  const std::string page = input.read("check.html");
  EXPECT_THAT(page, HasSubstr("flange_side: the flange at y = 63.2 mm, on the side of great y"));
  EXPECT_THAT(page, HasSubstr("-60.00 to 70.00 mm, to the right"));
  EXPECT_THAT(page, HasSubstr("id=\"position-1-1\""));
  EXPECT_THAT(page, HasSubstr("2 cases, no errors, 1 warning"));
  EXPECT_THAT(page, HasSubstr("id=\"input-2\""));
  EXPECT_THAT(input.read("pictures/position_0001.svg"), HasSubstr("<svg"));
}

TEST(CheckProfiles, TakesAProfileByItself) {
  SampleInput input;
  const std::string wheel = (input.folder() / "wheel.txt").string();
  const ProgramResult judged = run_program({"check", wheel});
  ASSERT_EQ(judged.status, 0) << judged.err;
  EXPECT_THAT(judged.out, HasSubstr("wheel profile"));
  EXPECT_THAT(judged.out, HasSubstr("taken for a wheel by its shape"));
  EXPECT_THAT(run_program({"check", wheel, "--body", "wheel"}).out, Not(HasSubstr("taken for")));
  EXPECT_THAT(run_program({"check", (input.folder() / "rail.prr").string()}).out, HasSubstr("gauge point"));
  EXPECT_EQ(run_program({"check", wheel, "--set", "wheelset.y_mm=1"}).status, 2);
  EXPECT_EQ(run_program({"check", (input.folder() / "none.csv").string()}).status, 3);
}

TEST(ConvertProfile, PointsStayWhereTheyAre) {
  SampleInput input;
  const auto in = [&](const char* name) { return (input.folder() / name).string(); };
  const Profile rail = io::read_profile(in("rail.prr"), Body::rail, {});
  for (const char* out : {"a.prr", "a.ban", "a.csv"}) {
    const ProgramResult r = run_program({"convert", in("rail.prr"), in(out)});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(io::read_profile(in(out), Body::rail, {}).z, rail.z) << out;
  }
  const Profile wheel = io::read_profile(in("wheel.txt"), Body::wheel, {});
  ASSERT_EQ(run_program({"convert", in("case.inp"), in("b.prw")}).status, 0);
  EXPECT_EQ(io::read_profile(in("b.prw"), Body::wheel, {}).y, wheel.y);
  EXPECT_EQ(run_program({"convert", in("wheel.txt"), in("b.csv")}).status, 0);  // a wheel by its shape
  EXPECT_EQ(io::read_profile(in("b.csv"), Body::wheel, {}).y, wheel.y);
  EXPECT_EQ(run_program({"convert", in("rail.prr"), in("b.whl")}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(in("b.whl")));
}

TEST(ConvertProfile, OfTheLibraryAndOfCasesByFormula) {
  const SampleInput input;
  const auto path = [&](const char* name) { return (input.folder() / name).string(); };
  input.write("case.toml", standard_case("1.0"));
  for (const auto& [name, file, body] :
       {std::tuple{"60E1", "rail.prr", Body::rail}, {"S1002", "wheel.prw", Body::wheel}}) {
    ASSERT_EQ(run_program({"convert", name, path(file)}).status, 0) << name;
    const Profile written = io::read_profile(path(file), body, {}, {});
    ASSERT_EQ(run_program(
                  {"convert", path("case.toml"), path("of-case.csv"), "--body", body == Body::rail ? "rail" : "wheel"})
                  .status,
              0);
    EXPECT_EQ(io::read_profile(path("of-case.csv"), body, {}, {}).z.size(), written.z.size());
    // Points of the arcs themselves: none lies farther from the exact outline than its chords of 0.02 mm do.
    const Profile exact = analytic::sample_profile(StandardProfile{name}, 0.02e-3);
    ASSERT_GT(written.y.size(), 400U);
    for (std::size_t i = 0; i < written.y.size(); ++i) {
      double nearest = 1.0;
      for (std::size_t k = 0; k + 1 < exact.y.size(); ++k) {
        const Vec2 a{exact.y[k], exact.z[k]}, d = Vec2{exact.y[k + 1], exact.z[k + 1]} - a,
                                              p = Vec2{written.y[i], written.z[i]} - a;
        nearest = std::min(nearest, (p - std::clamp(p.dot(d) / d.squaredNorm(), 0.0, 1.0) * d).norm());
      }
      EXPECT_LT(nearest, 2e-8) << name << ' ' << written.y[i];
    }
  }
  EXPECT_THAT(run_program({"convert", "60E1", path("x.prw"), "--body", "wheel"}).err, HasSubstr("60E1 is a rail"));
  input.write("flat.toml", standard_case("1.0", kWheelWithFlat));
  EXPECT_THAT(run_program({"convert", path("flat.toml"), path("x.prw")}).err,
              HasSubstr("the section is not the same everywhere"));
}

TEST(ConvertProfile, DerivativesAreThoseOfTheCircle) {
  SampleInput input;
  const auto in = [&](const char* name) { return (input.folder() / name).string(); };
  const ProgramResult r = run_program({"convert", in("rail.prr"), in("a.csv"), "--derivatives"});
  ASSERT_EQ(r.status, 0) << r.err;
  std::istringstream lines(input.read("a.csv"));
  std::string line;
  std::getline(lines, line);
  int middle = 0;
  while (std::getline(lines, line)) {
    double y = 0.0, z = 0.0, s = 0.0, inclination = 0.0, curvature = 0.0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &y, &z, &s, &inclination, &curvature), 5);
    if (std::fabs(y) > 20.0) continue;
    ++middle;
    EXPECT_NEAR(inclination, std::asin(y / 300.0), 1e-4);
    EXPECT_NEAR(s, 300.0 * std::asin(y / 300.0), 1e-2);
    EXPECT_NEAR(curvature, 1.0 / 0.3, 0.1);  // the points of the file have six digits
  }
  EXPECT_GT(middle, 50);
}

TEST(ConvertProfile, SmoothingTakesNoiseAway) {
  SampleInput input;
  const auto in = [&](const char* name) { return (input.folder() / name).string(); };
  std::string text;
  for (int i = -60; i <= 60; ++i) {
    const double y = 0.6 * i, z = 300.0 - std::sqrt(9e4 - y * y);
    text += std::to_string(y) + " " + std::to_string(z + (i % 2 == 0 ? 0.02 : -0.02)) + "\n";
  }
  input.write("noisy.txt", text);
  const ProgramResult r = run_program({"convert", in("noisy.txt"), in("a.prr"), "--smooth", "20"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("rail profile, 121 points, smoothed"));
  const Profile p = io::read_profile(in("a.prr"), Body::rail, {});
  for (std::size_t i = 10; i + 10 < p.y.size(); ++i)
    EXPECT_NEAR(p.z[i], 0.3 - std::sqrt(0.09 - p.y[i] * p.y[i]), 4e-6) << i;
  EXPECT_EQ(run_program({"convert", in("noisy.txt"), in("a.ply"), "--body", "rail", "--smooth", "20"}).status, 2);
}

TEST(CheckProfiles, AMiniProfWheelAndItsFlangeBack) {
  TREADMARK_REQUIRE_SHARED();
  SampleInput input;
  std::filesystem::copy(*shared / "data/real/profiles/Car7422_0001r.whl", input.folder() / "car.whl");
  input.edit("case.inp", "'wheel.txt'   0   1.0   0.0   -1", "'car.whl'     0   1.0   0.0   0");
  ProgramResult r = run_program({"check", input.inp().string()});
  ASSERT_EQ(r.status, 1) << "doubts";
  EXPECT_THAT(r.out, HasSubstr("flange_back: the back of the flange is at y = -0."));
  input.edit("case.inp", "-70.0   460.0", "  0.0   460.0");
  r = run_program({"check", input.inp().string()});
  EXPECT_THAT(r.out, Not(HasSubstr("warning")));
}

}  // namespace
}  // namespace treadmark::testing
