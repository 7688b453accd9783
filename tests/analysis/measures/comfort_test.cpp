// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/comfort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "treadmark/analysis/measures/running.hpp"
#include "treadmark/analysis/measures/signal.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::measures {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi, kSpeedOfTrain = 20.0, kStepOfRecord = 5e-4;

/// A passenger at a point that moves as said, at constant speed.
template <class Motions>
RunSignals passenger(double duration, const Motions& motions) {
  RunSignals run;
  for (double t = 0.0; t <= duration; t += kStepOfRecord) run.time.push_back(t), run.place.push_back(kSpeedOfTrain * t);
  for (const auto& [motion, of_time] : motions) {
    PointSignal& point = run.points.emplace_back();
    point.name = "floor", point.kind = PointKind::car_body, point.motion = motion;
    for (const double t : run.time) point.values.push_back(of_time(t));
  }
  return run;
}

const Assessed& find(const std::vector<Assessed>& all, const std::string& quantity) {
  const auto at = ranges::find(all, quantity, &Assessed::quantity);
  if (at == all.end()) throw Error(ErrorKind::configuration, "no " + quantity);
  return *at;
}

using Motion = std::pair<PointMotion, std::function<double(double)>>;

TEST(Comfort, WindowsAndMeansAreTheirDefinitions) {
  std::vector<double> values;
  for (int i = 0; i < 25; ++i) values.push_back(i < 10 ? 3.0 : i < 20 ? -4.0 : 100.0);
  EXPECT_EQ(window_rms(values, 10), (std::vector<double>{3.0, 4.0}));  // what is left is no window
  EXPECT_TRUE(window_rms(values, 26).empty());
  const std::vector<double> means = centred_means(values, 4);
  ASSERT_EQ(means.size(), values.size());
  EXPECT_TRUE(std::isnan(means[1]));
  EXPECT_DOUBLE_EQ(means[2], 3.0);
  EXPECT_DOUBLE_EQ(means[10], -0.5);  // two samples of each
  EXPECT_DOUBLE_EQ(means[23], 100.0);
  EXPECT_TRUE(std::isnan(means[24]));
}

/// Weightings by their analog formulas; windows of 5 s hold whole periods.
TEST(Comfort, MeanComfortOfSinesIsInClosedForm) {
  const struct {
    double along, across, up;  // [Hz]
  } frequencies[] = {{1.0, 0.6, 4.0}, {2.0, 1.0, 8.0}, {5.0, 8.0, 16.0}};
  for (const auto& f : frequencies) {
    const auto sine = [](double amplitude, double frequency) {
      return [=](double t) { return amplitude * std::sin(kFullTurn * frequency * t); };
    };
    const std::vector<Motion> motions{{PointMotion::longitudinal, sine(0.1, f.along)},
                                      {PointMotion::lateral, sine(0.3, f.across)},
                                      {PointMotion::vertical, sine(0.4, f.up)}};
    const RunSignals run = passenger(45.0, motions);
    const AssessmentSection section{"run", 300.0, 860.0};  // behind the filters' beginning; 28 s: five windows
    const std::vector<Assessed> all = assess_run(run, std::span(&section, 1), VehicleKind::passenger);
    const double x = 0.1 * weighting_magnitude(Weighting::d, f.along),
                 y = 0.3 * weighting_magnitude(Weighting::d, f.across),
                 z = 0.4 * weighting_magnitude(Weighting::b, f.up);
    const double root = std::numbers::sqrt2;
    EXPECT_NEAR(find(all, "ax_P95").value, x / root, 0.01 * x) << f.along;
    EXPECT_NEAR(find(all, "ay_P95").value, y / root, 0.01 * y) << f.across;
    EXPECT_NEAR(find(all, "az_P95").value, z / root, 0.01 * z) << f.up;
    const Assessed& comfort = find(all, "N_MV");
    EXPECT_EQ(comfort.samples, 5u);
    EXPECT_NEAR(comfort.value, 6.0 / root * std::hypot(x, y, z), 0.01 * comfort.value);
    EXPECT_NEAR(comfort.mean, comfort.value, 0.005 * comfort.value);
  }
}

