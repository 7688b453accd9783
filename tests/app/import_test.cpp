// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/model/shape/length_unit.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::run_program;
using Json = nlohmann::json;
namespace fs = std::filesystem;
constexpr double kPi = std::numbers::pi;

const char* kScannedCase = R"(
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
  ImportCommand() { input.write("case.toml", kScannedCase); }

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
  std::string bytes(const std::string& name) const { return treadmark::testing::content_of(path(name)); }
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
  const Json schema = Json::parse(io::import_report_schema());
  EXPECT_EQ(treadmark::testing::first_violation(found, schema, schema), "");
  for (const char* file : {"report.json", "times.json", "summary.txt", "settings.toml", "before.svg", "removed.svg",
                           "fitted.svg", "residual.svg", "maps.h5"})
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
  for (const char* file : {"fitted.svg", "residual.svg", "before.svg", "removed.svg", "settings.toml", "maps.h5"})
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
  TREADMARK_NEEDS("cgal");
  scan("rail.ply", {"--body", "rail", "--range-mm", "-50,50", "--points", "40000", "--holes", "0.1", "--hole-size-mm",
                    "24", "--seed", "3"});
  const auto refused = import({path("rail.ply"), "-o", path("found.slcs")});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("cannot leave out a hole"));
  EXPECT_THAT(refused.err, HasSubstr("clean.hole_limit_mm="));
  EXPECT_EQ(import({path("rail.ply"), "--body", "rail", "-o", path("found.ply")}).status, 0);
  EXPECT_EQ(import({path("rail.ply"), "-o", path("found.slcs"), "--set", "clean.hole_limit_mm=40"}).status, 0);
}

/// Sections of the flat wheel at 1 degree, rough by 3 um, as a gauge writes them; outside mm, in a turned frame.
void write_sections(const fs::path& file, const SurfaceSpec& spec, double rough) {
  const NaturalSurface wheel = create_natural(spec);
  std::ofstream out(file);
  out.precision(9);
  std::vector<double> y, r;
  for (int mm = 30; mm >= -30; --mm) y.push_back(1e-3 * mm);
  r.resize(y.size());
  const Mat3 turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  int k = 0;
  for (int degree = 0; degree < 360; ++degree) {
    const double u = wrap_angle(kPi / 180.0 * degree);
    HeightsOut heights;
    heights.z = r;
    section_heights(*wheel.surface, Body::wheel, u, y, heights);
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double at = r[i] + rough * ((k++ * 7 % 11) / 5.0 - 1.0);
      const Vec3 p = 1e3 * (turn * Vec3(at * std::sin(u), y[i], at * std::cos(u)) + Vec3(0.1, 0.2, 0.3));
      out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
  }
}

