// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "treadmark/app/import/scan_surface.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::run_program;
using Json = nlohmann::json;

/// 60E1, EN 13674-1: the crown has a radius of 300 mm for |y| < 10 mm. All in mm.
double crown(double y) { return 300.0 - std::sqrt(300.0 * 300.0 - y * y); }
/// S1002, EN 13715: the outer tread is a line for 32.158 < y < 60.
double outer_tread(double y) { return 1.364323640 - 0.066666667 * y; }
constexpr double kCone = 1e-5;  // [mm] the standard's digits

class ScanCommand : public ::testing::Test {
 protected:
  ScanCommand() { input.write("case.toml", treadmark::testing::standard_case("1.0")); }

  std::string path(const std::string& name) const { return (input.folder() / name).string(); }

  treadmark::testing::ProgramResult scan(const std::string& cloud, std::vector<std::string> more) const {
    std::vector<std::string> arguments{"scan", path("case.toml"), "-o", path(cloud)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }

  static Vec3 vector(const Json& list) {
    return Vec3(list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>());
  }

  treadmark::testing::SampleInput input;
};

TEST_F(ScanCommand, WritesTheRailInTheUnitAskedFor) {
  struct File {
    const char *name, *unit;
    double mm, rounding;  // [mm]
  };
  constexpr double kExact = 1e-9, kLas = 2e-4;  // LAS: 0.1 um or finer integers
  for (const File& file :
       {File{"rail.ply", "mm", 1.0, kExact}, File{"rail.xyz", "m", 1e3, kExact}, File{"rail.csv", "in", 25.4, kExact},
        File{"rail.ply", "um", 1e-3, kExact}, File{"rail.las", "mm", 1.0, kLas}}) {
    const auto r =
        scan(file.name, {"--body", "rail", "--range-mm", "-40", "60", "--points", "4000", "--unit", file.unit});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("points of a rail in " + std::string(file.unit)));
    const io::Scan back = io::read_scan(path(file.name));
    EXPECT_NEAR(static_cast<double>(back.cloud.points.size()), 4000.0, 40.0);
    if (back.unit) {
      EXPECT_EQ(symbol(*back.unit), file.unit) << file.name;
    }
    double least = 1e9, most = -1e9;
    std::size_t on_crown = 0;
    for (const Vec3& p : back.cloud.points) {
      least = std::min(least, file.mm * p.x());
      most = std::max(most, file.mm * p.x());
      const double y = file.mm * p.y();
      if (std::fabs(y) > 9.0) continue;
      ++on_crown;
      ASSERT_NEAR(file.mm * p.z(), crown(y), file.rounding) << file.name << ' ' << file.unit;
    }
    EXPECT_GT(on_crown, 400u);
    EXPECT_NEAR(least, -39.0, 1.01);
    EXPECT_NEAR(most, 59.0, 1.01);
  }
}

TEST_F(ScanCommand, TheTruthMapsAWheelBack) {
  const auto r = scan("wheel.ply", {"--body", "wheel", "--points", "20000", "--frame", "random", "--seed", "7",
                                    "--range-deg=-20,30", "--range-y-mm", "-20,58", "--passes", "2",
                                    "--registration-mm", "0.1", "--truth", path("truth.json")});
  ASSERT_EQ(r.status, 0) << r.err;
  const Json truth = Json::parse(input.read("truth.json"));
  const io::Scan back = io::read_scan(path("wheel.ply"));
  ASSERT_EQ(back.cloud.points.size(), truth.at("cloud").at("points"));
  ASSERT_EQ(back.cloud.passes.size(), back.cloud.points.size());
  EXPECT_EQ(truth.at("cloud").at("unit"), "mm");
  EXPECT_EQ(truth.at("seed"), 7);
  EXPECT_EQ(truth.at("surface").at("nominal_radius_mm"), 460.0);
  EXPECT_EQ(truth.at("settings").at("registration_mm"), 0.1);
  EXPECT_EQ(truth.at("settings").at("range_deg"), Json({-20.0, 30.0}));
  ASSERT_EQ(truth.at("passes").size(), 2u);
  const auto pose = [](const Json& json) {
    // both ways in which it is written
    Pose X;
    for (int i = 0; i < 3; ++i) {
      const auto row = json.at("rows_mm").at(static_cast<std::size_t>(i)).get<std::vector<double>>();
      for (int k = 0; k < 3; ++k) X.rotation(i, k) = row.at(static_cast<std::size_t>(k));
      X.origin[i] = row.at(3);
    }
    EXPECT_EQ(vector(json.at("origin_mm")), X.origin);
    EXPECT_EQ(vector(json.at("x_axis")), Vec3(X.rotation.col(0)));
    EXPECT_EQ(vector(json.at("y_axis")), Vec3(X.rotation.col(1)));
    EXPECT_EQ(vector(json.at("z_axis")), Vec3(X.rotation.col(2)));
    return X;
  };
  const Pose X_CS = pose(truth.at("surface_in_cloud"));
  const Pose X_pass[2] = {pose(truth.at("passes").at(0).at("error")), pose(truth.at("passes").at(1).at("error"))};
  std::size_t on_line = 0;
  for (std::size_t i = 0; i < back.cloud.points.size(); ++i) {
    const Vec3 p = X_CS.apply_inverse(X_pass[back.cloud.passes[i]].apply_inverse(back.cloud.points[i]));
    ASSERT_GE(p.y(), -20.0 - 1e-6);
    ASSERT_LE(p.y(), 58.0 + 1e-6);
    const double theta = std::atan2(p.x(), p.z()) * 57.29577951308232;
    ASSERT_GE(theta, -20.0 - 1e-6);
    ASSERT_LE(theta, 30.0 + 1e-6);
    if (p.y() < 33.0) continue;
    ++on_line;
    ASSERT_NEAR(std::hypot(p.x(), p.z()) - 460.0, outer_tread(p.y()), kCone);
  }
  EXPECT_GT(on_line, 4000u);
}

