// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "treadmark/analysis/measures/wheel.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::measures {
namespace {

using ::testing::HasSubstr;

constexpr double kMm = 1e-3;

Profile points_of(const std::string& name, double step = 0.1e-3) {
  return analytic::sample_profile(StandardProfile{name}, step);
}

/// With scatter across the curve.
Profile noisy(Profile p, double sigma, unsigned seed) {
  std::mt19937 draw(seed);
  std::normal_distribution<double> normal(0.0, sigma);
  const Profile clean = p;
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    const std::size_t a = i == 0 ? 0 : i - 1, b = std::min(i + 1, p.y.size() - 1);
    const double dy = clean.y[b] - clean.y[a], dz = clean.z[b] - clean.z[a], off = normal(draw) / std::hypot(dy, dz);
    p.y[i] -= off * dz;
    p.z[i] += off * dy;
  }
  return p;
}

TEST(WheelMeasures, S1002HasThePrintedNumbers) {
  // EN 13715: h = 28, e = 32.5; qR from the printed circles: 10.794. The face is a line at 70 degrees.
  const WheelMeasures m = measure_wheel(Section(points_of("S1002")), {}, 460 * kMm);
  EXPECT_NEAR(m.flange_height.value, 28.000 * kMm, 2e-7);
  EXPECT_NEAR(m.flange_thickness.value, 32.500 * kMm, 5e-7);
  EXPECT_NEAR(m.flange_gradient.value, 10.794 * kMm, 5e-7);
  EXPECT_NEAR(m.flange_angle.value * 180.0 / std::numbers::pi, 70.0, 0.01);
  EXPECT_NEAR(m.diameter.value, 920 * kMm, 1e-7);
  EXPECT_NEAR(m.hollow.value, 0.0, 1e-9);
  EXPECT_LT(m.flange_height.uncertainty, 1e-6);
}

TEST(WheelMeasures, VariantsHaveTheNumbersOfTheirNames) {
  // Thinner flanges have a tip a little lower than h: where two circles of 12 mm, (32.5 - e) apart, meet.
  for (const char* tread : {"S1002", "1:40", "EPS"})
    for (const double h : {28.0, 29.0, 30.0, 32.0})
      for (const double e : {28.5, 30.0, 32.5}) {
        const std::string name = std::string(tread) + "/h" + std::to_string(h) + "/e" + std::to_string(e) + "/10%";
        const WheelMeasures m = measure_wheel(Section(points_of(name)));
        const double half = 0.5 * (32.5 - e), tip = h - 12.0 + std::sqrt(144.0 - half * half);
        EXPECT_NEAR(m.flange_height.value, tip * kMm, 5e-7) << name;  // EPS: prints of 0.001 mm
        EXPECT_NEAR(m.flange_thickness.value, e * kMm, 2e-6) << name;
        if (e == 32.5 && h != 29.0) {  // 10.866 for both other printed heights
          EXPECT_NEAR(m.flange_gradient.value, (h == 28.0 ? 10.794 : 10.866) * kMm, 1e-6) << name;
        }
      }
}

TEST(WheelMeasures, AMovedProfileMeasuresTheSame) {
  Profile moved = points_of("S1002/h30/e31");
  const WheelMeasures before = measure_wheel(Section(moved));
  for (double& y : moved.y) y += 0.0123;
  for (double& z : moved.z) z -= 0.0045;
  const WheelMeasures after = measure_wheel(Section(moved), {}, 0.46);
  EXPECT_NEAR(after.flange_height.value, before.flange_height.value, 1e-9);
  EXPECT_NEAR(after.flange_thickness.value, before.flange_thickness.value, 1e-9);
  EXPECT_NEAR(after.flange_gradient.value, before.flange_gradient.value, 1e-9);
  EXPECT_NEAR(after.diameter.value, 2 * (0.46 - 0.0045), 1e-9);
}

