// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "treadmark/app/read_surface.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/natural_view.hpp"
#include "treadmark/core/length_unit.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::run_program;
using Json = nlohmann::json;
namespace fs = std::filesystem;
constexpr double kPi = std::numbers::pi;

const char* kCase = R"(
[wheel]
shape.standard = "S1002"
[[wheel.flats]]
shape = "rounded"
length_mm = 120
depth_mm = 0.9
y_center_mm = 5
width_mm = 60
[rail]
shape.standard = "60E1"
[[rail.squats]]
length_mm = 40
width_mm = 30
depth_mm = 0.4
[track]
cant = "1:40"
[wheelset]
nominal_radius_mm = 300
vertical_force_N = 80e3
velocity_m_s = 2
vpitch_rad_s = -6.7
[discretisation]
dx_mm = 0.8
ds_mm = 0.8
)";

class ImportCommand : public ::testing::Test {
 protected:
  ImportCommand() { input.write("case.toml", kCase); }

  std::string path(const std::string& name) const { return (input.folder() / name).string(); }

  void scan(const std::string& cloud, std::vector<std::string> more) const {
    std::vector<std::string> arguments{"scan", path("case.toml"), "-o", path(cloud), "--truth", path(cloud + ".json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto r = run_program(arguments);
    ASSERT_EQ(r.status, 0) << r.err;
  }

  treadmark::testing::ProgramResult import(std::vector<std::string> more) const {
    more.insert(more.begin(), "import");
    return run_program(more);
  }

  Json json(const std::string& name) const {
    std::ifstream file(path(name));
    return Json::parse(file);
  }
  std::string bytes(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    std::ostringstream out;
    out << file.rdbuf();
    return out.str();
  }
  static Vec3 vector(const Json& list) {
    return Vec3(list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>());
  }

  /// Root mean square distance of an imported surface from the formula, natural heights over the running band.
  static double height_error(const fs::path& file, const SurfaceSpec& truth, double y_min, double y_max, double u_min,
                             double u_max, double truth_u = 0.0) {
    io::SurfaceSource source;
    source.geometry = io::GeometryFile{file, {}};
    const NaturalSurface found = read_surface(source, truth.body, truth.nominal_radius),
                         formula = create_natural(truth);
    double sum = 0.0, n = 0.0;
    std::vector<double> y, a, b;
    for (double at = y_min; at <= y_max; at += 0.77e-3) y.push_back(at);
    a.resize(y.size());
    b.resize(y.size());
    for (int k = 0; k < 200; ++k) {
      const double u = u_min + (u_max - u_min) * (k + 0.4) / 200.0;
      HeightsOut out;
      out.z = a;
      section_heights(*found.surface, truth.body, u, y, out);
      out.z = b;
      section_heights(*formula.surface, truth.body, u + truth_u, y, out);
      for (std::size_t i = 0; i < y.size(); ++i) {
        EXPECT_FALSE(std::isnan(a[i])) << "u " << u << " y " << y[i];
        sum += (a[i] - b[i]) * (a[i] - b[i]);
        n += 1.0;
      }
    }
    return std::sqrt(sum / n);
  }

  static SurfaceSpec wheel() {
    return {Body::wheel,
            0.3,
            StandardProfile{"S1002"},
            {.flats = {{.length = 0.12, .depth = 0.9e-3, .y_center = 5e-3, .width = 60e-3}}}};
  }
  static SurfaceSpec rail() {
    return {Body::rail, 0.0, StandardProfile{"60E1"}, {.squats = {{.length = 40e-3, .width = 30e-3, .depth = 0.4e-3}}}};
  }

  treadmark::testing::SampleInput input;
};

TEST_F(ImportCommand, WheelWithAFlatFromADirtyScanInEveryBackend) {
  scan("wheel.ply", {"--body", "wheel", "--points", "400000", "--noise-mm", "0.03", "--outliers", "0.01", "--holes",
                     "0.02", "--frame", "random", "--seed", "11"});
  const auto r = import({path("wheel.ply"), "-o", path("found.slcw"), "-o", path("found.ply"), "-o", path("found.vdb"),
                         "--resolution", "1.5", "--report", path("audit"), "--json", path("found.json")});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("unit of the file: mm"));
  const Json found = json("found.json"), truth = json("wheel.ply.json")["surface_in_cloud"];
  // axis, radius and place across: to a tenth of what is asked of a good scan
  const Vec3 axis = vector(found["frame"]["y_axis"]), true_axis = vector(truth["y_axis"]);
  EXPECT_LT(axis.cross(true_axis).norm(), 20e-6);
  EXPECT_GT(axis.dot(true_axis), 0.0);
  const Vec3 apart = vector(found["frame"]["origin_mm"]) - vector(truth["origin_mm"]);
  EXPECT_LT(apart.norm(), 0.01);
  EXPECT_NEAR(found["frame"]["nominal_radius_mm"].get<double>(), 300.0, 0.011);
  // the flat's middle is theta = 0 in the scan and in truth
  const Vec3 z = vector(found["frame"]["z_axis"]), true_z = vector(truth["z_axis"]);
  EXPECT_LT(std::acos(std::min(1.0, z.dot(true_z))) * 300.0, 0.3) << "mm along the circumference";
  EXPECT_NEAR(found["noise_mm"].get<double>(), 0.03, 0.002);
  ASSERT_FALSE(found["damage"].empty());
  EXPECT_NEAR(found["damage"][0]["depth_mm"].get<double>(), 0.9, 0.01);
  EXPECT_NEAR(found["damage"][0]["y_mm"].get<double>(), 5.0, 0.5);
  std::size_t removed = found["points_read"].get<std::size_t>() - found["points_used"].get<std::size_t>(), listed = 0;
  for (const auto& [reason, count] : found["removed"].items()) listed += count.get<std::size_t>();
  EXPECT_EQ(removed, listed) << "every point that is missing has a reason";
  SurfaceSpec truth_spec = wheel();
  truth_spec.nominal_radius = 1e-3 * found["frame"]["nominal_radius_mm"].get<double>();
  // heights are asked for to 15 um; the noise leaves a few
  for (const char* file : {"found.slcw", "found.ply", "found.vdb"}) {
    SurfaceSpec same = wheel();
    same.nominal_radius = truth_spec.nominal_radius;
    EXPECT_LT(height_error(path(file), same, -30e-3, 55e-3, -kPi, kPi), 15e-6) << file;
  }
  std::ifstream schema_file(fs::path(TREADMARK_SOURCE_DIR) / "docs" / "import.schema.json");
  const Json schema = Json::parse(schema_file);
  EXPECT_EQ(treadmark::testing::first_violation(found, schema, schema), "");
  for (const char* file : {"report.json", "times.json", "summary.txt", "settings.toml", "before.svg", "removed.svg",
                           "fitted.svg", "residual.svg"})
    EXPECT_TRUE(fs::exists(fs::path(path("audit")) / file)) << file;
  EXPECT_THAT(bytes("found.slcw"), HasSubstr("SHA-256")) << "the surface carries a summary";
  EXPECT_THAT(bytes("found.ply").substr(0, 2000), HasSubstr("comment from wheel.ply"));
}

TEST_F(ImportCommand, RailFromThreePassesInMetres) {
  scan("rail.xyz",
       {"--body",     "rail",   "--range-mm", "-100,100", "--points",          "150000", "--noise-mm", "0.02",
        "--outliers", "0.01",   "--passes",   "3",        "--registration-mm", "0.15",   "--unit",     "m",
        "--frame",    "random", "--seed",     "5"});
  const auto r = import({path("rail.xyz"), "-o", path("found.slcs"), "--json", path("found.json")});
  ASSERT_EQ(r.status, 0) << r.err;
  const Json found = json("found.json");
  EXPECT_EQ(found["unit"], "m");
  EXPECT_EQ(found["frame"]["passes"].size(), 3u);
  EXPECT_GT(found["frame"]["pass_distance_before_mm"].get<double>(), 0.05);
  EXPECT_LT(found["frame"]["pass_distance_after_mm"].get<double>(), 0.015);
  EXPECT_NEAR(found["noise_mm"].get<double>(), 0.02, 0.002);
  ASSERT_FALSE(found["damage"].empty());
  EXPECT_NEAR(found["damage"][0]["depth_mm"].get<double>(), 0.4, 0.02);
  // x = 0 is the middle of the squat; which end is forward follows the scan's axes, and the squat is symmetric
  EXPECT_LT(height_error(path("found.slcs"), rail(), -25e-3, 25e-3, -60e-3, 60e-3), 30e-6);
}

TEST_F(ImportCommand, TheSameInputGivesTheSameBytes) {
  scan("wheel.ply", {"--body", "wheel", "--range-deg", "-40,40", "--points", "60000", "--noise-mm", "0.03",
                     "--outliers", "0.01", "--frame", "random"});
  for (const char* threads : {"1", "2"}) {
    const std::string n = threads;
    const auto r = import({path("wheel.ply"), "-o", path("same" + n + ".ply"), "--body", "wheel", "--resolution", "1",
                           "--report", path("audit" + n), "--threads", n});
    ASSERT_EQ(r.status, 0) << r.err;
  }
  EXPECT_EQ(bytes("same1.ply"), bytes("same2.ply"));
  for (const char* file : {"fitted.svg", "residual.svg", "before.svg", "removed.svg", "settings.toml"})
    EXPECT_EQ(bytes("audit1/" + std::string(file)), bytes("audit2/" + std::string(file))) << file;
}

TEST_F(ImportCommand, MapOfDeviationsOverTheNominalProfile) {
  // a dent of 0.3 mm in a rail, positive = material gone
  std::ofstream map(path("map.csv"));
  map << "x";
  for (int y = -25; y <= 25; ++y) map << ',' << y;
  map << '\n';
  for (int x = 0; x <= 120; ++x) {
    map << x;
    for (int y = -25; y <= 25; ++y) map << ',' << 0.3 * std::exp(-((x - 60.0) * (x - 60.0) + y * y) / 200.0);
    map << '\n';
  }
  map.close();
  const auto r = import({path("map.csv"), "--body", "rail", "-o", path("found.slcs"), "--set", "placement.zero=scan",
                         "--json", path("found.json")});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(json("found.json")["from_map"].get<bool>());
  io::SurfaceSource source;
  source.geometry = io::GeometryFile{path("found.slcs"), {}};
  const NaturalSurface found = read_surface(source, Body::rail, 0.0),
                       nominal = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}});
  for (const double x : {30.0, 52.0, 60.0, 71.0})
    for (const double y : {-9.0, 0.0, 6.0}) {
      std::vector<double> at{1e-3 * y}, a(1), b(1);
      HeightsOut out;
      out.z = a;
      section_heights(*found.surface, Body::rail, 1e-3 * x, at, out);
      out.z = b;
      section_heights(*nominal.surface, Body::rail, 0.0, at, out);
      EXPECT_NEAR(a[0] - b[0], 0.3e-3 * std::exp(-((x - 60.0) * (x - 60.0) + y * y) / 200.0), 2e-6) << x << ' ' << y;
    }
}