/// Of 21 windows, whose acceleration grows from one to the next.
TEST(Comfort, PercentilesAreOfWindowsThatDiffer) {
  // 21 windows with amplitudes 1 ... 21: 95 % of them lie below the twentieth
  const std::vector<Motion> motions{
      {PointMotion::lateral, [](double t) { return (1.0 + std::floor(t / 5.0)) * std::sin(kFullTurn * 2.0 * t); }}};
  const RunSignals run = passenger(106.0, motions);
  const AssessmentSection section{"run", 0.0, 2100.0};
  const std::vector<Assessed> all = assess_run(run, std::span(&section, 1), VehicleKind::passenger);
  EXPECT_NEAR(find(all, "ay_P95").value, 20.0 * weighting_magnitude(Weighting::d, 2.0) / std::numbers::sqrt2, 0.15);
  EXPECT_EQ(find(all, "ay_P95").samples, 21u);
  EXPECT_FALSE(ranges::any_of(all, [](const Assessed& a) { return a.quantity == "N_MV"; }));  // one direction only
}

/// Acceleration grows evenly within a transition of 4 s and stays: by hand.
TEST(Comfort, CurveTransitionsAreByHand) {
  constexpr double kBegin = 5.0, kLasts = 4.0, kMost = 1.0, kRoll = 0.03;
  const std::vector<Motion> motions{
      {PointMotion::lateral, [](double t) { return kMost * std::clamp((t - kBegin) / kLasts, 0.0, 1.0); }},
      {PointMotion::roll, [](double t) { return t > kBegin && t < kBegin + kLasts ? -kRoll : 0.0; }}};
  const RunSignals run = passenger(14.0, motions);
  const AssessmentSection sections[] = {
      {"in", kSpeedOfTrain * kBegin, kSpeedOfTrain * (kBegin + kLasts), SectionKind::transition},
      {"late", 200.0, 270.0, SectionKind::transition},
      {"curve", 200.0, 270.0, SectionKind::curve}};
  const std::vector<Assessed> all = assess_run(run, sections, VehicleKind::passenger);
  EXPECT_NEAR(find(all, "ay_1s").value, kMost, 1e-6);
  EXPECT_NEAR(find(all, "jerk_1s").value, kMost / kLasts, 1e-3);
  EXPECT_NEAR(find(all, "roll_1s").value, kRoll, 1e-9);
  // 28.54 + 20.69/4 - 11.1 and 8.97 + 9.68/4 - 5.9, and by degrees a second 0.185 w^2.283 and 0.120 w^1.626
  const double degrees = kRoll * 180.0 / std::numbers::pi;
  EXPECT_NEAR(find(all, "P_CT_standing").value, 22.6125 + 0.185 * std::pow(degrees, 2.283), 0.03);
  EXPECT_NEAR(find(all, "P_CT_seated").value, 5.49 + 0.120 * std::pow(degrees, 1.626), 0.03);
  // 0.5 s behind its end the run is over
  int late = 0;
  for (const Assessed& a : all) {
    if (!a.quantity.starts_with("P_CT")) continue;
    EXPECT_NE(a.section, "curve");
    if (a.section != "late") continue;
    ++late;
    EXPECT_EQ(a.status, AssessedStatus::outside);
  }
  EXPECT_EQ(late, 2);
}

/// Both forms in which the numbers go round, by shares and rad/s and by per cent and degrees a second, are the same.
TEST(Comfort, NumbersOfBothFormsAgree) {
  const struct {
    double acceleration, jerk, threshold, roll, power;
  } by_degrees[] = {{28.54, 20.69, 11.1, 0.185, 2.283}, {8.97, 9.68, 5.9, 0.120, 1.626}};
  ASSERT_EQ(transition_discomforts().size(), std::size(by_degrees));
  for (std::size_t i = 0; i < std::size(by_degrees); ++i)
    for (const double rate : {0.01, 0.03, 0.09}) {
      const auto& d = by_degrees[i];
      const TransitionMotion motion{1.2, 0.4, rate}, still{0.1, 0.1, 0.0};
      const double expected = d.acceleration * motion.acceleration + d.jerk * motion.jerk - d.threshold +
                              d.roll * std::pow(rate * 180.0 / std::numbers::pi, d.power);
      EXPECT_NEAR(transition_discomforts()[i].percentage(motion), expected, 0.002 * expected);
      EXPECT_EQ(transition_discomforts()[i].percentage(still), 0.0);
    }
}

}  // namespace
}  // namespace treadmark::measures