TEST(WheelMeasures, WearOfAFlangeThatIsThinnerAndATreadThatIsLower) {
  const std::vector<NominalWheel> nominal{{"S1002", Section(points_of("S1002"))}};
  // A tread turned down by 2 mm: all of the section but the flange beside the tip.
  Profile worn = points_of("S1002");
  for (std::size_t i = 0; i < worn.y.size(); ++i)
    if (worn.y[i] > -20 * kMm) worn.z[i] -= 2 * kMm;
  const WheelMeasures m = measure_wheel(Section(worn, 0.0), {}, 0.0, nominal);
  EXPECT_NEAR(m.flange_height.value, 30 * kMm, 1e-6);
  EXPECT_NEAR(m.tread_wear.value, 2 * kMm, 1e-6);
  // 75 mm of tread, 2 mm deep, within the step at -20 mm
  EXPECT_NEAR(m.area_lost.value, 75 * 2 * kMm * kMm, 0.7 * kMm * kMm);
  EXPECT_NEAR(m.flange_wear.value, 0.0, 2e-6);
}

TEST(WheelMeasures, MildestReProfilingIsThatOfTheThinnerFlange) {
  // A wheel with a flange of 30 mm is turned to itself at no cost; to a full one until nowhere its curve lies outside.
  const Section worn(points_of("S1002/e30"));
  std::vector<NominalWheel> all;
  for (const char* name : {"S1002", "S1002/e31", "S1002/e30", "S1002/e29"})
    all.push_back({name, Section(points_of(name))});
  const WheelMeasures free = measure_wheel(worn, {}, 0.0, all);
  EXPECT_EQ(free.reprofiled_to, "S1002/e30");
  EXPECT_NEAR(free.diameter_lost.value, 0.0, 1e-5);
  all.erase(all.begin() + 1, all.end());
  const WheelMeasures full = measure_wheel(worn, {}, 0.0, all);
  const auto own = std::get<analytic::GraphCurve>(analytic::standard_curve("S1002/e30")),
             aim = std::get<analytic::GraphCurve>(analytic::standard_curve("S1002"));
  double deepest = 0.0;
  for (double y = -56.25e-3; y < 55e-3; y += 0.01e-3)
    deepest = std::max(deepest, aim.height(y, aim.find(y, 0)) - own.height(y, own.find(y, 0)));
  EXPECT_GT(deepest, 5e-3);
  EXPECT_NEAR(full.diameter_lost.value, 2 * deepest, 0.02 * kMm);
}

TEST(WheelMeasures, HollowAndRollOver) {
  // A tread worn as a circle 1.5 mm deep between y = -20 and 30 mm into a cylinder.
  Profile worn = points_of("S1002");
  for (std::size_t i = 0; i < worn.y.size(); ++i) {
    const double y = worn.y[i] / kMm;
    if (y > -20.0 && y <= 30.0) worn.z[i] = -1.5 * kMm * (1.0 - std::pow((y - 5.0) / 25.0, 2));
    if (y > 30.0) worn.z[i] = 0.0;
  }
  EXPECT_NEAR(measure_wheel(Section(worn, 0.0)).hollow.value, 1.5 * kMm, 0.01 * kMm);
  EXPECT_THAT(measure_wheel(Section(worn, 0.0)).rollover.reason, HasSubstr("outer rim face is not in the section"));
  // Cut where it still rises, after the 40 mm that a tread without a rise needs.
  Profile cut = points_of("S1002");
  for (std::size_t i = 0; i < cut.y.size(); ++i) {
    const double y = cut.y[i] / kMm;
    if (y > -20.0) cut.z[i] = -1.5 * kMm * (1.0 - std::pow((y - 17.5) / 37.5, 2));
  }
  EXPECT_NEAR(measure_wheel(Section(cut, 0.0)).hollow.value, 1.5 * kMm, 0.02 * kMm);
  for (std::size_t i = cut.y.size(); i-- > 0;)
    if (cut.y[i] > 43.0 * kMm)
      cut.y.erase(cut.y.begin() + static_cast<std::ptrdiff_t>(i)),
          cut.z.erase(cut.z.begin() + static_cast<std::ptrdiff_t>(i));
  EXPECT_THAT(measure_wheel(Section(cut, 0.0)).hollow.reason, HasSubstr("still rises where the section ends"));
  // An outer face at 65 mm from -2 to -20 mm, above it metal out to 66.2 mm.
  Profile rolled = points_of("S1002");
  rolled.y.insert(rolled.y.begin(), {65.0 * kMm, 66.2 * kMm, 65.5 * kMm});
  rolled.z.insert(rolled.z.begin(), {-6.5 * kMm, -5.0 * kMm, -3.2 * kMm});
  for (double z = -6.6; z > -20.0; z -= 0.2) {
    rolled.y.insert(rolled.y.begin(), 65.0 * kMm);
    rolled.z.insert(rolled.z.begin(), z * kMm);
  }
  const WheelMeasures m = measure_wheel(Section(rolled, 0.0));
  EXPECT_NEAR(m.rollover.value, 1.2 * kMm, 0.05 * kMm);
  EXPECT_NEAR(m.rim_width.value, 135.0 * kMm, 1e-3 * kMm);
}

