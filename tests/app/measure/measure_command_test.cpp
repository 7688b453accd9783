// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include <nlohmann/json.hpp>

#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/shared_data.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
namespace fs = std::filesystem;

std::string written(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return file.string();
}

/// 50 points on each of the lines through these corners.
std::string polyline(const std::vector<std::pair<double, double>>& corners) {
  std::string text = "y_mm;z_mm\n";
  for (std::size_t k = 0; k + 1 < corners.size(); ++k)
    for (int i = k == 0 ? 0 : 1; i <= 50; ++i) {
      const auto& [y0, z0] = corners[k];
      const auto& [y1, z1] = corners[k + 1];
      text += std::to_string(y0 + (y1 - y0) * i / 50) + ";" + std::to_string(z0 + (z1 - z0) * i / 50) + "\n";
    }
  return text;
}

json measured(const std::vector<std::string>& arguments, int status = 0) {
  std::vector<std::string> all{"measure"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  all.insert(all.end(), {"--json", "-"});
  const ProgramResult r = run_program(all);
  EXPECT_EQ(r.status, status) << r.err;
  if (r.out.empty()) return {};
  json result = json::parse(r.out);
  const json schema = json::parse(app::measure_schema());
  EXPECT_EQ(first_violation(result, schema, schema), "");
  return result;
}

TEST(Measure, S1002ByItsName) {
  const json m = measured({"wheel", "S1002", "--nominal", "S1002", "--nominal-radius", "460"});
  EXPECT_NEAR(m["wheel"]["flange_height_mm"], 28.000, 5e-4);
  EXPECT_NEAR(m["wheel"]["flange_thickness_mm"], 32.500, 5e-4);
  EXPECT_NEAR(m["wheel"]["flange_gradient_mm"], 10.794, 5e-4);
  EXPECT_NEAR(m["wheel"]["diameter_mm"], 920.0, 1e-3);
  EXPECT_NEAR(m["wheel"]["diameter_lost_mm"], 0.0, 1e-3);
  EXPECT_TRUE(m["wheel"]["runout_mm"].is_null());
  EXPECT_THAT(m["wheel"]["reasons"]["runout_mm"].get<std::string>(),
              HasSubstr("needs a scan of the full circumference"));
  EXPECT_EQ(m["status"], "no limits");
}

TEST(Measure, LimitsSayWithinOutsideAndNotMeasured) {
  const TemporaryFolder folder;
  const std::string limits = written(folder.path() / "limits.toml",
                                     "[wheel]\n"
                                     "flange_height_mm = { max = 36 }\n"
                                     "flange_thickness_mm = { min = 32.6, max = 33 }\n"
                                     "runout_mm = { max = 0.3 }\n");
  const json m = measured({"wheel", "S1002", "--limits", limits});
  EXPECT_EQ(m["status"], "outside");
  EXPECT_EQ(m["limits_file"], "limits.toml");
  ASSERT_EQ(m["limits"].size(), 3U);
  EXPECT_EQ(m["limits"][0]["status"], "within");
  EXPECT_EQ(m["limits"][1]["status"], "outside");
  EXPECT_EQ(m["limits"][2]["status"], "not measured");
  const std::string wrong = written(folder.path() / "wrong.toml", "[wheel]\nflange_hight_mm = { max = 36 }\n");
  const ProgramResult r = run_program({"measure", "wheel", "S1002", "--limits", wrong});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("wrong.toml:2:1"));
  EXPECT_THAT(r.err, HasSubstr("flange_height_mm"));
}

TEST(Measure, FolderSkipsNoFileThatMayBeOfThisBody) {
  const TemporaryFolder folder;
  std::size_t ours = 0;
  for (const io::ShapeExtension& row : io::kShapeExtensions) {
    const std::string name = "a" + std::string(row.extension);
    written(folder.path() / name, "");
    ours += row.body != Body::rail && row.kinds != io::kCadFile && row.kinds != io::kSplineFile;
  }
  written(folder.path() / "readme.md", "no profile");
  const std::vector<std::string> names = app::measured_names({folder.path().string()}, Body::wheel);
  EXPECT_EQ(names.size(), ours);
  for (const char* end :
       {".pts", ".ptx", ".xyzrgb", ".xyzn", ".asc", ".laz", ".csv", ".wheel", ".slcw", ".ply", ".vdb"})
    EXPECT_THAT(names, Contains(EndsWith(end)));
  for (const char* end : {".prr", ".slcs", ".md"}) EXPECT_THAT(names, Not(Contains(EndsWith(end))));
}