TEST_F(ScanCommand, CountsAddUpAndTheSummaryHasThem) {
  const std::vector<std::string> faults{"--body",
                                        "rail",
                                        "--range-mm=-100,100",
                                        "--points",
                                        "50000",
                                        "--noise-mm",
                                        "0.02",
                                        "--noise-lateral-mm",
                                        "0.01",
                                        "--outliers",
                                        "0.02",
                                        "--holes",
                                        "0.05",
                                        "--hole-size-mm",
                                        "6",
                                        "--drop-outs",
                                        "0.1",
                                        "--most-incidence-deg",
                                        "70"};
  std::vector<std::string> with_truth = faults;
  with_truth.insert(with_truth.end(), {"--truth", "-"});
  const auto json = scan("rail.ply", with_truth);
  ASSERT_EQ(json.status, 0) << json.err;
  const Json truth = Json::parse(json.out), counts = truth.at("counts");
  const io::Scan back = io::read_scan(path("rail.ply"));
  const auto count = [&](const char* name) { return counts.at(name).get<std::size_t>(); };
  EXPECT_EQ(back.cloud.points.size(), count("on_surface") + count("outliers"));
  EXPECT_GT(count("lost_occlusion"), 1000u);
  const double seen = static_cast<double>(back.cloud.points.size() + count("lost_drop_outs"));
  EXPECT_NEAR(static_cast<double>(count("lost_drop_outs")) / seen, 0.1, 0.015);
  EXPECT_NEAR(static_cast<double>(count("outliers")) / static_cast<double>(back.cloud.points.size()), 0.02, 0.004);
  EXPECT_NEAR(truth.at("spacing_mm").get<double>(), std::sqrt(truth.at("area_mm2").get<double>() / 50000.0), 1e-9);
  const auto text = scan("again.ply", faults);
  ASSERT_EQ(text.status, 0);
  EXPECT_THAT(text.out, HasSubstr("outliers " + std::to_string(count("outliers")) +
                                  "; lost: " + std::to_string(count("lost_holes")) + " in holes"));
  EXPECT_EQ(input.read("again.ply"), input.read("rail.ply"));  // byte by byte
  std::vector<std::string> one_thread = faults;
  one_thread.insert(one_thread.end(), {"--threads", "1"});
  ASSERT_EQ(scan("again.ply", one_thread).status, 0);
  EXPECT_EQ(input.read("again.ply"), input.read("rail.ply"));
}

TEST_F(ScanCommand, FromPlacesHasAPassAndShadowsOfEach) {
  const auto r = scan("rail.ply", {"--body", "rail", "--range-mm=-50,50", "--points", "4000", "--from-mm",
                                   "-20,300,-200", "--from-mm=0,-300,-200", "--truth", path("truth.json")});
  ASSERT_EQ(r.status, 0) << r.err;
  const Json truth = Json::parse(input.read("truth.json"));
  EXPECT_EQ(truth.at("settings").at("from_mm"), Json::parse("[[-20.0, 300.0, -200.0], [0.0, -300.0, -200.0]]"));
  ASSERT_EQ(truth.at("passes").size(), 2u);
  const auto lost = truth.at("counts").at("lost_shadow").get<std::size_t>();
  EXPECT_GT(lost, 200u);
  EXPECT_THAT(r.out, HasSubstr(std::to_string(lost) + " in shadow"));
}

TEST_F(ScanCommand, RefusesWhatMakesNoSense) {
  const auto refused = [&](const std::string& cloud, std::vector<std::string> arguments, const char* words) {
    const auto r = scan(cloud, std::move(arguments));
    EXPECT_EQ(r.status, 2) << words;
    EXPECT_THAT(r.err, HasSubstr(words));
    EXPECT_FALSE(std::filesystem::exists(input.folder() / cloud));
  };
  refused("x.ply", {}, "--body");
  refused("x.ply", {"--body", "rail"}, "--range-mm");
  refused("x.stl", {"--body", "wheel"}, "cannot be written");
  refused("x.ply", {"--body", "wheel", "--range-mm=-1,1"}, "degrees");
  refused("x.ply", {"--body", "wheel", "--range-deg=0,400"}, "a turn apart");
  refused("x.ply", {"--body", "wheel", "--scale", "2"}, "--scale belongs to");
  refused("x.ply", {"--body", "wheel", "--outliers", "2"}, "--outliers");
  refused("x.ply", {"--body", "wheel", "--unit", "ft"}, "--unit");
  refused("x.ply", {"--body", "wheel", "--points", "10", "--spacing-mm", "1"}, "--spacing-mm");
  refused("x.ply", {"--body", "wheel", "--truth", path("x.ply")}, "would overwrite");
  refused("x.ply", {"--body", "wheel", "--from-mm", "0,0"}, "X,Y,Z");
  refused("x.ply", {"--body", "wheel", "--from-mm", "0,0,900", "--passes", "2"}, "--passes");
  EXPECT_EQ(run_program({"scan", path("none.prr"), "-o", path("x.ply"), "--range-mm=0,1"}).status, 3);
}

TEST_F(ScanCommand, LeavesNoFileWhenStopped) {
  const std::atomic<bool> stop{true};
  Progress progress;
  progress.stop = &stop;
  ScanRequest request;
  request.surface.body = Body::wheel;
  EXPECT_THROW(scan_surface(input.folder() / "case.toml", input.folder() / "x.ply", request, progress), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(input.folder() / "x.ply"));
}

}  // namespace
}  // namespace treadmark::app
