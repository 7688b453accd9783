// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Rails that do not lie straight, from the virtual scanner to the surface: what is known of them is the layout along
// which they were scanned, whose curvature and cant are formulas.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/solvers/vehicle/track_path.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"
#include "treadmark/tests/support/file_content.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::run_program;
using Json = nlohmann::json;

const char* kRailWithSquat = R"(
[wheel]
shape.standard = "S1002"
[rail]
shape.standard = "60E1"
[[rail.squats]]
length_mm = 40
width_mm = 30
depth_mm = 0.5
[wheelset]
nominal_radius_mm = 460
vertical_force_N = 80e3
velocity_m_s = 2
vpitch_rad_s = -4.35
[discretisation]
dx_mm = 0.8
ds_mm = 0.8
)";

class ImportAlongALine : public ::testing::Test {
 protected:
  ImportAlongALine() { input.write("case.toml", kRailWithSquat); }

  std::string path(const std::string& name) const { return (input.folder() / name).string(); }
  Json json(const std::string& name) const {
    std::ifstream file(path(name));
    return Json::parse(file);
  }
  /// A circle of this radius [m] all along.
  void circle(double radius, double cant_mm) {
    input.write("line.toml", "[layout]\n[[layout.elements]]\nkind = \"curve\"\nlength_m = 100\nradius_m = " +
                                 std::to_string(radius) + "\ncant_mm = " + std::to_string(cant_mm) + "\n");
  }
  void scan(const std::string& cloud, const std::string& range_mm, const std::string& points,
            std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"scan",       path("case.toml"),
                                       "-o",         path(cloud),
                                       "--body",     "rail",
                                       "--line",     path("line.toml"),
                                       "--range-mm", range_mm,
                                       "--points",   points,
                                       "--noise-mm", "0.03",
                                       "--truth",    path(cloud + ".json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto r = run_program(arguments);
    ASSERT_EQ(r.status, 0) << r.err;
  }
  treadmark::testing::ProgramResult import(std::vector<std::string> more) const {
    more.insert(more.begin(), "import");
    return run_program(more);
  }

  treadmark::testing::SampleInput input;
};

TEST_F(ImportAlongALine, ASquatInACurveIsTheOnlyDamage) {
  for (const double radius : {300.0, -1000.0, 5000.0}) {
    circle(radius, 100.0);
    scan("rail.ply", "-2000,2000", "400000", {"--frame", "identity"});
    const auto r = import({path("rail.ply"), "-o", path("found.slcs"), "--json", path("found.json"), "--set",
                           "placement.up=[0,0,-1]", "--set", "placement.forward=[1,0,0]"});
    ASSERT_EQ(r.status, 0) << r.err;
    const Json found = json("found.json");
    EXPECT_TRUE(found["line"]["bent"].get<bool>()) << radius;
    ASSERT_EQ(found["damage"].size(), 1u) << radius;
    constexpr double kDepth = 0.03;  // as asked for [mm]
    EXPECT_NEAR(found["damage"][0]["depth_mm"].get<double>(), 0.5, kDepth) << radius;
    const vehicle::TrackPath truth(io::read_track_layout(path("line.toml")));
    for (const Json& place : found["line"]["places"]) {
      const Vec3 at(1e-3 * place["place_x_mm"].get<double>(), 1e-3 * place["place_y_mm"].get<double>(),
                    1e-3 * place["place_z_mm"].get<double>());
      const auto on = truth.locate(at, at.x());
      ASSERT_TRUE(on);
      constexpr double kAlignment = 0.2e-3;  // [m]
      EXPECT_LT(std::hypot(on->y, on->z), kAlignment) << radius << ' ' << at.transpose();
      const vehicle::PathPoint point = truth.at(on->distance);
      const double known = place["curvature_error_per_m"].get<double>(),
                   bend = point.curvature.value * std::cos(point.cant_angle.value);
      EXPECT_NEAR(place["curvature_per_m"].get<double>(), bend, std::max(0.01 * std::fabs(bend), 4.0 * known));
      EXPECT_NEAR(1e-3 * place["roll_mrad"].get<double>(), point.cant_angle.value, 1e-3);
      EXPECT_NEAR(place["gradient_mrad"].get<double>(), 0.0, 0.2);
    }
    EXPECT_THAT(r.out, HasSubstr(" 1/m, known to "));
    const Json schema = Json::parse(io::import_report_schema());
    EXPECT_EQ(treadmark::testing::first_violation(found, schema, schema), "");
    EXPECT_THAT(treadmark::testing::content_of(path("found.slcs")), HasSubstr("straightened along the rail"));
  }
}

TEST_F(ImportAlongALine, TheTruthOfACurve) {
  circle(500.0, 0.0);
  scan("rail.ply", "-1000,1000", "300000");
  const auto r = import(
      {path("rail.ply"), "-o", path("found.slcs"), "--json", path("found.json"), "--truth", path("rail.ply.json")});
  ASSERT_EQ(r.status, 0) << r.err;
  const Json truth = json("found.json")["truth"];
  constexpr double kShape = 10.0, kPlaced = 20.0;  // [um] rms
  EXPECT_LT(truth["shape"]["rms_um"].get<double>(), kShape);
  EXPECT_LT(truth["placed"]["rms_um"].get<double>(), kPlaced);
}

TEST_F(ImportAlongALine, ALayoutIsComparedWith) {
  const char* const kLayout = R"(
[layout]
[[layout.elements]]
kind = "straight"
length_m = 2
[[layout.elements]]
kind = "transition"
length_m = 4
[[layout.elements]]
kind = "curve"
length_m = 10
radius_m = RADIUS
)";
  const auto layout = [&](const std::string& radius) {
    std::string text = kLayout;
    text.replace(text.find("RADIUS"), 6, radius);
    return text;
  };
  input.write("line.toml", layout("300"));
  input.write("other.toml", layout("200"));
  input.write("left.toml", layout("-300"));
  scan("rail.ply", "0,10000", "300000", {"--frame", "random"});
  const auto off = [&](const std::string& file) {
    const auto r = import({path("rail.ply"), "-o", path("found.slcs"), "--json", path("found.json"), "--set",
                           "placement.line=" + path(file)});
    EXPECT_EQ(r.status, 0) << r.err;
    return json("found.json")["line"]["given_largest_mm"].get<double>();
  };
  EXPECT_LT(off("line.toml"), 0.2);
  EXPECT_GT(off("other.toml"), 1.0);
  EXPECT_GT(off("left.toml"), 1.0) << "a rail does not lie upside down";
  // too short
  input.write("short.toml", "[layout]\n[[layout.elements]]\nkind = \"straight\"\nlength_m = 5\n");
  const auto r = import({path("rail.ply"), "-o", path("found.slcs"), "--set", "placement.line=" + path("short.toml")});
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, HasSubstr("the layout is 5.00 m long"));
}