TEST(Measure, ManyFilesAndOneThatIsBad) {
  const TemporaryFolder folder;
  // a wheel 1:20 with a flange of straight lines: 28 mm deep
  const std::string good = polyline({{-70, 0}, {-70, 20}, {-62, 28}, {-50, 28}, {-35, 0.75}, {60, -4}});
  const fs::path inside = folder.path() / "wheels";
  fs::create_directories(inside);
  written(inside / "a.csv", good);
  written(inside / "b.csv", "nothing\n");
  written(inside / "readme.md", "no profile");
  const std::string list = written(folder.path() / "list.txt", "# wheels\nwheels/a.csv\nS1002\n");
  const std::string csv = (folder.path() / "all.csv").string();
  const json m = measured({"wheel", inside.string(), "@" + list, "--csv", csv}, 3);
  ASSERT_EQ(m["files"].size(), 4U);
  EXPECT_EQ(m["files"][0]["status"], "no limits");
  // z = -1 on the tape line
  EXPECT_NEAR(m["files"][0]["wheel"]["flange_height_mm"], 29.0, 0.05);
  EXPECT_EQ(m["files"][1]["status"], "failed");
  EXPECT_THAT(m["files"][1]["error"].get<std::string>(), HasSubstr("b.csv"));
  EXPECT_EQ(m["files"][2]["wheel"], m["files"][0]["wheel"]);
  EXPECT_NEAR(m["files"][3]["wheel"]["flange_height_mm"], 28.0, 1e-3);
  std::ifstream table(csv);
  std::string line;
  int lines = 0;
  while (std::getline(table, line)) ++lines;
  EXPECT_EQ(lines, 5);
}

TEST(Measure, AWheelWithAFlatAndAPolygonRoundItsWhole) {
  const TemporaryFolder folder;
  const std::string wheel = written(
      folder.path() / "wheel.toml",
      "rail.shape.standard = \"60E1\"\nwheelset = { nominal_radius_mm = 460, z_mm = 0 }\n[wheel]\n"
      "shape.standard = \"S1002\"\nflats = [{ shape = \"fresh\", length_mm = 40, theta_center_deg = 30 }]\n"
      "polygonizations = [{ harmonics = [{ order = 3, amplitude_um = 20 }, { order = 20, amplitude_um = 5 }] }]\n");
  const json m = measured({"wheel", wheel, "--stations", "4"});
  const json& w = m["wheel"];
  ASSERT_EQ(w["flats"].size(), 1U);
  EXPECT_NEAR(w["flats"][0]["depth_mm"], 0.435, 0.005);  // L^2/(8 R)
  EXPECT_NEAR(w["flats"][0]["length_mm"], 40.0, 0.5);
  EXPECT_NEAR(w["flats"][0]["theta_rad"], 30.0 * 0.017453292519943295, 1e-3);
  EXPECT_NEAR(w["level_db"][1], 23.01, 0.02);
  EXPECT_NEAR(w["level_db"][18], 10.97, 0.05);
  EXPECT_NEAR(w["orders"][18]["wavelength_mm"], 144.5, 0.05);
  EXPECT_NEAR(w["flange_height_mm"], 28.0, 0.01);
  EXPECT_NEAR(w["flange_thickness_mm"], 32.5, 0.01);
  EXPECT_EQ(w["round"]["theta_rad"].size(), 4U);
}

