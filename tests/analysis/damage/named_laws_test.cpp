// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/damage/named_laws.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <string>
#include <variant>

#include "treadmark/analysis/damage/fatigue.hpp"
#include "treadmark/analysis/damage/wear.hpp"

namespace treadmark::damage {
namespace {

constexpr double kDigits = 1e-5;  // of the rows

const WearLaw& wear_named(const char* name) { return std::get<WearLaw>(law_named(name)->numbers); }

/// Depth by distance rolled below an element that is a patch of 1 mm2 by itself and rolls at 10 m/s.
double depth_by_distance(const char* name, double pressure, double slip, double traction) {
  PassedPatch patch;
  patch.velocity = 10.0;
  patch.length = patch.width = 1e-3;
  patch.elements.push_back({0.0, -0.5e-3, 0.5e-3, pressure, traction, slip, traction * slip * patch.velocity});
  patch.power = patch.elements.front().dissipation * patch.area();
  return depth_rate(wear_named(name), patch, patch.elements.front()) / patch.velocity;
}

TEST(NamedLaws, AreCompleteAndSayWhetherTheyAreVerified) {
  std::set<std::string> names;
  for (const NamedLaw& law : named_laws()) {
    EXPECT_TRUE(names.insert(law.name).second && law_named(law.name) == &law) << law.name;
    const auto look = [&](const auto& numbers) {
      EXPECT_NO_THROW(check(numbers)) << law.name;
      EXPECT_EQ(numbers.unverified, !law.verified);
      EXPECT_EQ(numbers.source, std::string(law.name) + ": " + law.source + (law.verified ? "" : " (unverified)"));
    };
    std::visit(look, law.numbers);
  }
  EXPECT_EQ(law_named("jendl"), nullptr);
}

/// 5.3 T gamma/A up to 10.4 N/mm2, level to 77.2, then with 61.9, in ug by m and mm2; of steel 7.85 ug are 1 um.
TEST(NamedLaws, SheffieldR8T) {
  const auto micrograms = [](double t_gamma_area) {
    return 7.85e6 * depth_by_distance("sheffield-r8t", 1e9, 0.01, 1e8 * t_gamma_area);
  };
  EXPECT_NEAR(micrograms(5.0), 26.5, 1e-9);
  EXPECT_NEAR(micrograms(40.0), 5.3 * 10.4, 1e-9);
  EXPECT_NEAR(micrograms(100.0), 5.3 * 10.4 + 61.9 * (100.0 - 77.2), 1e-9);
  EXPECT_NEAR(volume_by_distance(wear_named("sheffield-r8t"), 30.0, 5e-6, 20.0), 5.0 * 31.8e-9 / 7850.0, 1e-18);
}

/// Regimes at 0.2 and 0.7 m/s and 0.8 of the hardness; every coefficient lies within its range of the chart.
TEST(NamedLaws, JendelInTheRangesOfTheChart) {
  const auto coefficient = [](double pressure, double slip_speed) {
    const double slip = slip_speed / 10.0;
    return depth_by_distance("jendel", pressure, slip, 0.3 * pressure) * 3e9 / (pressure * slip);
  };
  for (const double speed : {0.1, 0.19, 0.71, 2.0}) EXPECT_NEAR(coefficient(1e9, speed), 5.5e-4, 4.5e-4);
  for (const double speed : {0.21, 0.69}) EXPECT_NEAR(coefficient(2.3e9, speed), 35e-4, 5e-4);
  for (const double speed : {0.1, 0.5, 2.0}) EXPECT_NEAR(coefficient(2.5e9, speed), 350e-4, 50e-4);
}

/// 0.7 and 2.1 ug by J, below and above 4 W/mm2: 39 and 41 N at 1 m/s over 10 mm2.
TEST(NamedLaws, KrausePoll) {
  const auto kg_by_joule = [](double t_gamma) {
    return 7850.0 * volume_by_distance(wear_named("krause-poll"), t_gamma, 10e-6, 1.0) / t_gamma;
  };
  EXPECT_NEAR(kg_by_joule(39.0), 7e-10, 7e-10 * kDigits);
  EXPECT_NEAR(kg_by_joule(41.0), 21e-10, 21e-10 * kDigits);
  EXPECT_NEAR(7850.0 * depth_by_distance("krause-poll", 1e9, 0.01, 3e7), 7e-10 * 3e5, 7e-10 * 3e5 * kDigits);
}

/// A wheel of 920 mm loses 0.25 T gamma / 920, 25 / 920 or (1.19 T gamma - 154) / 920 mm2 of its section by km, which
/// is as long as its circumference; elements have the share of it that they have of the work.
TEST(NamedLaws, BritishRail) {
  const auto expect = [](double t_gamma, double of_section) {
    const double cubic_mm = of_section / 920.0 * std::numbers::pi * 920.0;
    EXPECT_NEAR(1e12 * volume_by_distance(wear_named("british-rail"), t_gamma, 80e-6, 30.0), cubic_mm,
                cubic_mm * kDigits);
  };
  for (const double t_gamma : {10.0, 99.0}) expect(t_gamma, 0.25 * t_gamma);
  for (const double t_gamma : {101.0, 199.9}) expect(t_gamma, 25.0);
  for (const double t_gamma : {201.0, 400.0}) expect(t_gamma, 1.19 * t_gamma - 154.0);
  PassedPatch patch;
  patch.velocity = 10.0;
  patch.power = 120.0;  // T gamma is 12 N
  PassedElement part;
  part.dissipation = 5e6;
  EXPECT_NEAR(depth_rate(wear_named("british-rail"), patch, part),
              10e-12 * 0.25 * std::numbers::pi * 12.0 * 5e6 / 120.0, kDigits * 4e-6);
}

/// From 15 or 20 N up to 1e-5 at 65 N, back to nothing at 175 N, and on with that slope. The second one is stated as
/// 2.22e-7 T gamma - 4.44e-6 and 1.59e-5 - 9.09e-8 T gamma in the program that it is from.
TEST(NamedLaws, Burstow) {
  const auto damage = [](const char* name, double t_gamma) {
    return passage_damage(std::get<FatigueSettings>(law_named(name)->numbers), t_gamma);
  };
  EXPECT_EQ(damage("burstow-r220", 3.0), 0.0);
  for (const double t_gamma : {40.0, 120.0}) EXPECT_NEAR(damage("burstow-r220", t_gamma), 5e-6, 1e-18);
  EXPECT_NEAR(damage("burstow-r220", 65.0), 1e-5, 1e-18);
  EXPECT_NEAR(damage("burstow-r220", 285.0), -1e-5, 1e-18);
  EXPECT_EQ(damage("burstow-r260mn", 19.0), 0.0);
  EXPECT_NEAR(damage("burstow-r260mn", 50.0), 2.22e-7 * 50.0 - 4.44e-6, 2e-8);
  EXPECT_NEAR(damage("burstow-r260mn", 100.0), 1.59e-5 - 9.09e-8 * 100.0, 2e-8);
}

}  // namespace
}  // namespace treadmark::damage
