// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/estimates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace treadmark::measures {
namespace {

SectionValue in_section(const std::string& quantity, double value, double cant_deficiency = kUnknown,
                        SectionKind kind = SectionKind::curve) {
  SectionValue v;
  v.assessed.quantity = quantity;
  v.assessed.place = "ws1";
  v.assessed.value = value;
  v.kind = kind;
  v.cant_deficiency = cant_deficiency;
  return v;
}

TEST(Estimates, StudentsQuantilesAreThoseOfTables) {
  EXPECT_NEAR(student_quantile(0.95, 1), 6.314, 5e-4);
  EXPECT_NEAR(student_quantile(0.99, 2), 6.965, 5e-4);
  EXPECT_NEAR(student_quantile(0.975, 5), 2.571, 5e-4);
  EXPECT_NEAR(student_quantile(0.99, 10), 2.764, 5e-4);
  EXPECT_NEAR(student_quantile(0.99, 30), 2.457, 5e-4);
}

TEST(Estimates, LargestValuesAreMeansAndDeviations) {
  std::vector<SectionValue> values;
  for (const double v : {10.0, 12.0, 14.0, 16.0, 18.0})
    for (const char* quantity : {"sumY_2m", "Q", "Y_qst"}) values.push_back(in_section(quantity, v));
  values[0].assessed.limit = 40.0;
  values[3].assessed.limit = 38.0;
  values.push_back(in_section("Q", 1e3, kUnknown, SectionKind::straight));  // alone of its kind
  SectionValue unknown = in_section("Q", kUnknown);
  unknown.assessed.status = AssessedStatus::too_short;
  values.push_back(unknown);
  const std::vector<Estimate> all = estimates_of(values);
  ASSERT_EQ(all.size(), 3u);
  const double deviation = std::sqrt(10.0);  // of 10 to 18 by 2
  for (const Estimate& e : all) {
    EXPECT_EQ(e.sections, 5u);
    EXPECT_NEAR(e.mean, 14.0, 1e-12);
    EXPECT_NEAR(e.deviation, deviation, 1e-12);
    const double k = e.quantity == "sumY_2m" ? 3.0 : e.quantity == "Q" ? 2.2 : 0.0;
    EXPECT_NEAR(e.largest, 14.0 + k * deviation, 1e-12) << e.quantity;
    EXPECT_TRUE(std::isnan(e.bound));
  }
  EXPECT_EQ(all[2].quantity, "sumY_2m");
  EXPECT_EQ(all[2].limit, 38.0);
}

TEST(Estimates, BoundsByCantDeficiencyHoldAsOftenAsTheySay) {
  // A further section at the largest cant deficiency lies below the bound in 99 of 100 cases.
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 2.0);
  const auto truth = [](double x) { return 20.0 + 150.0 * x; };
  constexpr int kTrials = 4000, kSections = 8;
  int below = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<SectionValue> values;
    for (int i = 0; i < kSections; ++i) {
      const double x = 0.02 * i;
      values.push_back(in_section("Y", truth(x) + noise(random), x));
    }
    const Estimate e = estimates_of(values).at(0);
    EXPECT_EQ(e.reference, 0.02 * (kSections - 1));
    if (truth(e.reference) + noise(random) < e.bound) ++below;
  }
  EXPECT_NEAR(below / static_cast<double>(kTrials), 0.99, 0.005);  // three standard errors
}

TEST(Estimates, AStraightLineIsFoundAsItIs) {
  std::vector<SectionValue> values;
  for (int i = 0; i < 6; ++i) values.push_back(in_section("Y", 5.0 + 40.0 * 0.03 * i, 0.03 * i));
  const Estimate e = estimates_of(values).at(0);
  EXPECT_NEAR(e.slope, 40.0, 1e-9);
  EXPECT_NEAR(e.bound, 5.0 + 40.0 * 0.15, 1e-6);
}

}  // namespace
}  // namespace treadmark::measures
