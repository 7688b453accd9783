// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Both rails of a track in one cloud, and several scans of one rail: virtual scans whose truth is a formula.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/scans/virtual/virtual_scanner.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::run_program;
using Json = nlohmann::json;

/// A track of two rails 60E1, each leaning in by 1:40, in a circle to the right, with cant.
struct KnownTrack {
  double radius = 300.0, beside = 0.7525, cant_angle = 0.08, lean = 1.0 / 40.0;

  Pose middle(double turn) const {
    return {radius * Vec3(std::sin(turn), 1.0 - std::cos(turn), 0.0), rotation_z(turn) * rotation_x(cant_angle)};
  }
  /// x along it, the gauge side to the left of both; places along each by its own length.
  Pose right(double along) const {
    return middle(along / (radius - beside * std::cos(cant_angle))) * Pose{Vec3(0.0, beside, 0.0), rotation_x(-lean)};
  }
  Pose left(double along) const {
    return middle(-along / (radius + beside * std::cos(cant_angle))) *
           Pose{Vec3(0.0, -beside, 0.0), rotation_x(lean) * rotation_z(kPi)};
  }

  /// Of the right rail's section in the track's plane, from its middle: the top, and the least y down to 14 mm below.
  struct Section {
    Vec2 top;
    double face = 0.0;
  };
  Section section() const {
    const NaturalSurface rail = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}});
    std::vector<double> y, z;
    constexpr int kPlaces = 72'000;
    for (int k = 0; k <= kPlaces; ++k) y.push_back(1e-6 * k - 36e-3);
    z.resize(y.size());
    HeightsOut out;
    out.z = z;
    section_heights(*rail.surface, Body::rail, 0.0, y, out);
    std::vector<Vec2> points;
    const double c = std::cos(lean), s = std::sin(lean);
    for (std::size_t k = 0; k < y.size(); ++k)
      if (!std::isnan(z[k])) points.emplace_back(c * y[k] + s * z[k], c * z[k] - s * y[k]);
    Section found{points.front(), kInfinity};
    for (const Vec2& p : points)
      if (p.y() < found.top.y()) found.top = p;
    for (const Vec2& p : points)
      if (p.y() <= found.top.y() + 14e-3) found.face = std::min(found.face, p.x());
    return found;
  }
  double gauge() const { return 2.0 * (beside + section().face); }
  double cant() const { return 2.0 * (beside + section().top.x()) * std::sin(cant_angle); }
};

class ImportTrack : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (input.folder() / name).string(); }
  Json json(const std::string& name) const {
    std::ifstream file(path(name));
    return Json::parse(file);
  }
  /// Points of a rail 60E1 along a line [m].
  static std::vector<Vec3> scanned(const std::function<Pose(double)>& line, double from, double to, std::size_t points,
                                   std::uint64_t seed) {
    const NaturalSurface rail = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}});
    scans::ScannerSettings settings;
    settings.u_min = from, settings.u_max = to;
    settings.points = points;
    settings.noise = 20e-6;
    settings.line = line;
    settings.seed = seed;
    return scans::scan_surface(*rail.surface, settings).cloud.points;
  }
  void write(const std::string& name, const std::vector<std::vector<Vec3>>& parts) const {
    PointCloud cloud;
    for (const std::vector<Vec3>& part : parts) cloud.points.insert(cloud.points.end(), part.begin(), part.end());
    io::write_scan(path(name), cloud, LengthUnit::millimetre);
  }

  treadmark::testing::SampleInput input;
};

