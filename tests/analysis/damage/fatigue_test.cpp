// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/damage/fatigue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/tests/support/error_text.hpp"

namespace treadmark::damage {
namespace {

using ::testing::HasSubstr;

FatigueSettings known() {
  FatigueSettings settings;
  settings.measures = {FatigueMeasure::fi_surf, FatigueMeasure::shakedown, FatigueMeasure::whole_life,
                       FatigueMeasure::subsurface, FatigueMeasure::dang_van};
  settings.shear_yield = 300e6;
  settings.depths = {1e-3, 3e-3};
  settings.dang_van_slope = 0.3;
  settings.dang_van_limit = 250e6;
  settings.t_gamma = {15.0, 65.0, 175.0};
  settings.passage_damage = {0.0, 1e-5, 0.0};
  return settings;
}

/// Hertz's pressure on an ellipse of half-axes a and b, slipping with a friction that utilises all of it.
PassedPatch ellipse(double a, double b, double p0, double friction, double slip) {
  constexpr int kHalf = 60;
  PassedPatch patch;
  patch.velocity = 20.0;
  patch.length = a / kHalf, patch.width = b / kHalf;
  for (int i = -kHalf; i <= kHalf; ++i)
    for (int j = -kHalf; j <= kHalf; ++j) {
      const double square = 1.0 - std::pow(1.0 * i / kHalf, 2) - std::pow(1.0 * j / kHalf, 2);
      if (square <= 0.0) continue;
      const double p = p0 * std::sqrt(square), y = j * patch.width;
      patch.elements.push_back(
          {i * patch.length, y, y + patch.width, p, friction * p, slip, friction * p * slip * patch.velocity});
      patch.normal_force += p * patch.element_area();
      patch.power += patch.elements.back().dissipation * patch.element_area();
    }
  patch.traction_force = friction * patch.normal_force;
  return patch;
}

/// Ekberg, Kabo and Andersson 2002: mu - 2 pi a b k / (3 F), which is mu - k / p0 below Hertz's pressure.
TEST(ContactFatigue, IsThatOfTheEllipse) {
  const double a = 6e-3, b = 4e-3, p0 = 1.2e9;
  const ContactFatigue found = contact_fatigue(known(), ellipse(a, b, p0, 0.3, 0.002));
  const double force = 2.0 / 3.0 * std::numbers::pi * a * b * p0;
  EXPECT_NEAR(found.friction, 0.3, 1e-12);
  EXPECT_NEAR(found[FatigueMeasure::fi_surf], 0.3 - 2.0 * std::numbers::pi * a * b * 300e6 / (3.0 * force), 1e-3);
  EXPECT_NEAR(found[FatigueMeasure::fi_surf], 0.3 - 300e6 / p0, 1e-3);
  EXPECT_NEAR(found.pressure_ratio, 4.0, 1e-12);
  EXPECT_NEAR(found[FatigueMeasure::shakedown], 4.0 / 2.9, 1e-12);
  // T gamma is force times friction times slip: 36.2 N, between 15 and 65
  const double t_gamma = 0.3 * 0.002 * force;
  EXPECT_NEAR(found[FatigueMeasure::whole_life], 1e-5 * (t_gamma - 15.0) / 50.0,
              1e-3 * found[FatigueMeasure::whole_life]);
}

TEST(ContactFatigue, WearTakesOverBehindTheLine) {
  const PassedPatch patch = ellipse(6e-3, 4e-3, 1.2e9, 0.3, 0.02);
  ASSERT_GT(patch.t_gamma(), 175.0);
  EXPECT_LT(contact_fatigue(known(), patch)[FatigueMeasure::whole_life], 0.0);
}

TEST(ContactFatigue, IsZeroForWhatIsNotAskedFor) {
  FatigueSettings none;
  const ContactFatigue found = contact_fatigue(none, ellipse(6e-3, 4e-3, 1.2e9, 0.3, 0.002));
  EXPECT_NEAR(found.friction, 0.3, 1e-12);
  EXPECT_EQ(found[FatigueMeasure::fi_surf], 0.0);
  EXPECT_EQ(found.pressure_ratio, 0.0);
  EXPECT_EQ(found[FatigueMeasure::whole_life], 0.0);
}

TEST(FatigueCheck, RefusesNumbersThatMakeNoSense) {
  const auto error = [](auto change) {
    FatigueSettings settings = known();
    change(settings);
    return testing::error_of([&] { check(settings); });
  };
  EXPECT_EQ(error([](FatigueSettings&) {}), "");
  EXPECT_THAT(error([](FatigueSettings& s) { s.shear_yield = -1.0; }), HasSubstr("fi_surf needs a positive shear"));
  EXPECT_THAT(error([](FatigueSettings& s) { s.depths = {}; }), HasSubstr("subsurface needs depths_mm"));
  EXPECT_THAT(error([](FatigueSettings& s) { s.depths = {0.0, 1e-3}; }), HasSubstr("depths_mm must be positive"));
  EXPECT_THAT(error([](FatigueSettings& s) { s.depths = {2e-3, 1e-3}; }), HasSubstr("depths_mm must increase"));
  EXPECT_THAT(error([](FatigueSettings& s) { s.dang_van_limit = 0.0; }), HasSubstr("positive dang_van_limit_MPa"));
  EXPECT_THAT(error([](FatigueSettings& s) { s.passage_damage = {1.0}; }), HasSubstr("t_gamma_N has 3 values"));
  EXPECT_THAT(error([](FatigueSettings& s) { s.t_gamma = {15, 5, 1}; }), HasSubstr("t_gamma_N must increase"));
}

}  // namespace
}  // namespace treadmark::damage