TEST(Measure, ScatterOfAScanCountsOnce) {
  TREADMARK_NEEDS("scans");
  const TemporaryFolder folder;
  const std::string cloud = (folder.path() / "rail.xyz").string(), audit = (folder.path() / "rail.json").string();
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"scan", "60E1", "--body", "rail", "-o", cloud, "--range-mm", "0,300", "--points",
                                 "60000", "--noise-mm", "0.03"},
        {"import", cloud, "-o", (folder.path() / "rail.slcs").string(), "--json", audit, "--set",
         "placement.zero=scan"}}) {
    const ProgramResult r = run_program(command);
    ASSERT_EQ(r.status, 0) << r.err;
  }
  const json found = json::parse(std::ifstream(audit));
  // halves of the points tell all that scatter does to the fit; where the axis lies they do not
  const double error = std::hypot(1e-3 * found["fit"]["surface_errors"]["rms_um"].get<double>(),
                                  found["frame"]["axis_position_error_mm"].get<double>());
  const json m = measured({"rail", cloud});
  EXPECT_NEAR(std::stod(m["said"]["error of the fit"].get<std::string>()), error, 1e-3 * error);
}

TEST(Measure, ACorrugatedAndMilledRail) {
  const TemporaryFolder folder;
  const std::string rail =
      written(folder.path() / "rail.toml",
              "wheel.shape.standard = \"S1002\"\nwheelset = { nominal_radius_mm = 460, z_mm = 0 }\n[rail]\n"
              "shape.standard = \"54E1\"\n[[rail.corrugations]]\nx_start_mm = -5000\nx_end_mm = 5000\nramp_mm = 1\n"
              "waves = [{ wavelength_mm = 50, amplitude_um = 30 }]\n");
  const json m = measured({"rail", rail, "--nominal", "54E1", "--stations", "3"});
  const json& r = m["rail"]["roughness"];
  for (std::size_t i = 0; i < r["wavelength_m"].size(); ++i)
    if (std::fabs(r["wavelength_m"][i].get<double>() - 0.05) < 1e-9) {
      EXPECT_NEAR(r["level_db"][i], 20.0 * std::log10(30.0 / std::sqrt(2.0)), 0.3);
      EXPECT_NEAR(r["exceedance_db"][i].get<double>(), r["level_db"][i].get<double>() + 1.1, 1e-6);
    }
  EXPECT_NEAR(m["rail"]["w1_mm"], 0.0, 0.03);
  EXPECT_EQ(m["rail"]["alignment"], "none");
}

/// S1002 as an instrument writes it, y from the flange back.
std::string miniprof_text(const std::string& header, double y_of_tape, double sign, double noise_mm = 0.0) {
  std::string text = header + "\n\n";
  const Profile points = analytic::sample_profile(StandardProfile{"S1002"}, 0.3e-3);
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (std::size_t i = points.y.size(); i-- > 0;) {
    const double y = 1e3 * points.y[i] + y_of_tape + noise_mm * normal(random),
                 z = 1e3 * points.z[i] + noise_mm * normal(random);
    text += std::to_string(sign * y) + " " + std::to_string(z) + "\n";
  }
  return text;
}

TEST(Measure, AnInstrumentsOwnNumbers) {
  const TemporaryFolder folder;
  const std::string words = "Stock.......:\nCar Number..:\nAxle Number.:\nWheel ID....:\n";
  for (const std::string& header :
       {"MINIPROF 101 148 1994 3 24\navg_whl.prd\n" + words + "32.50 28.00 10.79  (Sd/Sh/qR)",
        "#MINIWHEELPROF\na.whl\nMINIPROF 2020\n" + words + "32.50 28.00 10.79\n(Sd/Sh/qR)"}) {
    const std::string file = written(folder.path() / "own.whl", miniprof_text(header, 70.0, 1.0));
    const json m = measured({"wheel", file});
    EXPECT_EQ(m["said"]["Sd Sh qR"], "32.50 28.00 10.79");
    EXPECT_NEAR(m["wheel"]["flange_thickness_mm"], 32.50, 0.01);
    EXPECT_NEAR(m["wheel"]["flange_height_mm"], 28.00, 0.01);
    EXPECT_NEAR(m["wheel"]["flange_gradient_mm"], 10.79, 0.01);
    ASSERT_EQ(m["notes"].size(), 1u) << m["notes"];
    EXPECT_NE(std::string(m["notes"][0]).find("y = 0 was put on the tape line"), std::string::npos) << m["notes"];
  }
  const std::string other = written(
      folder.path() / "other.whl",
      miniprof_text("#MINIWHEELPROF\na.whl\nMINIPROF 2020\n" + words + "32.58 37.11 14.71\n(Sd/Sh/qR)", 70.0, 1.0));
  EXPECT_THAT(measured({"wheel", other})["notes"].dump(), HasSubstr("not those of its points"));
}