TEST_F(ImportTrack, BothRailsWithGaugeAndCant) {
  const KnownTrack track;
  constexpr double kLength = 2.5;
  constexpr std::size_t kPoints = 150'000;
  write("track.ply", {scanned([&](double u) { return track.right(u); }, 0.0, kLength, kPoints, 1),
                      scanned([&](double u) { return track.left(u); }, -kLength, 0.0, kPoints, 2)});
  const auto r =
      run_program({"import", path("track.ply"), "--body", "rail", "-o", path("rail.slcs"), "--json", path("found.json"),
                   "--report", path("audit"), "--set", "scan.rails=both", "--set", "placement.up=[0,0,-1]", "--set",
                   "placement.forward=[1,0,0]", "--set", "fit.errors=false"});
  ASSERT_EQ(r.status, 0) << r.err;
  for (const char* file : {"rail-left.slcs", "rail-right.slcs", "audit/report.json", "audit/left-rail/report.json"})
    EXPECT_TRUE(std::filesystem::exists(path(file))) << file;
  EXPECT_FALSE(std::filesystem::exists(path("rail.slcs")));
  const Json found = json("found.json"), &left = found["track"]["left_rail"];
  const Json schema = Json::parse(io::import_report_schema());
  EXPECT_EQ(treadmark::testing::first_violation(found, schema, schema), "");
  EXPECT_EQ(treadmark::testing::first_violation(left, schema, schema), "");
  EXPECT_TRUE(left["track"].is_null());
  ASSERT_GE(found["track"]["places"].size(), 5u);
  constexpr double kGauge = 0.1, kCant = 0.1;  // [mm]
  for (const Json& place : found["track"]["places"]) {
    EXPECT_NEAR(place["gauge_mm"].get<double>(), kMilli * track.gauge(), kGauge);
    EXPECT_NEAR(place["cant_mm"].get<double>(), kMilli * track.cant(), kCant);
    // between both rails, wherever along the track
    const Vec3 p(place["place_x_mm"].get<double>(), place["place_y_mm"].get<double>(),
                 place["place_z_mm"].get<double>());
    const double off = std::hypot(p.x(), p.y() - kMilli * track.radius) - kMilli * track.radius;
    EXPECT_NEAR(off, 0.0, 5.0);
  }
  // both have their gauge side to the left, so the left one runs the other way and bends to the left
  constexpr double kPart = 0.02;
  const auto bend = [](const Json& rail) {
    double sum = 0.0;
    for (const Json& place : rail["line"]["places"]) sum += place["curvature_per_m"].get<double>();
    return sum / static_cast<double>(rail["line"]["places"].size());
  };
  EXPECT_NEAR(bend(found) * track.radius, std::cos(track.cant_angle - track.lean), kPart);
  EXPECT_NEAR(bend(left) * track.radius, -std::cos(track.cant_angle + track.lean), kPart);
  EXPECT_TRUE(found["damage"].empty());
  EXPECT_TRUE(left["damage"].empty());
  EXPECT_THAT(r.out, HasSubstr("track, of which this is the right rail"));
  EXPECT_THAT(r.out, HasSubstr("the left rail"));
  // read back as a whole
  const io::ImportReport report = io::read_import_report(path("audit"));
  ASSERT_TRUE(report.track);
  ASSERT_TRUE(report.track->left);
  EXPECT_NEAR(report.track->gauge_mean, track.gauge(), kMillimetre * kGauge);
  EXPECT_EQ(report.track->left->outputs.front().file, "rail-left.slcs");
  NamedSurface said;
  said.body = Body::rail;
  EXPECT_NO_THROW(named_surface(path("rail-left.slcs"), said));
}

TEST_F(ImportTrack, OneRailAloneIsNoTrack) {
  write("rail.ply", {scanned([](double u) { return Pose{Vec3(u, 0.0, 0.0), Mat3::Identity()}; }, 0.0, 2.0, 80'000, 1)});
  auto r = run_program({"import", path("rail.ply"), "-o", path("rail.slcs"), "--set", "scan.rails=both"});
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, HasSubstr("lies no other"));
  r = run_program({"import", path("rail.ply"), "-o", path("wheel.slcw"), "--set", "scan.rails=both"});
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, HasSubstr("scan.rails"));
  r = run_program({"import", path("rail.ply"), "-o", path("rail.slcs"), "--set", "scan.register_mm=10"});
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, HasSubstr("this is one alone"));
  r = run_program({"import", path("rail.ply"), "-o", path("rail.slcs"), "--set", "scan.farthest=5000"});
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, HasSubstr("where the scanner stood"));
}