TEST_F(ImportCommand, RefusesWhatIsNoWheelOrRail) {
  std::ofstream random(path("random.xyz"));
  unsigned state = 1;
  const auto number = [&] {
    state = state * 1664525u + 1013904223u;
    return 1000.0 * (state >> 8) / 16777216.0;
  };
  for (int k = 0; k < 20000; ++k) {
    const double x = number(), y = number(), z = number();
    random << x << ' ' << y << ' ' << z << '\n';
  }
  random.close();
  scan("rail.ply", {"--body", "rail", "--range-mm", "-100,100", "--points", "60000"});
  scan("wheel.ply", {"--body", "wheel", "--points", "100000", "--unit", "mm"});
  struct Refusal {
    std::vector<std::string> arguments;
    const char* words;
  };
  for (const Refusal& refusal :
       {Refusal{{path("random.xyz"), "-o", path("x.slcw")}, "do not form a surface"},
        Refusal{{path("rail.ply"), "-o", path("x.slcw")}, "rail.ply"},
        Refusal{{path("wheel.ply"), "-o", path("x.slcs")}, "wheel.ply"},
        Refusal{{path("wheel.ply"), "-o", path("x.slcw"), "--unit", "m"}, "with --unit mm it fits"},
        Refusal{{path("missing.ply"), "-o", path("x.slcw")}, "does not exist"}}) {
    const auto r = import(refusal.arguments);
    EXPECT_EQ(r.status, 3) << refusal.words << r.err;
    EXPECT_THAT(r.err, HasSubstr(refusal.words));
    EXPECT_FALSE(fs::exists(path("x.slcw")) || fs::exists(path("x.slcs")));
  }
  for (const Refusal& refusal :
       {Refusal{{path("wheel.ply")}, "nothing to write"},
        Refusal{{path("wheel.ply"), "-o", path("x.foo"), "--body", "wheel"}, "cannot be written"},
        Refusal{{path("wheel.ply"), "-o", path("x.ply")}, "--body"},
        Refusal{{path("wheel.ply"), "-o", path("wheel.ply"), "--body", "wheel"}, "overwrite"},
        Refusal{{path("wheel.ply"), "-o", path("x.slcw"), "--set", "fit.finst_mm=1"}, "fit.finest_mm"},
        Refusal{{}, "no scan"}}) {
    const auto r = import(refusal.arguments);
    EXPECT_EQ(r.status, 2) << refusal.words << r.err;
    EXPECT_THAT(r.err, HasSubstr(refusal.words));
  }
}