/// A wheel that wobbles by 0.3 mm to both sides. Its eight sections lie in the middle of eighths of the turn.
TEST(Measure, AxialRunoutIsTheWayOfTheFlangeBack) {
  const TemporaryFolder folder;
  const Profile points = analytic::sample_profile(StandardProfile{"S1002"}, 0.3e-3);
  constexpr int kSections = 24;
  constexpr double kPi = 3.14159265358979323846;
  std::string slices = "0 1\n" + std::to_string(kSections) + "\n0 0 0\n2\n";
  for (int k = 0; k < kSections; ++k) {
    const double theta = -kPi + 2.0 * kPi * k / kSections;
    std::string text;
    for (std::size_t i = points.y.size(); i-- > 0;)
      text +=
          std::to_string(1e3 * points.y[i] + 0.3 * std::cos(theta)) + " " + std::to_string(1e3 * points.z[i]) + "\n";
    const std::string name = "section" + std::to_string(k) + ".txt";
    written(folder.path() / name, text);
    slices += std::to_string(theta) + " '" + name + "'\n";
  }
  const std::string wheel = written(folder.path() / "wobble.slcw", slices);
  const json m = measured({"wheel", wheel, "--nominal-radius", "460", "--stations", "8"});
  constexpr double kBackOfASection = 5e-3;  // [mm] between points of a section
  EXPECT_NEAR(m["wheel"]["axial_runout_mm"], 0.6 * std::cos(kPi / 8.0), 2.0 * kBackOfASection);
  for (const auto& thickness : m["wheel"]["round"]["flange_thickness_mm"])
    EXPECT_NEAR(thickness, 32.5, kBackOfASection);
  // nothing says how well slices are known
  for (const char* key : {"flange_height_mm", "flange_thickness_mm", "axial_runout_mm", "runout_mm", "diameter_mm"})
    EXPECT_TRUE(m["wheel"]["uncertainty"][key].is_null()) << key;
  EXPECT_THAT(m["notes"].dump(), HasSubstr("its numbers have no uncertainty"));
}

TEST(Measure, TwoWheelsOfAnAxle) {
  const TemporaryFolder folder;
  // tape lines 1500 mm apart: backs 1360, active faces 1425
  const std::string right = written(folder.path() / "right.txt", miniprof_text("y z", 750.0, 1.0)),
                    left = written(folder.path() / "left.txt", miniprof_text("y z", 750.0, -1.0));
  const json m = measured({"wheel", right, "--mate", left});
  EXPECT_NEAR(m["wheel"]["back_to_back_mm"], 1360.0, 1e-3);
  EXPECT_NEAR(m["wheel"]["active_faces_mm"], 1425.0, 1e-3);
  EXPECT_NEAR(measured({"wheel", left, "--mate", right, "--mirror-y"})["wheel"]["back_to_back_mm"], 1360.0, 1e-3);
  EXPECT_EQ(run_program({"measure", "wheel", right, "--mate", right}).status, 3);
  // the other wheel's points scatter, and what that leaves of its flange counts
  const std::string noisy = written(folder.path() / "noisy.txt", miniprof_text("y z", 750.0, -1.0, 0.02));
  const json both = measured({"wheel", right, "--mate", noisy})["wheel"]["uncertainty"];
  EXPECT_LT(both["flange_thickness_mm"].get<double>(), 1e-3);
  EXPECT_GT(both["active_faces_mm"].get<double>(), 5e-3);
}

