// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Long rails tile by tile: the same surface as all points at once give, and what happens when that is interrupted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::run_program;
using Json = nlohmann::json;

const char* kTiledRail = R"(
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

class ImportByTiles : public ::testing::Test {
 protected:
  ImportByTiles() {
    input.write("case.toml", kTiledRail);
    const auto r = run_program({"scan", path("case.toml"), "-o", path("rail.las"), "--body", "rail", "--range-mm",
                                "-3000,3000", "--points", "300000", "--noise-mm", "0.02", "--frame", "identity"});
    EXPECT_EQ(r.status, 0) << r.err;
  }

  std::string path(const std::string& name) const { return (input.folder() / name).string(); }
  Json json(const std::string& name) const {
    std::ifstream file(path(name));
    return Json::parse(file);
  }
  std::vector<std::string> arguments(const std::string& cloud, const std::string& surface, const std::string& use,
                                     const std::vector<std::string>& more) const {
    std::vector<std::string> out{"import", path(cloud), "-o", path(surface), "--json", path(surface + ".json")};
    for (const std::string& setting :
         {"tiles.use=" + use, std::string("tiles.length_m=1.5"), std::string("placement.zero=scan"),
          std::string("fit.follow=false"), std::string("fit.tolerance_um=0.02")}) {
      out.push_back("--set");
      out.push_back(setting);
    }
    out.insert(out.end(), more.begin(), more.end());
    return out;
  }
  treadmark::testing::ProgramResult import(const std::string& cloud, const std::string& surface, const std::string& use,
                                           const std::vector<std::string>& more = {}) const {
    return run_program(arguments(cloud, surface, use, more));
  }
  NaturalSurface the_rail() const {
    NamedSurface said;
    said.body = Body::rail;
    return named_surface(path("case.toml"), said);
  }
  double height(const NaturalSurface& rail, double x, double y) const {
    return height_at(*rail.surface, Pose{}, Vec2(x, y));
  }

  treadmark::testing::SampleInput input;
};

TEST_F(ImportByTiles, IsTheSameAsAtOnce) {
  ASSERT_EQ(import("rail.las", "once.slcs", "never").status, 0);
  const auto r = import("rail.las", "tiles.slcs", "always", {"--report", path("audit")});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_FALSE(std::filesystem::exists(path("tiles.slcs.unfinished")));
  const NaturalSurface once = named_surface(path("once.slcs"), {}), tiles = named_surface(path("tiles.slcs"), {});
  double most = 0.0, square = 0.0, count = 0.0;
  for (double x = -2.9; x < 2.9; x += 7.3e-3)
    for (double y = -25e-3; y <= 25e-3; y += 2.5e-3) {
      const double off = height(once, x, y) - height(tiles, x, y);
      ASSERT_FALSE(std::isnan(off)) << x << ' ' << y;
      square += off * off, count += 1.0;
      if (std::fabs(x) > 0.1) most = std::max(most, std::fabs(off));
    }
  // slices may stand at other places where the knots change, and begin a cell farther to the side: a fortieth of the
  // noise; tests/scans/fit/parts_of_bands_test.cpp has the fits themselves
  constexpr double kSame = 0.5e-6, kSameRms = 0.1e-6;  // [m]
  EXPECT_LT(most, kSame);
  EXPECT_LT(std::sqrt(square / count), kSameRms);

  const Json all = json("once.slcs.json"), found = json("tiles.slcs.json");
  ASSERT_EQ(found["damage"].size(), all["damage"].size());
  constexpr double kDamage = 0.01;  // [mm]
  for (const char* key : {"depth_mm", "y_mm"})
    EXPECT_NEAR(found["damage"][0][key].get<double>(), all["damage"][0][key].get<double>(), kDamage) << key;
  const Json schema = Json::parse(io::import_report_schema());
  EXPECT_EQ(treadmark::testing::first_violation(found, schema, schema), "");
}

TEST_F(ImportByTiles, OfASampleFindsTheSameRail) {
  const auto r = import("rail.las", "tiles.slcs", "always", {"--set", "tiles.sample_points=60000"});
  ASSERT_EQ(r.status, 0) << r.err;
  const NaturalSurface tiles = named_surface(path("tiles.slcs"), {}), known = the_rail();
  // the frame of the scan is that of the rail, which the sample finds again
  constexpr double kPlaced = 50e-6, kDepth = 0.05e-3;  // [m]
  for (double x = -2.9; x < 2.9; x += 0.1) {
    const double off = height(tiles, x, 0.0) - height(known, x, 0.0);
    EXPECT_LT(std::fabs(off), kPlaced) << x;
  }
  EXPECT_NEAR(height(tiles, 0.0, 0.0) - height(tiles, 0.1, 0.0), 0.5e-3, kDepth);
}

