// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/running.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "treadmark/analysis/measures/signal.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::measures {
namespace {

constexpr double kCircle = 2.0 * std::numbers::pi, kLoad = 110e3;

using Wave = std::function<double(double)>;  // of time or distance

std::vector<double> over(const std::vector<double>& at, const Wave& wave) {
  std::vector<double> out;
  for (const double x : at) out.push_back(wave(x));
  return out;
}

/// A wheelset at a speed, with steps between half and one and a half of the mean one.
RunSignals run_of(double speed, double duration, double mean_step, const Wave& q, const Wave& left, const Wave& right) {
  RunSignals run;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> step(0.5 * mean_step, 1.5 * mean_step);
  for (double t = 0.0; t < duration; t += step(random)) run.time.push_back(t);
  run.time.push_back(duration);
  for (const double t : run.time) run.place.push_back(speed * t);
  run.wheelsets.push_back({"ws1", kLoad});
  run.wheels.push_back({"ws1_left", true, 0, over(run.time, q), over(run.time, left), {}});
  run.wheels.push_back({"ws1_right", false, 0, over(run.time, q), over(run.time, right), {}});
  return run;
}

Wave constant(double value) {
  return [value](double) { return value; };
}

const Assessed& find(const std::vector<Assessed>& all, const std::string& section, const std::string& place,
                     const std::string& quantity) {
  const auto at = ranges::find_if(
      all, [&](const Assessed& a) { return a.section == section && a.place == place && a.quantity == quantity; });
  if (at == all.end()) throw Error(ErrorKind::configuration, "no " + quantity + " of " + place + " in " + section);
  return *at;
}

const std::vector<AssessmentSection> kAll{{"all", 0.0, 100.0, SectionKind::curve}};

TEST(Running, ConstantForcesComeOutAsTheyAre) {
  const RunSignals run = run_of(20.0, 5.0, 5e-4, constant(60e3), constant(-9e3), constant(12e3));
  const std::vector<Assessed> all = assess_run(run, kAll, VehicleKind::passenger);
  const Assessed& q = find(all, "all", "ws1_left", "Q");
  EXPECT_EQ(q.status, AssessedStatus::ok);
  for (const double v : {q.least, q.most, q.mean, q.rms, q.low, q.middle, q.high, q.value}) EXPECT_NEAR(v, 60e3, 1e-6);
  EXPECT_NEAR(q.limit, 90e3 + 55e3, 1e-6);  // 72 km/h
  EXPECT_NEAR(q.share(), 60.0 / 145.0, 1e-9);
  // both wheels push outwards
  EXPECT_NEAR(find(all, "all", "ws1_left", "YQ_2m").value, 9.0 / 60.0, 1e-9);
  EXPECT_NEAR(find(all, "all", "ws1_left", "YQ_2m").middle, 9.0 / 60.0, 1e-9);
  EXPECT_NEAR(find(all, "all", "ws1_right", "YQ_2m").middle, 12.0 / 60.0, 1e-9);
  EXPECT_NEAR(find(all, "all", "ws1_right", "Y_qst").share(), 12.0 / 60.0, 1e-9);
  EXPECT_NEAR(find(all, "all", "ws1_right", "Q_qst").share(), 60.0 / 145.0, 1e-9);
  const Assessed& sum = find(all, "all", "ws1", "sumY_2m");
  EXPECT_NEAR(sum.middle, 3e3, 1e-6);
  EXPECT_NEAR(sum.limit, 10e3 + kLoad / 3.0, 1e-6);
  EXPECT_NEAR(find(assess_run(run, kAll, VehicleKind::freight), "all", "ws1", "sumY_2m").limit,
              0.85 * (10e3 + kLoad / 3.0), 1e-6);
}

TEST(Running, QuasiStaticForcesAreThoseOfCurves) {
  const RunSignals run = run_of(20.0, 5.0, 5e-4, constant(60e3), constant(-9e3), constant(12e3));
  const AssessmentSection straight{"all", 0.0, 100.0, SectionKind::straight};
  for (const Assessed& a : assess_run(run, std::span(&straight, 1), VehicleKind::passenger))
    EXPECT_TRUE(a.quantity != "Q_qst" && a.quantity != "Y_qst");
}

/// Sines whose frequency the filter and whose length the sliding mean knows.
TEST(Running, SinesAreFilteredAndAveraged) {
  constexpr double kSpeed = 10.0;
  for (const double f : {1.0, 8.0, 40.0}) {
    const RunSignals run = run_of(
        kSpeed, 10.0, 2e-4, [f](double t) { return 60e3 + 10e3 * std::sin(kCircle * f * t); }, constant(-5e3),
        [f](double t) { return 6e3 * std::sin(kCircle * f * t); });
    const std::vector<AssessmentSection> middle{{"middle", 20.0, 80.0}};
    const std::vector<Assessed> all = assess_run(run, middle, VehicleKind::passenger);
    const double kept = low_pass_magnitude(f, 20.0);
    const Assessed& q = find(all, "middle", "ws1_left", "Q");
    EXPECT_NEAR(q.most, 60e3 + kept * 10e3, 60.0) << f;
    EXPECT_NEAR(q.least, 60e3 - kept * 10e3, 60.0) << f;
    // of a sine a share p lies below -cos(pi p)
    EXPECT_NEAR(q.high, 60e3 + kept * 10e3 * std::cos(0.0015 * std::numbers::pi), 60.0) << f;
    EXPECT_NEAR(q.middle, 60e3, 60.0) << f;
    EXPECT_NEAR(q.rms, std::hypot(60e3, kept * 10e3 / std::numbers::sqrt2), 20.0) << f;
    const double turns = std::numbers::pi * f * 2.0 / kSpeed;  // of half the window
    double most = -1.0;
    for (int i = 0; i < 117; ++i)
      most = std::max(most, std::sin(kCircle * f * (21.0 + 0.5 * i) / kSpeed) * std::sin(turns) / turns);
    EXPECT_NEAR(find(all, "middle", "ws1", "sumY_2m").most, -5e3 + kept * most * 6e3, 20.0) << f;
    EXPECT_EQ(find(all, "middle", "ws1", "sumY_2m").samples, 117u);
  }
}

TEST(Running, TheSameRunAtOtherStepsSaysTheSame) {
  const auto q = [](double t) {
    return 55e3 + 15e3 * std::sin(kCircle * 3.0 * t) + 4e3 * std::cos(kCircle * 17.0 * t);
  };
  const auto y = [](double t) { return 6e3 + 8e3 * std::cos(kCircle * 2.0 * t); };
  const auto fine = assess_run(run_of(20.0, 5.0, 5e-5, q, y, constant(2e3)), kAll, VehicleKind::passenger);
  const auto coarse = assess_run(run_of(20.0, 5.0, 2e-3, q, y, constant(2e3)), kAll, VehicleKind::passenger);
  ASSERT_EQ(fine.size(), coarse.size());
  for (std::size_t i = 0; i < fine.size(); ++i)
    EXPECT_NEAR(coarse[i].value / fine[i].value, 1.0, 0.005) << fine[i].quantity;
}

TEST(Running, WhatCannotBeSaidIsNamed) {
  const RunSignals run = run_of(20.0, 5.0, 5e-4, constant(60e3), constant(-9e3), constant(12e3));
  const std::vector<AssessmentSection> sections{
      {"one metre", 10.0, 11.5}, {"a moment", 10.0, 10.5}, {"beyond", 90.0, 110.0}, {"before", -1.0, 20.0}};
  const std::vector<Assessed> all = assess_run(run, sections, VehicleKind::passenger);
  EXPECT_EQ(find(all, "one metre", "ws1_left", "Q").status, AssessedStatus::ok);
  EXPECT_EQ(find(all, "one metre", "ws1_left", "YQ_2m").status, AssessedStatus::too_short);
  EXPECT_TRUE(std::isnan(find(all, "one metre", "ws1_left", "YQ_2m").value));
  EXPECT_TRUE(std::isnan(find(all, "one metre", "ws1_left", "YQ_2m").limit));
  EXPECT_EQ(find(all, "a moment", "ws1_left", "Q").status, AssessedStatus::too_short);
  EXPECT_EQ(find(all, "beyond", "ws1_left", "Q").status, AssessedStatus::outside);
  EXPECT_EQ(find(all, "before", "ws1_left", "Q").status, AssessedStatus::outside);
  const auto coarse =
      assess_run(run_of(20.0, 5.0, 8e-3, constant(60e3), constant(0.0), constant(0.0)), kAll, VehicleKind::passenger);
  EXPECT_EQ(find(coarse, "all", "ws1_left", "Q").status, AssessedStatus::too_coarse);
  const auto lifted = assess_run(
      run_of(
          20.0, 5.0, 5e-4, [](double t) { return t > 2.0 && t < 3.0 ? 0.0 : 60e3; }, constant(-9e3), constant(12e3)),
      kAll, VehicleKind::passenger);
  EXPECT_EQ(find(lifted, "all", "ws1_left", "YQ_2m").status, AssessedStatus::unloaded);
  EXPECT_EQ(find(lifted, "all", "ws1_left", "Q").status, AssessedStatus::ok);
  EXPECT_NEAR(find(lifted, "all", "ws1_left", "Q").low, 0.0, 3e3);  // the filter swings over
  RunSignals broken = run;
  broken.wheels.front().q.pop_back();
  EXPECT_THROW(assess_run(broken, kAll, VehicleKind::passenger), Error);
  broken = run;
  std::swap(broken.time[3], broken.time[9]);
  EXPECT_THROW(assess_run(broken, kAll, VehicleKind::passenger), Error);
}

TEST(Running, LimitsOfWheelForcesFallWithSpeed) {
  for (const auto& [kmh, kilonewton] : {std::pair{120.0, 145.0}, {250.0, 145.0}, {350.0, 145.0}}) {
    const RunSignals run = run_of(kmh / 3.6, 4.0, 5e-4, constant(60e3), constant(0.0), constant(0.0));
    const AssessmentSection section{"all", 0.0, run.place.back()};
    EXPECT_NEAR(assess_run(run, std::span(&section, 1), VehicleKind::locomotive).front().limit, 1e3 * kilonewton, 1.0);
  }
  for (const auto& [kmh, kilonewton] :
       {std::pair{160.0, 200.0}, {200.0, 190.0}, {250.0, 180.0}, {300.0, 170.0}, {350.0, 160.0}}) {
    RunSignals run = run_of(kmh / 3.6, 4.0, 5e-4, constant(60e3), constant(0.0), constant(0.0));
    run.wheelsets.front().load = 240e3;
    const AssessmentSection section{"all", 0.0, run.place.back()};
    EXPECT_NEAR(assess_run(run, std::span(&section, 1), VehicleKind::locomotive).front().limit, 1e3 * kilonewton, 1.0)
        << kmh;
  }
}

TEST(Running, AccelerationsAreFilteredByWhereTheyAre) {
  RunSignals run = run_of(20.0, 20.0, 5e-4, constant(60e3), constant(0.0), constant(0.0));
  const Wave shake = [](double t) { return 1.0 + 0.5 * std::sin(kCircle * 8.0 * t); };
  for (const PointMotion motion : {PointMotion::lateral, PointMotion::vertical}) {
    run.points.push_back({"floor", PointKind::car_body, motion, over(run.time, shake)});
    run.points.push_back({"frame", PointKind::bogie_frame, motion, over(run.time, shake)});
    run.points.push_back({"box", PointKind::axle_box, motion, over(run.time, shake)});
  }
  const std::vector<AssessmentSection> middle{{"middle", 100.0, 300.0}};
  const std::vector<Assessed> all = assess_run(run, middle, VehicleKind::passenger);
  EXPECT_NEAR(find(all, "middle", "floor", "ay_safety").most, 1.0 + 0.5 * low_pass_magnitude(8.0, 6.0), 2e-3);
  EXPECT_DOUBLE_EQ(find(all, "middle", "floor", "ay_safety").limit, 3.0);
  EXPECT_NEAR(find(all, "middle", "floor", "ay_ride").most, 0.5 * low_pass_magnitude(8.0, 10.0), 3e-3);
  EXPECT_NEAR(find(all, "middle", "floor", "az_Wb").rms,
              0.5 * weighting_magnitude(Weighting::b, 8.0) / std::numbers::sqrt2, 3e-3);
  EXPECT_NEAR(find(all, "middle", "floor", "ay_Wd").rms,
              0.5 * weighting_magnitude(Weighting::d, 8.0) / std::numbers::sqrt2, 3e-3);
  EXPECT_NEAR(find(all, "middle", "frame", "ay_frame").most, 1.0 + 0.5 * low_pass_magnitude(8.0, 10.0), 2e-3);
  EXPECT_NEAR(find(all, "middle", "box", "az_box").rms, std::hypot(1.0, 0.5 / std::numbers::sqrt2), 1e-3);
  EXPECT_TRUE(std::isnan(find(assess_run(run, middle, VehicleKind::freight), "middle", "floor", "ay_ride").limit));
}

/// 5 Hz of 8 kN beside a steady force and 13 Hz of 3 kN, of which the band of 3 to 7 Hz leaves little.
TEST(Running, SwayIsTheRootMeanSquareAboutItsFrequency) {
  const RunSignals run = run_of(20.0, 30.0, 5e-4, constant(60e3), constant(5e3), [](double t) {
    return 8e3 * std::sin(kCircle * 5.0 * t) + 3e3 * std::sin(kCircle * 13.0 * t);
  });
  const std::vector<AssessmentSection> sections{{"long", 100.0, 500.0}, {"short", 100.0, 199.0}};
  const std::vector<Assessed> all = assess_run(run, sections, VehicleKind::passenger);
  const Assessed& sway = find(all, "long", "ws1", "sumY_rms");
  EXPECT_EQ(sway.samples, 31u);  // windows of 100 m every 10 m
  const auto kept = [](double f) { return high_pass_magnitude(f, 3.0) * low_pass_magnitude(f, 7.0); };
  EXPECT_NEAR(sway.value, std::hypot(8e3 * kept(5.0), 3e3 * kept(13.0)) / std::numbers::sqrt2, 60.0);
  EXPECT_NEAR(sway.limit, 0.5 * (10e3 + kLoad / 3.0), 1e-6);
  EXPECT_NEAR(find(all, "long", "ws1", "f_sumY").value, 5.0, 0.07);  // lines are 0.12 Hz apart
  EXPECT_EQ(find(all, "short", "ws1", "sumY_rms").status, AssessedStatus::too_short);
}

TEST(Running, UnloadingIsOfTheLoadAtRest) {
  RunSignals run = run_of(20.0, 5.0, 5e-4, constant(44e3), constant(0.0), constant(0.0));
  EXPECT_NEAR(find(assess_run(run, kAll, VehicleKind::freight), "all", "ws1_left", "dQ_Q").value, 0.2, 1e-9);
  run.wheelsets.front().load = kUnknown;
  for (const Assessed& a : assess_run(run, kAll, VehicleKind::freight)) EXPECT_NE(a.quantity, "dQ_Q");
}

TEST(Running, LimitsKnowTheRadiusOfTheSection) {
  RunSignals run = run_of(20.0, 10.0, 5e-4, constant(60e3), constant(-9e3), constant(12e3));
  for (const double x : run.place) run.curvature.push_back(x < 50.0 ? 0.0 : x < 100.0 ? -1.0 / 500.0 : 1.0 / 200.0);
  const RunningLimits limits{"made up",
                             true,
                             {{.quantity = "Y_qst", .constant = 30e3, .by_curvature = 10.5e6},
                              {.quantity = "YQ_2m", .from_radius = 250.0, .constant = 0.8}}};
  const std::vector<AssessmentSection> sections{
      {"straight", 0.0, 49.0}, {"wide", 52.0, 98.0, SectionKind::curve}, {"tight", 102.0, 198.0, SectionKind::curve}};
  const std::vector<Assessed> all = assess_run(run, sections, VehicleKind::passenger, limits);
  EXPECT_NEAR(find(all, "wide", "ws1_left", "Y_qst").limit, 51e3, 1.0);
  EXPECT_NEAR(find(all, "tight", "ws1_left", "Y_qst").limit, 82.5e3, 1.0);
  EXPECT_EQ(find(all, "straight", "ws1_left", "YQ_2m").limit, 0.8);
  EXPECT_EQ(find(all, "wide", "ws1_left", "YQ_2m").limit, 0.8);
  EXPECT_TRUE(std::isnan(find(all, "tight", "ws1_left", "YQ_2m").limit));
  EXPECT_TRUE(std::isnan(find(all, "wide", "ws1_left", "Q").limit));  // the file has none
  run.curvature.pop_back();
  EXPECT_THROW(assess_run(run, sections, VehicleKind::passenger), Error);
}

}  // namespace
}  // namespace treadmark::measures