/// Points of a standard rail, z up to this depth [mm].
std::string rail_text(const std::string& name, double deepest) {
  std::string text = "y;z\n";
  for (const Vec2& p : library_outline(name, 0.4e-3))
    if (1e3 * p.y() < deepest) text += std::to_string(1e3 * p.x()) + ";" + std::to_string(1e3 * p.y()) + "\n";
  return text;
}

TEST(Measure, WearAgainstAnotherRailThanTheMeasuredOneIsDoubted) {
  const json whole = measured({"rail", "54E1", "--nominal", "60E1", "--alignment", "unworn"}, 1);
  EXPECT_THAT(whole["notes"].dump(), HasSubstr("nominal_profile: what does not wear"));
  EXPECT_THAT(whole["notes"].dump(), HasSubstr("fits better"));
  EXPECT_EQ(measured({"rail", "54E1", "--nominal", "54E1", "--alignment", "unworn"})["notes"].size(), 0U);
  // of a head alone other rails' fishing surfaces and sides may fit, too: it is another one as new
  const TemporaryFolder folder;
  const std::string head = written(folder.path() / "head.csv", rail_text("54E1", 44.0));
  EXPECT_THAT(measured({"rail", head, "--nominal", "60E1"}, 1)["notes"].dump(), HasSubstr("nominal_profile"));
  EXPECT_THAT(measured({"rail", head, "--nominal", "54E1"})["notes"].dump(), Not(HasSubstr("nominal_profile")));
  // in a list
  const std::string csv = (folder.path() / "all.csv").string();
  ASSERT_EQ(run_program({"measure", "rail", head, "54E1", "--nominal", "60E1", "--csv", csv}).status, 0);
  std::ifstream table(csv);
  const std::string text((std::istreambuf_iterator<char>(table)), std::istreambuf_iterator<char>());
  EXPECT_THAT(text, StartsWith("name,kind,doubts,status,error,"));
  EXPECT_THAT(text, HasSubstr("nominal_profile"));
}

TEST(Measure, WrongBodiesAreRefusedByName) {
  ProgramResult r = run_program({"measure", "rail", "S1002"});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("S1002 is a wheel, not a rail"));
  const TemporaryFolder folder;
  std::string points;
  for (double y = -36.0; y <= 36.0; y += 0.5)
    points += std::to_string(y) + " " + std::to_string(y * y * y * y / 1e5) + "\n";
  r = run_program({"measure", "wheel", written(folder.path() / "rail.txt", points)});
  EXPECT_EQ(r.status, 3);
  EXPECT_THAT(r.err, HasSubstr("does not look like a wheel"));
  EXPECT_EQ(run_program({"measure", "wheel", "S1002", "--nominal", "S1003"}).status, 2);
}

TEST(Measure, ProfilesOfOthers) {
  TREADMARK_REQUIRE_SHARED();
  // Reference wheels of UIC 519: flanges of 28 mm.
  for (const char* name : {"RUIC519A.dat", "RUIC519B.dat", "RUIC519H.dat", "RUIC519I.dat"}) {
    const json m = measured({"wheel", (*shared / "data/geometry" / name).string()});
    EXPECT_NEAR(m["wheel"]["flange_height_mm"], 28.0, 2e-3) << name;
  }
  // Rail A is what the library calls it, to what is printed.
  const json a = measured(
      {"rail", (*shared / "data/geometry/SUIC519A.dat").string(), "--nominal", "UIC519-rail-A", "--alignment", "none"});
  EXPECT_NEAR(a["rail"]["w1_mm"], 0.0, 2e-3);
  EXPECT_NEAR(a["rail"]["w3_mm"], 0.0, 3e-3);
  // The rail of the Manchester benchmark: an older UIC 60 inclined 1:40, 7.49 mm beside the origin of its file.
  const json b = measured({"rail", (*shared / "data/contact_examples/MBench_UIC60_v3.prr").string()});
  EXPECT_GT(b["rail"]["crown_radius_mm"], 50.0);
}

}  // namespace
}  // namespace treadmark::testing
