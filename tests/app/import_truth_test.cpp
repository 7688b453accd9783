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
#include <string>
#include <tuple>
#include <vector>

#include "treadmark/app/import/import_scan.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::app {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using treadmark::testing::run_program;
using Json = nlohmann::json;
namespace fs = std::filesystem;

/// A rail with one squat of 0.4 mm, whose middle lies at x = 120 mm.
const char* kRail = R"(
[wheel]
shape.standard = "S1002"
[rail]
shape.standard = "60E1"
[[rail.squats]]
x_center_mm = 120
length_mm = 60
width_mm = 40
depth_mm = 0.4
[track]
cant = "1:40"
[wheelset]
nominal_radius_mm = 460
vertical_force_N = 80e3
)";

constexpr double kBump = 0.25, kWidth = 8.0;  // height and standard deviation of a bump on a rail [mm]

class ImportTruth : public ::testing::Test {
 protected:
  ImportTruth() { input_.write("rail.toml", kRail); }

  std::string path(const std::string& name) const { return (input_.folder() / name).string(); }

  void scan(const std::string& surface, const std::string& cloud, std::vector<std::string> more) const {
    std::vector<std::string> arguments{"scan",   surface, "-o", path(cloud), "--truth", path(cloud + ".json"),
                                       "--body", "rail"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto r = run_program(arguments);
    ASSERT_EQ(r.status, 0) << r.err;
  }

  /// Of an import of a rail, as JSON.
  Json import(const std::string& cloud, std::vector<std::string> more) const {
    std::vector<std::string> arguments{"import", path(cloud), "-o", path("found.slcs"), "--json", path("found.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto r = run_program(arguments);
    EXPECT_EQ(r.status, 0) << r.err;
    return json("found.json");
  }

  Json json(const std::string& name) const {
    std::ifstream file(path(name));
    return Json::parse(file);
  }

  /// A rail of 60E1, 400 mm long, with a bump at x = -50, y = 5 mm.
  void write_bump(const std::string& name) const {
    scan("60E1", "plain.xyz", {"--range-mm", "-200,200", "--range-y-mm", "-34,34", "--points", "120000"});
    std::ifstream in(path("plain.xyz"));
    std::ofstream out(path(name));
    std::string line;
    while (std::getline(in, line)) {
      double x = 0.0, y = 0.0, z = 0.0;
      if (std::sscanf(line.c_str(), "%lf %lf %lf", &x, &y, &z) != 3) continue;
      const double off = std::hypot(x + 50.0, y - 5.0) / kWidth;
      out << fmt::format("{:.6f} {:.6f} {:.6f}\n", x, y, z - kBump * std::exp(-0.5 * off * off));
    }
  }

  treadmark::testing::SampleInput input_;
};

TEST_F(ImportTruth, ABumpOnAPlainRailIsTheError) {
  write_bump("bump.xyz");
  const Json found = import("bump.xyz", {"--unit", "mm", "--truth", "60E1", "--set", "placement.zero=scan"});
  const Json& truth = found.at("truth");
  EXPECT_FALSE(truth.at("from_scan").get<bool>());
  EXPECT_NEAR(truth.at("placed").at("largest_um").get<double>(), 1e3 * kBump, 0.02e3 * kBump);
  // least squares give the bump a little of the rest
  EXPECT_NEAR(truth.at("shape").at("largest_um").get<double>(), 1e3 * kBump, 0.04e3 * kBump);
  // the volume of the bump over the area compared; the rest of the rail is without error
  const Json& y = found.at("range").at("y_mm");
  const double length = 400.0, width = y.at(1).get<double>() - y.at(0).get<double>();
  ASSERT_GT(width, 60.0);
  const double volume = 2.0 * std::numbers::pi * kWidth * kWidth * kBump;
  EXPECT_NEAR(truth.at("placed").at("mean_um").get<double>(), 1e3 * volume / (length * width), 1.0);
  const Json& residuals = found.at("fit").at("residuals");
  std::size_t counted = residuals.at("below").get<std::size_t>() + residuals.at("above").get<std::size_t>();
  for (const Json& count : found.at("fit").at("histogram")) counted += count.get<std::size_t>();
  EXPECT_EQ(counted, found.at("points_used").get<std::size_t>());
}

TEST_F(ImportTruth, TheCloudIsSampledWithItsDistances) {
  TREADMARK_NEEDS("hdf5");
  write_bump("bump.xyz");
  const Json found = import("bump.xyz", {"--unit", "mm", "--set", "placement.zero=scan", "--report", path("audit")});
  const io::ImportReport report = io::read_import_report(path("audit"));
  const auto& cloud = report.cloud;
  EXPECT_EQ(cloud.all, found.at("points_read").get<std::size_t>());
  std::size_t used = 0, on_bump = 0;
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    if (std::isnan(cloud.residual[i])) continue;
    ++used;
    const double off = 1e3 * std::hypot(cloud.x[i] + 50e-3, cloud.y[i] - 5e-3) / kWidth;
    if (off > 4.0) continue;
    ++on_bump;
    EXPECT_NEAR(1e3 * cloud.distance[i], kBump * std::exp(-0.5 * off * off), 0.05 * kBump);
    EXPECT_LT(std::fabs(cloud.residual[i]), 5e-6);
  }
  EXPECT_LE(used, 80'000u);
  EXPECT_GT(used, 40'000u);
  EXPECT_GT(on_bump, 1000u);
}

TEST_F(ImportTruth, AScanTellsWhereItsSurfaceLies) {
  scan(path("rail.toml"), "rail.ply",
       {"--range-mm", "-200,300", "--points", "200000", "--noise-mm", "0.01", "--frame", "random", "--seed", "3"});
  const Json found = import("rail.ply", {"--truth", path("rail.ply.json")});
  const Json& truth = found.at("truth");
  EXPECT_TRUE(truth.at("from_scan").get<bool>());
  EXPECT_THAT(found.at("warnings"), IsEmpty());
  const double rms = truth.at("shape").at("rms_um").get<double>();
  EXPECT_LT(rms, 2.0);
  EXPECT_GT(rms, 0.05);  // noise leaves something
  EXPECT_LE(rms, truth.at("placed").at("rms_um").get<double>());
  EXPECT_NEAR(truth.at("along_mm").get<double>(), 120.0, 1.0);  // the squat, where the import has its zero

  // a scan whose truth is 3 mm off along the rail: all of it is a shift
  Json moved = json("rail.ply.json");
  for (int i = 0; i < 3; ++i) {
    Json& row = moved["surface_in_cloud"]["rows_mm"][static_cast<std::size_t>(i)];
    row[3] = row[3].get<double>() + 3.0 * row[0].get<double>();
  }
  input_.write("moved.json", moved.dump().c_str());
  const Json off = import("rail.ply", {"--truth", path("moved.json")}).at("truth");
  EXPECT_GT(off.at("placed").at("rms_um").get<double>(), 5.0 * rms);
  EXPECT_NEAR(off.at("shape").at("rms_um").get<double>(), rms, 0.05 * rms);
  EXPECT_NEAR(std::fabs(off.at("shift_um").at(0).get<double>()), 3000.0, 50.0);
}

TEST_F(ImportTruth, ASurfaceIsFoundAlongTheBandByItsDamage) {
  scan(path("rail.toml"), "rail.ply", {"--range-mm", "-200,300", "--points", "200000", "--noise-mm", "0.01"});
  const Json truth = import("rail.ply", {"--truth", path("rail.toml")}).at("truth");
  EXPECT_NEAR(truth.at("along_mm").get<double>(), 120.0, 1.0);
  EXPECT_LT(truth.at("shape").at("rms_um").get<double>(), 2.0);
}

TEST_F(ImportTruth, WhatIsOffAsAWholeIsNoErrorOfShape) {
  constexpr double kAside = 0.05, kLower = 0.03;  // of the truth [mm]
  scan("60E1", "rail.ply", {"--range-mm", "0,300", "--points", "100000", "--range-y-mm", "-34,34"});
  const NaturalSurface nominal = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}});
  std::string profile;
  for (int i = -350; i <= 350; ++i) {
    const std::vector<double> y{1e-4 * i};
    std::vector<double> z(1);
    HeightsOut out;
    out.z = z;
    section_heights(*nominal.surface, Body::rail, 0.0, y, out);
    profile += fmt::format("{:.6f} {:.6f}\n", 0.1 * i + kAside, 1e3 * z[0] + kLower);
  }
  input_.write("truth.txt", profile.c_str());
  const Json truth = import("rail.ply", {"--truth", path("truth.txt")}).at("truth");
  EXPECT_NEAR(truth.at("shift_um").at(1).get<double>(), 1e3 * kAside, 1.0);
  EXPECT_NEAR(truth.at("shift_um").at(2).get<double>(), 1e3 * kLower, 1.0);
  EXPECT_LT(truth.at("shape").at("rms_um").get<double>(), 1.0);
  EXPECT_GT(truth.at("placed").at("rms_um").get<double>(), 25.0);
}

TEST_F(ImportTruth, RefusesWhatCannotBeTheTruthBeforeTheWork) {
  scan(path("rail.toml"), "rail.ply", {"--range-mm", "0,300", "--points", "30000"});
  scan(path("rail.toml"), "other.ply", {"--range-mm", "0,300", "--points", "40000"});
  input_.write("changed.toml", kRail);
  scan(path("changed.toml"), "changed.ply", {"--range-mm", "0,300", "--points", "30000"});
  input_.write("changed.toml", (std::string(kRail) + "# a word more\n").c_str());
  Json wheel = json("rail.ply.json");
  wheel["surface"]["body"] = "wheel";
  input_.write("wheel.json", wheel.dump().c_str());
  Json gone = json("rail.ply.json");
  gone["surface"]["file"] = "gone.toml";
  input_.write("gone.json", gone.dump().c_str());
  Json bent = json("rail.ply.json");
  bent["surface_in_cloud"]["rows_mm"][0][0] = 2.0;
  input_.write("bent.json", bent.dump().c_str());
  input_.write("result.json", "{\"cases\": []}");
  input_.write("broken.json", "{\"surface\": ");
  input_.write("wheel.slcw", "");
  for (const auto& [truth, words] : std::vector<std::pair<std::string, std::string>>{
           {path("none.slcs"), "there is no such file of the reference"},
           {path("none.json"), "none.json"},
           {path("broken.json"), "broken.json"},
           {path("result.json"), "this is not what treadmark scan --truth writes: no \"surface\""},
           {path("wheel.json"), "the reference is a wheel, the scan shall become a rail"},
           {path("wheel.slcw"), "the reference is a wheel, the scan shall become a rail"},
           {"S1002", "the reference is a wheel, the scan shall become a rail"},
           {path("gone.json"), "the surface that was scanned is not there: gone.toml"},
           {path("bent.json"), "is no rotation and origin"},
           {path("changed.ply.json"), "the surface has changed since it was scanned"},
           {path("other.ply.json"), "the reference is that of a cloud of"}}) {
    const auto r = run_program({"import", path("rail.ply"), "-o", path("found.slcs"), "--truth", truth});
    EXPECT_THAT(r.status, AnyOf(2, 3)) << truth << r.out;  // configuration, input data
    EXPECT_THAT(r.err, HasSubstr(words)) << truth;
    EXPECT_FALSE(fs::exists(path("found.slcs"))) << truth;
  }
}

TEST_F(ImportTruth, ATruthOfSomethingElseIsAWarning) {
  scan("60E1", "rail.ply", {"--range-mm", "0,300", "--points", "60000"});
  std::string flat;  // a bar without a crown
  for (int i = -35; i <= 35; ++i) flat += fmt::format("{} {}\n", i, 2.0 + 0.1 * i);
  input_.write("bar.txt", flat.c_str());
  const Json found = import("rail.ply", {"--truth", path("bar.txt")});
  EXPECT_THAT(found.at("warnings").get<std::vector<std::string>>(),
              Contains(AllOf(HasSubstr("bar.txt"), HasSubstr("is it the reference"))));
}

/// Steps as a caller is told them: all of a total, the last one at its end.
TEST_F(ImportTruth, StepsAreAsManyAsWereSaid) {
  std::string map = "x";
  for (int y = -25; y <= 25; ++y) map += fmt::format(",{}", y);
  for (int x = 0; x <= 80; ++x) {
    map += fmt::format("\n{}", x);
    for (int y = -25; y <= 25; ++y) map += fmt::format(",{}", 0.3 * std::exp(-(x - 40.0) * (x - 40.0) / 200.0));
  }
  input_.write("map.csv", (map + "\n").c_str());
  scan("60E1", "rail.ply", {"--range-mm", "0,300", "--points", "60000"});
  for (const auto& [file, truth, count] : std::vector<std::tuple<std::string, std::string, std::size_t>>{
           {"map.csv", "", 7}, {"map.csv", "60E1", 8}, {"rail.ply", "", 9}, {"rail.ply", "60E1", 10}}) {
    ImportRequest request;
    request.scans = {path(file)};
    request.outputs = {path("steps.slcs")};
    request.settings.scan.unit = "mm";
    request.truth = truth;
    std::vector<std::pair<std::size_t, std::size_t>> told;
    Progress progress;
    progress.report = [&](std::size_t done, std::size_t total, const std::string&) { told.emplace_back(done, total); };
    const io::ImportReport report = import_scan(request, progress);
    EXPECT_EQ(report.steps.size(), count) << file;
    ASSERT_FALSE(told.empty());
    EXPECT_EQ(told.back(), std::pair(count - 1, count)) << file << ' ' << truth;
    for (const auto& [done, total] : told) EXPECT_EQ(total, count) << file << ", step " << done + 1;
  }
}

}  // namespace
}  // namespace treadmark::app