TEST_F(ImportByTiles, GoesOnWhereItEnded) {
  const auto stop = [&] { return import("rail.las", "tiles.slcs", "always", {"--set", "fit.written_um=0.001"}); };
  const auto first = stop();  // after the last tile: nothing is that near
  EXPECT_NE(first.status, 0);
  EXPECT_THAT(first.err, HasSubstr("beside the fitted surface at x = "));
  EXPECT_FALSE(std::filesystem::exists(path("tiles.slcs")));
  const auto size = std::filesystem::file_size(path("tiles.slcs.unfinished"));
  EXPECT_EQ(stop().err, first.err);
  EXPECT_EQ(std::filesystem::file_size(path("tiles.slcs.unfinished")), size);
  // what is missing at its end is made again
  std::filesystem::resize_file(path("tiles.slcs.unfinished"), size - 100);
  EXPECT_EQ(stop().err, first.err);
  EXPECT_EQ(std::filesystem::file_size(path("tiles.slcs.unfinished")), size);
  const auto other = import("rail.las", "tiles.slcs", "always");
  EXPECT_NE(other.status, 0);
  EXPECT_THAT(other.err, HasSubstr("holds something else that is unfinished"));
}

TEST_F(ImportByTiles, HearsCtrlCAndGoesOn) {
  std::vector<std::string> command = arguments("rail.las", "tiles.slcs", "always", {});
  command.insert(command.begin(), "treadmark");
  treadmark::testing::RunningProgram program(command);
  const std::filesystem::path unfinished = path("tiles.slcs.unfinished");
  for (int i = 0; i < 60'000 && program.running() && !std::filesystem::exists(unfinished); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program.send(SIGINT);
  const auto stopped = program.wait();
  EXPECT_EQ(stopped.status, 1);
  EXPECT_THAT(stopped.err, HasSubstr("the same command goes on"));
  EXPECT_FALSE(std::filesystem::exists(path("tiles.slcs")));
  ASSERT_EQ(import("rail.las", "tiles.slcs", "always").status, 0);
  ASSERT_EQ(import("rail.las", "fresh.slcs", "always").status, 0);
  const SliceSet tiles = io::read_slices(path("tiles.slcs"), Body::rail, {}),
                 fresh = io::read_slices(path("fresh.slcs"), Body::rail, {});
  ASSERT_EQ(tiles.u, fresh.u);
  for (std::size_t k = 0; k < tiles.u.size(); ++k) {
    EXPECT_EQ(tiles.profiles[k].y, fresh.profiles[k].y);
    EXPECT_EQ(tiles.profiles[k].z, fresh.profiles[k].z);
  }
}

TEST_F(ImportByTiles, EndsAtGapsAndGoesOn) {
  io::Scan scan = io::read_scan(path("rail.las"));
  ASSERT_TRUE(scan.unit);
  const double metres = metres_per(*scan.unit);
  for (Vec3& p : scan.cloud.points) p *= metres;
  std::erase_if(scan.cloud.points, [](const Vec3& p) { return p.x() > 1.0 && p.x() < 1.4; });
  scan.cloud.passes = {};
  io::write_scan(path("gap.ply"), scan.cloud, LengthUnit::millimetre);
  const auto r = import("gap.ply", "gap.slcs", "always");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("surface_gaps"));
  EXPECT_FALSE(std::filesystem::exists(path("gap.slcs")));
  const NaturalSurface before = named_surface(path("gap-1.slcs"), {}), after = named_surface(path("gap-2.slcs"), {});
  const NaturalSurface known = the_rail();
  constexpr double kPlaced = 50e-6;
  EXPECT_NEAR(height(before, 0.8, 0.0), height(known, 0.8, 0.0), kPlaced);
  EXPECT_NEAR(height(after, 1.6, 0.0), height(known, 1.6, 0.0), kPlaced);
  const Json found = json("gap.slcs.json");
  ASSERT_EQ(found["outputs"].size(), 2u);
}

TEST_F(ImportByTiles, OfWhatCannotBe) {
  const auto mesh = import("rail.las", "rail.ply", "always", {"--body", "rail"});
  EXPECT_NE(mesh.status, 0);
  EXPECT_THAT(mesh.err, HasSubstr("tiles become slices: one output *.slcs"));
  const auto kept = import("rail.las", "rail.slcs", "always", {"--set", "fit.sections=keep"});
  EXPECT_THAT(kept.err, HasSubstr("cross-sections are kept"));
  input.write("rows.csv", [] {
    std::string text;
    for (int row = 0; row < 30; ++row) {
      text += std::to_string(row);
      for (int k = 0; k < 40; ++k) text += "," + std::to_string(0.01 * k);
      text += '\n';
    }
    return text;
  }());
  const auto rows = import("rows.csv", "rail.slcs", "always");
  EXPECT_THAT(rows.err, HasSubstr("rows.csv holds no list of points"));
}

}  // namespace
}  // namespace treadmark::app
