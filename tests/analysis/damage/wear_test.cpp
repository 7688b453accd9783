// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/damage/wear.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/tests/support/error_text.hpp"

namespace treadmark::damage {
namespace {

using ::testing::HasSubstr;

PassedPatch one_element(double pressure, double slip, double friction) {
  PassedPatch patch;
  patch.velocity = 10.0;
  patch.length = patch.width = 1e-3;
  const double traction = friction * pressure;
  patch.elements.push_back({0.0, -0.5e-3, 0.5e-3, pressure, traction, slip, traction * slip * patch.velocity});
  patch.power = patch.elements.front().dissipation * patch.area();
  return patch;
}

double rate(const WearLaw& law, const PassedPatch& patch) { return depth_rate(law, patch, patch.elements.front()); }

TEST(DepthRate, ArchardInItsRegimes) {
  WearLaw law;
  law.hardness = 3e9;
  law.k = {1e-4, 30e-4, 3e-4};
  law.slip_limits = {0.2, 0.7};
  law.k_seizure = 300e-4;
  check(law);
  EXPECT_DOUBLE_EQ(rate(law, one_element(1e9, 0.01, 0.3)), 1e-4 * 1e9 * 0.1 / 3e9);
  EXPECT_DOUBLE_EQ(rate(law, one_element(1e9, 0.05, 0.3)), 30e-4 * 1e9 * 0.5 / 3e9);
  EXPECT_DOUBLE_EQ(rate(law, one_element(1e9, 0.1, 0.3)), 3e-4 * 1e9 * 1.0 / 3e9);
  EXPECT_DOUBLE_EQ(rate(law, one_element(2.5e9, 0.01, 0.3)), 300e-4 * 2.5e9 * 0.1 / 3e9);
}

TEST(DepthRate, TGammaOnItsLine) {
  WearLaw law;
  law.theory = WearTheory::t_gamma;
  law.density = 7800.0;
  law.t_gamma_area = {0.0, 10e6, 20e6};
  law.wear_rate = {0.0, 50e-3, 70e-3};  // [kg/m3]: 50 and 70 ug/m/mm2
  check(law);
  // T gamma / A is traction times slip: 0.3 GPa x 0.01 = 3 MPa
  EXPECT_NEAR(rate(law, one_element(1e9, 0.01, 0.3)), 15e-3 * 10.0 / 7800.0, 1e-18);
  EXPECT_NEAR(rate(law, one_element(1e9, 0.05, 0.3)), 60e-3 * 10.0 / 7800.0, 1e-18);
  EXPECT_NEAR(rate(law, one_element(1e9, 0.1, 0.3)), 90e-3 * 10.0 / 7800.0, 1e-18);
  EXPECT_EQ(rate(law, one_element(1e9, 0.0, 0.3)), 0.0);
}

TEST(DepthRate, EnergyByThePowerOfThePatch) {
  WearLaw law;
  law.theory = WearTheory::energy;
  law.volume_per_work = {1e-14, 3e-14};
  law.power_limits = {4e6};
  check(law);
  const PassedPatch mild = one_element(1e8, 1e-3, 0.3), severe = one_element(1e9, 1e-2, 0.3);
  EXPECT_DOUBLE_EQ(rate(law, mild), 1e-14 * mild.elements.front().dissipation);
  EXPECT_DOUBLE_EQ(rate(law, severe), 3e-14 * severe.elements.front().dissipation);
}

TEST(WearLawCheck, RefusesNumbersThatMakeNoSense) {
  const auto error = [](auto change) {
    WearLaw law;
    law.hardness = 3e9;
    law.k = {1e-4};
    change(law);
    return testing::error_of([&] { check(law); });
  };
  EXPECT_EQ(error([](WearLaw&) {}), "");
  EXPECT_THAT(error([](WearLaw& law) { law.seizure_ratio = 0.0; }), HasSubstr("seizure_pressure_over_hardness"));
  EXPECT_THAT(error([](WearLaw& law) { law.k_seizure = -1.0; }), HasSubstr("k_seizure must not be negative"));
  EXPECT_THAT(error([](WearLaw& law) { law.hardness = -1.0; }), HasSubstr("positive hardness_GPa"));
  EXPECT_THAT(error([](WearLaw& law) { law.k = {}; }), HasSubstr("needs k"));
  EXPECT_THAT(error([](WearLaw& law) { law.k = {-1e-4}; }), HasSubstr("k must not be negative"));
  EXPECT_THAT(error([](WearLaw& law) { law.slip_limits = {1.0}; }), HasSubstr("k has 1 values and slip_m_s has 1"));
  EXPECT_THAT(error([](WearLaw& law) { law.k = {1, 2, 3}, law.slip_limits = {0.7, 0.2}; }), HasSubstr("increase"));
  EXPECT_THAT(error([](WearLaw& law) { law.theory = WearTheory::t_gamma; }), HasSubstr("density_kg_m3"));
  EXPECT_THAT(error([](WearLaw& law) { law.theory = WearTheory::energy; }), HasSubstr("volume_per_work_mm3_J"));
}

TEST(WearLawCheck, RefusesEveryLawWithoutItsNumbers) {
  for (const WearTheoryRow& row : kWearTheories) {
    WearLaw law;
    law.theory = row.theory;
    EXPECT_THAT(testing::error_of([&] { check(law); }), HasSubstr("the law needs")) << row.word;
    std::istringstream keys{std::string(row.keys)};
    for (std::string key; keys >> key;)
      EXPECT_EQ(ranges::count(kWearNumbers, key, &WearNumber::key), 1) << row.word << ' ' << key;
  }
}

TEST(WearLawCheck, RefusesALineThatFallsOrIsNotOne) {
  WearLaw law;
  law.theory = WearTheory::t_gamma;
  law.density = 7800.0;
  const auto error = [&](std::vector<double> x, std::vector<double> y) {
    law.t_gamma_area = std::move(x), law.wear_rate = std::move(y);
    return testing::error_of([&] { check(law); });
  };
  EXPECT_EQ(error({0, 1}, {0, 1}), "");
  EXPECT_THAT(error({0, 1, 2}, {0, 1}), HasSubstr("t_gamma_area_MPa has 3 values and wear_rate_ug_m_mm2 has 2"));
  EXPECT_THAT(error({1, 1}, {0, 1}), HasSubstr("t_gamma_area_MPa must increase"));
  EXPECT_THAT(error({0, 1}, {1, 0}), HasSubstr("wear_rate_ug_m_mm2 falls"));
  EXPECT_THAT(error({0, 1}, {0, -1}), HasSubstr("wear_rate_ug_m_mm2 must not be negative"));
}

}  // namespace
}  // namespace treadmark::damage