TEST_F(ImportTrack, ScansThatLieOffAreLaidOnEachOther) {
  const auto straight = [](double u) { return Pose{Vec3(u, 0.0, 0.0), Mat3::Identity()}; };
  const Vec3 off(0.0, 6e-3, -5e-3);
  write("one.ply", {scanned(straight, 0.0, 0.8, 100'000, 1)});
  std::vector<Vec3> other = scanned(straight, 0.3, 1.1, 100'000, 2);
  for (Vec3& p : other) p += off;
  write("other.ply", {other});
  const auto r = run_program({"import", path("one.ply"), path("other.ply"), "-o", path("rail.slcs"), "--json",
                              path("found.json"), "--set", "scan.register_mm=20", "--set", "fit.errors=false"});
  ASSERT_EQ(r.status, 0) << r.err;
  const Json found = json("found.json"), &scans = found["frame"]["registrations"];
  ASSERT_EQ(scans.size(), 2u);
  const Json& moved = std::fabs(scans[0]["shift_mm"][1].get<double>()) > 1.0 ? scans[0] : scans[1];
  constexpr double kClose = 0.15;  // [mm]
  const double way = moved["pass"].get<int>() == 1 ? -1.0 : 1.0;
  EXPECT_NEAR(moved["shift_mm"][1].get<double>(), way * kMilli * off.y(), kClose);
  EXPECT_NEAR(moved["shift_mm"][2].get<double>(), way * kMilli * off.z(), kClose);
  EXPECT_LT(moved["shift_error_um"].get<double>(), 1e3 * kClose);
  EXPECT_GE(moved["open"].get<int>(), 1) << "a plain rail tells nothing along it";
  EXPECT_THAT(r.out, HasSubstr("scan_open: "));
  // and evened out by what the passes are off the surface then
  EXPECT_LT(found["frame"]["pass_distance_after_mm"].get<double>(), 0.02);
  EXPECT_LT(found["noise_mm"].get<double>(), 0.03);
}

/// The second of two scans is four times as noisy: its points count less, which the audit says.
TEST_F(ImportTrack, NoisyScansCountLess) {
  const auto straight = [](double u) { return Pose{Vec3(u, 0.0, 0.0), Mat3::Identity()}; };
  write("quiet.ply", {scanned(straight, 0.0, 0.4, 60'000, 1)});
  const NaturalSurface rail = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}});
  scans::ScannerSettings settings;
  settings.u_max = 0.4, settings.u_min = 0.0;
  settings.points = 60'000;
  settings.noise = 80e-6;
  settings.seed = 2;
  io::write_scan(path("noisy.ply"), scans::scan_surface(*rail.surface, settings).cloud, LengthUnit::millimetre);
  for (const bool weights : {true, false}) {
    const auto r = run_program({"import", path("quiet.ply"), path("noisy.ply"), "-o", path("rail.slcs"), "--json",
                                path("found.json"), "--set", weights ? "fit.weights=true" : "fit.weights=false",
                                "--set", "fit.errors=false"});
    ASSERT_EQ(r.status, 0) << r.err;
    const Json classes = json("found.json")["fit"]["noise_classes"];
    if (!weights) {
      EXPECT_TRUE(classes.empty());
      continue;
    }
    ASSERT_EQ(classes.size(), 2u);
    EXPECT_EQ(classes[0]["class"], "pass 0");
    // quiet points are judged by surroundings of both, which makes them look noisier
    constexpr double kRatio = 1.0;
    EXPECT_NEAR(classes[1]["factor"].get<double>() / classes[0]["factor"].get<double>(), 4.0, kRatio);
    EXPECT_THAT(r.out, HasSubstr("times that: pass 1"));
  }
}

}  // namespace
}  // namespace treadmark::app
