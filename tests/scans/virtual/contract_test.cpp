// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What a virtual scan promises whatever it does to the surface: the same points again, refusals, an end when asked.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/scans/virtual/virtual_scanner.hpp"
#include "treadmark/tests/scans/virtual/sample_scans.hpp"

namespace treadmark::scans {
namespace {

using namespace scans::testing;
using ::testing::HasSubstr;

ScannerSettings everything(ScannerSettings settings) {
  settings.noise = 20e-6;
  settings.noise_lateral = 10e-6;
  settings.outliers = 0.01;
  settings.holes = 0.03;
  settings.drop_outs = 0.05;
  settings.most_incidence = 1.0;
  settings.passes = 3;
  settings.registration = 30e-6;
  settings.random_frame = true;
  return settings;
}

VirtualScan with_threads(int threads, const Surface& surface, const ScannerSettings& settings) {
  const ThreadLimit limit(threads);
  return scan_surface(surface, settings);
}

TEST(ScannerContract, TheSamePointsForAnyNumberOfThreads) {
  const auto z = [](double x, double y) {
    return std::fabs(y) > 0.03 ? std::numeric_limits<double>::quiet_NaN() : 10.0 * y * y + 1e-3 * std::sin(60.0 * x);
  };
  const FormulaRail wavy(z, {{-0.1, -0.03, -1e-3}, {0.1, 0.03, 0.011}});
  const std::shared_ptr<const Surface> rail = round_rail(), wheel = ball_wheel();
  const auto expect_same = [](const Surface& surface, ScannerSettings settings) {
    settings = everything(settings);
    const VirtualScan one = with_threads(1, surface, settings), four = with_threads(4, surface, settings);
    EXPECT_EQ(one.cloud.points, four.cloud.points);
    EXPECT_EQ(one.cloud.passes, four.cloud.passes);
    EXPECT_EQ(one.truth.area, four.truth.area);
    EXPECT_EQ(one.truth.lost_holes, four.truth.lost_holes);
    EXPECT_GT(one.cloud.points.size(), 10'000u);
    settings.seed = 2;
    EXPECT_NE(scan_surface(surface, settings).cloud.points, one.cloud.points);
  };
  expect_same(*rail, rail_settings(30'000));
  expect_same(*wheel, wheel_settings(30'000));
  ScannerSettings settings;
  settings.points = 30'000;
  expect_same(wavy, settings);
}

TEST(ScannerContract, NoiseMovesNoPointAlongTheSurface) {
  // purposes have their own random numbers: faults can be turned on one by one
  ScannerSettings settings = rail_settings(10'000);
  settings.drop_outs = 0.1;
  const VirtualScan a = scan_surface(*round_rail(), settings);
  settings.noise = 1e-6;
  const VirtualScan b = scan_surface(*round_rail(), settings);
  ASSERT_EQ(a.cloud.points.size(), b.cloud.points.size());
  for (std::size_t i = 0; i < a.cloud.points.size(); ++i)
    ASSERT_LT((a.cloud.points[i] - b.cloud.points[i]).norm(), 1e-5);
}

TEST(ScannerContract, RefusesWhatMakesNoSense) {
  const auto refused = [](const Surface& surface, const ScannerSettings& settings, const char* words) {
    try {
      scan_surface(surface, settings);
      ADD_FAILURE() << "accepted, expected: " << words;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::configuration);
      EXPECT_THAT(e.what(), HasSubstr(words));
    }
  };
  const auto rail = round_rail(), wheel = ball_wheel(), plane = analytic::make_plane_surface(Facing::up);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto rail_with = [&](auto change, const char* words) {
    ScannerSettings settings = rail_settings(1'000);
    change(settings);
    refused(*rail, settings, words);
  };
  rail_with([](ScannerSettings& s) { s.points = 0; }, "needs points");
  rail_with([](ScannerSettings& s) { s.points = 200'000'001; }, "200 million");
  rail_with([](ScannerSettings& s) { s.spacing = 1e-7; }, "wider spacing");
  rail_with([](ScannerSettings& s) { s.spacing = -1e-3; }, "spacing");
  rail_with([&](ScannerSettings& s) { s.noise = nan; }, "noise");
  rail_with([](ScannerSettings& s) { s.noise = -1e-6; }, "noise");
  rail_with([](ScannerSettings& s) { s.noise_lateral = 20.0; }, "lateral noise");
  rail_with([](ScannerSettings& s) { s.outliers = 1.5; }, "outliers");
  rail_with([](ScannerSettings& s) { s.holes = 1.0; }, "holes");
  rail_with(
      [](ScannerSettings& s) {
        s.holes = 0.1;
        s.hole_size = 0.0;
      },
      "holes need a size");
  rail_with(
      [](ScannerSettings& s) {
        s.holes = 0.5;
        s.hole_size = 1e-6;
      },
      "too small to cover");
  rail_with([](ScannerSettings& s) { s.drop_outs = -0.1; }, "drop-outs");
  rail_with([](ScannerSettings& s) { s.most_incidence = 2.0; }, "incidence");
  rail_with([](ScannerSettings& s) { s.passes = 0; }, "passes");
  rail_with([](ScannerSettings& s) { s.stands = {Vec3(0.0, 0.0, 0.5)}; }, "not one point is left");
  rail_with([nan](ScannerSettings& s) { s.stands = {Vec3(0.0, nan, -0.5)}; }, "finite");
  rail_with(
      [](ScannerSettings& s) {
        s.stands = {Vec3(0.0, 0.0, -0.5)};
        s.passes = 2;
      },
      "one pass from each place");
  rail_with(
      [](ScannerSettings& s) {
        s.stands = {Vec3(0.0, 0.0, -0.5)};
        s.line = [](double x) { return Pose{{x, 0.0, 0.0}, Mat3::Identity()}; };
      },
      "straight rail");
  rail_with([](ScannerSettings& s) { s.registration = -1.0; }, "registration");
  rail_with([](ScannerSettings& s) { s.X_CS.rotation *= 1.001; }, "rigid");
  rail_with([](ScannerSettings& s) { s.u_max = -1.0; }, "smaller to a greater");
  rail_with(
      [](ScannerSettings& s) {
        s.y_min = 0.2;
        s.y_max = 0.3;
      },
      "no surface");
  rail_with([](ScannerSettings& s) { s.u_max = std::numeric_limits<double>::infinity(); }, "range along the track");
  ScannerSettings on_plane = rail_settings(1'000);
  refused(*plane, on_plane, "range of y");
  ScannerSettings round = wheel_settings(1'000);
  round.u_min = 0.0;
  refused(*wheel, round, "two ends");
  round.u_max = 7.0;
  refused(*wheel, round, "two ends");
  round = wheel_settings(1'000);
  round.nominal_radius = 0.0;
  refused(*wheel, round, "nominal radius");
}

TEST(ScannerContract, ReportsLinesAndStops) {
  std::atomic<bool> stop{false};
  Progress progress;
  std::size_t last = 0, all = 0;
  progress.stop = &stop;
  progress.report = [&](std::size_t finished, std::size_t total, const std::string&) {
    EXPECT_GT(finished, last);
    EXPECT_LE(finished, total);
    last = finished;
    all = total;
  };
  const VirtualScan scan = scan_surface(*round_rail(), rail_settings(1'000'000), progress);
  EXPECT_EQ(last, all);
  EXPECT_EQ(all, scan.truth.passes.at(0).lines);
  last = 0;
  progress.report = [&](std::size_t finished, std::size_t, const std::string&) {
    last = finished;
    stop = true;
  };
  try {
    scan_surface(*round_rail(), rail_settings(1'000'000), progress);
    ADD_FAILURE() << "went on";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::numerical);
    EXPECT_THAT(e.what(), HasSubstr("stopped"));
  }
  EXPECT_LT(last, all);
}

}  // namespace
}  // namespace treadmark::scans