TEST(WheelMeasures, ErrorsLieInsideTheStatedUncertainty) {
  const WheelMeasures truth = measure_wheel(Section(points_of("S1002")));
  int height = 0, thickness = 0, gradient = 0;
  constexpr int kSeeds = 100;
  constexpr double kNoise = 0.02e-3;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const WheelMeasures m =
        measure_wheel(Section(noisy(points_of("S1002", 0.2e-3), kNoise, static_cast<unsigned>(seed))));
    height += std::fabs(m.flange_height.value - truth.flange_height.value) <= m.flange_height.uncertainty ? 1 : 0;
    thickness +=
        std::fabs(m.flange_thickness.value - truth.flange_thickness.value) <= m.flange_thickness.uncertainty ? 1 : 0;
    gradient +=
        std::fabs(m.flange_gradient.value - truth.flange_gradient.value) <= m.flange_gradient.uncertainty ? 1 : 0;
    EXPECT_LT(m.flange_thickness.uncertainty, 3.5 * kNoise);
  }
  EXPECT_GE(height, 90);
  EXPECT_GE(thickness, 90);
  EXPECT_GE(gradient, 90);
}

std::vector<std::string> doubts_about(const Profile& points, const char* nominal) {
  const std::vector<NominalWheel> nominals{{nominal, Section(points_of(nominal))}};
  std::vector<std::string> out;
  for (const measured::Doubt& doubt : measure_wheel(Section(points, 0.0), {}, 0.0, nominals).doubts) {
    EXPECT_EQ(doubt.name, "nominal_profile");
    out.push_back(doubt.text);
  }
  return out;
}

TEST(WheelMeasures, TheNominalSectionOfAnotherWheelIsDoubted) {
  for (const char* name : {"S1002", "1:40", "EPS", "S1002/h30/e31/10%", "S1002/e28.5", "1:40/h32"})
    EXPECT_THAT(doubts_about(points_of(name), name), ::testing::IsEmpty()) << name;
  // a hollow tread and a thin flange are wear
  Profile worn = points_of("S1002/e29");
  for (std::size_t i = 0; i < worn.y.size(); ++i)
    if (const double y = worn.y[i] / kMm; y > -20.0 && y < 50.0)
      worn.z[i] -= 3.0 * kMm * std::pow(std::cos(std::numbers::pi * (y - 15.0) / 70.0), 2);
  EXPECT_THAT(doubts_about(worn, "S1002"), ::testing::IsEmpty());
  // a flange of 28 mm against one of 30 mm, one of 32.5 mm against one of 28.5 mm
  EXPECT_THAT(doubts_about(points_of("S1002"), "S1002/h30"),
              ::testing::Contains(HasSubstr("the tread wear is -2.00 mm: metal would have grown")));
  EXPECT_THAT(doubts_about(points_of("S1002"), "S1002/e28.5"), ::testing::Contains(HasSubstr("the flange wear is -")));
  // a flange that falls off to its back 1.5 mm deeper
  Profile other = points_of("S1002");
  for (std::size_t i = 0; i < other.y.size(); ++i)
    if (other.y[i] < -58 * kMm && other.y[i] > -69 * kMm) other.z[i] -= 1.5 * kMm;
  EXPECT_THAT(doubts_about(other, "S1002"), ::testing::Contains(HasSubstr("between its back and tip")));
}