TEST_F(ImportCommand, SectionsThatSomebodyResampledAreSlices) {
  write_sections(input.folder() / "gauge.xyz", wheel(), 3e-6);
  const auto r = import({path("gauge.xyz"), "-o", path("kept.slcw"), "-o", path("kept.vdb"), "--json",
                         path("kept.json"), "--set", "clean.strays=false"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("360 of 61 points"));
  const Json kept = json("kept.json");
  EXPECT_EQ(kept["fit"]["kept_sections"]["count"], 360);
  EXPECT_EQ(kept["points_used"], 360 * 61);
  EXPECT_NEAR(kept["fit"]["kept_sections"]["least_gap_mm"].get<double>(), 300.0 * kPi / 180.0, 0.01);
  EXPECT_LT(kept["outputs"][0]["height_max_um"].get<double>(), 1e-3);
  io::SurfaceSource source;
  source.geometry = io::GeometryFile{path("kept.slcw"), {}};
  const NaturalSurface back = read_surface(source, Body::wheel, 0.3);
  const auto& slices = std::get<SliceSet>(back.spec.shape);
  EXPECT_EQ(slices.u.size(), 360u);
  EXPECT_EQ(slices.profiles.front().y.size(), 61u);
  EXPECT_TRUE(slices.approximate_u);
  // rough by 1.9 um (rms): smoothed, and results know what that leaves
  EXPECT_NEAR(kept["fit"]["kept_sections"]["smoothed_um"].get<double>(), 1.7, 0.5);
  EXPECT_GT(kept["fit"]["surface_errors"]["rms_um"].get<double>(), 0.2);
  ASSERT_NE(back.spec.errors, nullptr);
  // exact points stay where they are, as they all do if that is wanted; between some that are 1 mm apart the curve is
  // known less well
  write_sections(input.folder() / "exact.xyz", wheel(), 0.0);
  std::vector<std::string> written;
  for (const char* smoothing : {"auto", "none"}) {
    const auto exact = import({path("exact.xyz"), "-o", path("exact.slcw"), "--json", path("exact.json"), "--set",
                               std::string("fit.smoothing=") + smoothing, "--set", "clean.strays=false"});
    ASSERT_EQ(exact.status, 0) << exact.err;
    EXPECT_FALSE(json("exact.json")["fit"]["kept_sections"].contains("smoothed_um"));
    const Json errors = json("exact.json")["fit"]["surface_errors"];
    if (std::string(smoothing) == "none")
      EXPECT_TRUE(errors.is_null());
    else
      EXPECT_LT(errors["rms_um"].get<double>(), 0.1);
    std::istringstream lines(bytes("exact.slcw"));
    std::string slices_alone;
    for (std::string line; std::getline(lines, line);)
      if (!line.starts_with('%')) slices_alone += line + '\n';
    written.push_back(slices_alone);
  }
  EXPECT_EQ(written[0], written[1]) << "with the check sum of all slices in the name of their folder";
  // fitted if that is wanted, and other settings that have no meaning are refused
  const auto fitted = import({path("gauge.xyz"), "-o", path("fit.slcw"), "--json", path("fit.json"), "--set",
                              "fit.sections=fit", "--set", "clean.strays=false"});
  ASSERT_EQ(fitted.status, 0) << fitted.err;
  EXPECT_TRUE(json("fit.json")["fit"]["kept_sections"].is_null());
  scan("lines.xyz", {"--body", "wheel", "--points", "60000"});
  const auto none = import({path("lines.xyz"), "-o", path("no.slcw"), "--set", "fit.sections=keep"});
  EXPECT_EQ(none.status, 0) << none.err;
  const auto up = import({path("lines.xyz"), "-o", path("no.slcw"), "--set", "placement.up=[0,0,1]"});
  EXPECT_EQ(up.status, 2);
  EXPECT_THAT(up.err, HasSubstr("placement.up would be ignored"));
}

TEST_F(ImportCommand, TheMeasuredFlatComesBackWithItsContactResults) {
  TREADMARK_REQUIRE_SHARED();
  const fs::path folder = *shared / "data/contact_examples";
  io::SurfaceSource source;
  source.geometry = io::GeometryFile{folder / "S1002_flat.slcw", {}};
  const NaturalSurface wheel = read_surface(source, Body::wheel, 0.49);
  const auto& slices = std::get<SliceSet>(wheel.spec.shape);
  const Mat3 turn(Eigen::AngleAxisd(2.1, Vec3(3, -1, 2).normalized()));
  {
    std::ofstream out(path("flat.xyz"));
    out.precision(9);
    for (std::size_t k = 0; k < slices.u.size(); ++k)
      for (std::size_t i = 0; i < slices.profiles[k].y.size(); ++i) {
        const double r = 0.49 + slices.profiles[k].z[i], u = slices.u[k];
        const Vec3 p =
            1e3 * (turn * Vec3(r * std::sin(u), slices.profiles[k].y[i], r * std::cos(u)) + Vec3(0.5, -0.2, 0.1));
        out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
      }
  }
  const Vec3 zero = turn * Vec3::UnitZ();
  std::ostringstream direction;
  direction.precision(12);
  direction << "placement.zero_direction=[" << zero.x() << ", " << zero.y() << ", " << zero.z() << "]";
  const auto r = import({path("flat.xyz"), "-o", path("flat.slcw"), "--set", "placement.zero=direction", "--set",
                         direction.str(), "--set", "fit.smoothing=none", "--json", path("flat.json")});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(json("flat.json")["frame"]["nominal_radius_mm"].get<double>(), 490.0, 0.03);
  const auto results = [&](const std::string& wheel_file, const std::string& name) {
    std::string all = treadmark::testing::content_of(folder / "wheelflat.inp");
    const auto replace = [&](const std::string& what, const std::string& by) {
      const std::size_t at = all.find(what);
      ASSERT_NE(at, std::string::npos);
      all.replace(at, what.size(), by);
    };
    replace("S1002_flat.slcw", wheel_file);
    replace("r300_wide.prr", (folder / "r300_wide.prr").string());
    input.write(name + ".inp", all);
    const auto run = run_program({"run", path(name + ".inp"), "--json", path(name + ".json")});
    EXPECT_EQ(run.status, 0) << run.err;
    return json(name + ".json");
  };
  const Json direct = results((folder / "S1002_flat.slcw").string(), "direct"),
             imported = results("flat.slcw", "imported");
  ASSERT_EQ(direct["cases"].size(), imported["cases"].size());
  for (std::size_t k = 0; k < direct["cases"].size(); ++k) {
    const Json &a = direct["cases"][k]["patches"], &b = imported["cases"][k]["patches"];
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (const char* what : {"pmax_MPa", "fn_N"})
        EXPECT_NEAR(b[i][what].get<double>() / a[i][what].get<double>(), 1.0, 2e-3) << what << " case " << k;
      for (const char* what : {"x_tr_mm", "y_tr_mm"})
        EXPECT_NEAR(b[i]["reference"][what].get<double>(), a[i]["reference"][what].get<double>(), 0.02)
            << what << " case " << k;
    }
  }
}

TEST_F(ImportCommand, OnATerminalStepsAndFilesAreToldWithoutAGuessOfTheRest) {
  if (std::system("command -v script > /dev/null") != 0)
    GTEST_SKIP() << "needs script (bsdutils), which lends a terminal";
  scan("wheel.ply", {"--body", "wheel", "--range-deg", "-60,60", "--points", "20000"});
  const std::string command = fmt::format("script -qec \"{} import {} -o {}\" {} > /dev/null 2>&1", TREADMARK_PROGRAM,
                                          path("wheel.ply"), path("wheel.slcw"), path("seen.txt"));
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string seen = bytes("seen.txt");
  EXPECT_THAT(seen, HasSubstr("step 1 of 9: reading, 0 s so far"));
  EXPECT_THAT(seen, HasSubstr("step 9 of 9: writing wheel.slcw, "));
  EXPECT_THAT(seen, ::testing::Not(HasSubstr("left")));
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