TEST_F(ImportAlongALine, JumpsOfAGivenLineAreNamed) {
  circle(300.0, 0.0);
  scan("rail.ply", "50,6000", "150000");  // behind the squat
  std::string track;
  for (int k = 0; k <= 12; ++k) {
    const double s = 0.5 * k, y = 300.0 * (1.0 - std::cos(s / 300.0)) + (k > 5 ? 0.7 : 0.0);
    track += std::to_string(1e3 * s) + ' ' + std::to_string(1e3 * y) + " 0\n";
  }
  input.write("track.txt", track);
  const auto r = import({path("rail.ply"), "-o", path("found.slcs"), "--unit", "mm", "--json", path("found.json"),
                         "--set", "placement.line=" + path("track.txt"), "--set", "fit.errors=false"});
  ASSERT_EQ(r.status, 0) << r.err;
  const Json found = json("found.json");
  EXPECT_THAT(found["warnings"].dump(), HasSubstr("line_jump: "));
  EXPECT_THAT(found["warnings"].dump(), ::testing::ContainsRegex("0\\.(699|7|701) m after 2\\.50 m"));
  EXPECT_TRUE(found["damage"].empty()) << "the line that is found is that of the points";
}

TEST_F(ImportAlongALine, AStraightRailStaysAsItWas) {
  circle(1e5, 0.0);  // the sagitta of 0.5 m is 0.3 um
  scan("rail.ply", "-250,250", "150000");
  for (const char* line : {"auto", "straight"}) {
    const auto r = import({path("rail.ply"), "--body", "rail", "-o", path(std::string(line) + ".ply"), "--json",
                           path(std::string(line) + ".json"), "--set", std::string("placement.line=") + line});
    ASSERT_EQ(r.status, 0) << r.err;
  }
  EXPECT_FALSE(json("auto.json")["line"]["bent"].get<bool>());
  EXPECT_TRUE(json("straight.json")["line"].is_null());
  EXPECT_EQ(treadmark::testing::content_of(path("auto.ply")), treadmark::testing::content_of(path("straight.ply")))
      << "bit by bit";
}

TEST_F(ImportAlongALine, BadInputIsNamed) {
  circle(300.0, 0.0);
  scan("rail.ply", "-300,300", "60000");
  input.write("line.txt", "0 0 0\n0 0 0\n");
  auto r = import({path("rail.ply"), "-o", path("found.slcs"), "--set", "placement.line=nothing.doc"});
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, HasSubstr("nothing.doc is no file of points"));
  r = import(
      {path("rail.ply"), "-o", path("found.slcs"), "--unit", "mm", "--set", "placement.line=" + path("line.txt")});
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, HasSubstr("line"));
  r = import({path("rail.ply"), "--body", "wheel", "-o", path("found.slcw"), "--set", "placement.line=straight"});
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, HasSubstr("placement.line"));
  r = run_program({"scan", path("case.toml"), "-o", path("w.ply"), "--body", "wheel", "--line", path("line.toml")});
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, HasSubstr("a wheel does not lie along the line"));
  r = run_program({"scan", path("case.toml"), "-o", path("r.ply"), "--body", "rail", "--range-mm", "0,500", "--line",
                   path("case.toml")});
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, HasSubstr("[layout] is missing"));
}

}  // namespace
}  // namespace treadmark::app