TEST_F(ImportCommand, HolesBeyondTheLimitStayOpenInTrianglesAndAreRefusedElsewhere) {
  scan("rail.ply", {"--body", "rail", "--range-mm", "-50,50", "--points", "40000", "--holes", "0.1", "--hole-size-mm",
                    "24", "--seed", "3"});
  const auto refused = import({path("rail.ply"), "-o", path("found.slcs")});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("cannot leave out a hole"));
  EXPECT_THAT(refused.err, HasSubstr("clean.hole_limit_mm="));
  EXPECT_EQ(import({path("rail.ply"), "--body", "rail", "-o", path("found.ply")}).status, 0);
  EXPECT_EQ(import({path("rail.ply"), "-o", path("found.slcs"), "--set", "clean.hole_limit_mm=40"}).status, 0);
}

TEST_F(ImportCommand, ListsSettingsThatItReadsBack) {
  const auto listed = import({"--list-settings", "--set", "fit.significance=2.5"});
  ASSERT_EQ(listed.status, 0) << listed.err;
  input.write("settings.toml", listed.out.c_str());
  const auto again = import({"--list-settings", "--settings", path("settings.toml")});
  EXPECT_EQ(listed.out, again.out);
  EXPECT_THAT(again.out, HasSubstr("significance = 2.5"));
}

}  // namespace
}  // namespace treadmark::app