TEST(WheelMeasures, ErrorsThatAreNotKnownAreUnknown) {
  Section section(points_of("S1002"), 0.0);
  const WheelMeasures exact = measure_wheel(section);
  section.claim_error(kUnknown);
  const WheelMeasures m = measure_wheel(section);
  EXPECT_TRUE(m.back_seen);
  for (const Measure WheelMeasures::*of : {&WheelMeasures::flange_height, &WheelMeasures::flange_thickness,
                                           &WheelMeasures::flange_gradient, &WheelMeasures::hollow}) {
    EXPECT_EQ((m.*of).value, (exact.*of).value);
    EXPECT_TRUE(std::isnan((m.*of).uncertainty));
  }
}

void expect_refused(const Profile& profile, const char* words) {
  try {
    measure_wheel(Section(profile));
    ADD_FAILURE() << "measured";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
}

TEST(WheelMeasures, WhatIsNoWheelIsRefusedByName) {
  Profile rail = points_of("60E1");
  rail.body = Body::wheel;
  expect_refused(rail, "does not look like a wheel");
  for (double& z : rail.z) z = -z;
  expect_refused(rail, "does not look like a wheel");
  Profile flange = points_of("S1002");
  const auto tread = static_cast<std::ptrdiff_t>(
      std::find_if(flange.y.begin(), flange.y.end(), [](double y) { return y < -15e-3; }) - flange.y.begin());
  flange.y.erase(flange.y.begin(), flange.y.begin() + tread);
  flange.z.erase(flange.z.begin(), flange.z.begin() + tread);
  expect_refused(flange, "no tape line");
}

TEST(WheelMeasures, ABurrOnTheBackIsNotTheBack) {
  Profile wheel = points_of("S1002");
  for (double z = wheel.z.back() - 0.2e-3; z > -50e-3; z -= 0.2e-3) wheel.y.push_back(-70e-3), wheel.z.push_back(z);
  for (const double burr : {0.0, 1.5e-3}) {
    Profile p = wheel;
    for (std::size_t i = 0; i < p.y.size(); ++i)
      if (p.y[i] < -67e-3) p.y[i] -= burr * std::exp(-std::pow((p.z[i] - 12e-3) / 3e-3, 2));
    const WheelMeasures m = measure_wheel(Section(p));
    EXPECT_NEAR(m.flange_thickness.value, 32.5 * kMm, 1e-5) << burr;
    EXPECT_TRUE(m.back_seen);
  }
}

TEST(WheelMeasures, WithoutTheBackThereIsNoThickness) {
  Profile half = points_of("S1002");
  while (half.y.back() < -58e-3) half.y.pop_back(), half.z.pop_back();
  const WheelMeasures m = measure_wheel(Section(half));
  EXPECT_NEAR(m.flange_height.value, 28e-3, 1e-6);
  EXPECT_NEAR(m.flange_gradient.value, 10.794e-3, 1e-6);
  EXPECT_FALSE(m.flange_thickness.known());
  EXPECT_THAT(m.flange_thickness.reason, HasSubstr("flange back"));
  // cut off 0.4 mm before it, where the fillet is 78 degrees steep
  Profile cut = points_of("S1002");
  while (cut.y.back() < -69.6e-3) cut.y.pop_back(), cut.z.pop_back();
  EXPECT_FALSE(measure_wheel(Section(cut)).flange_thickness.known());
}

}  // namespace
}  // namespace treadmark::measures
