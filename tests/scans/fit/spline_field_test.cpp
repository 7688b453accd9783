// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/spline_field.hpp"

#include <gtest/gtest.h>

#include "treadmark/tests/scans/fit/level_samples.hpp"

namespace treadmark::scans {
namespace {

constexpr double kFieldLength = 0.8, kFieldWidth = 0.06;

SplineField random_field(bool closed, std::uint64_t seed) {
  SplineField field(kFieldLength, kFieldWidth, closed);
  Random random(seed);
  for (const auto& [along, across] : {std::pair<std::size_t, std::size_t>{4, 1}, {8, 3}, {32, 6}}) {
    SplineLevel level = tests::level_of(kFieldLength, kFieldWidth, along, across, closed);
    for (float& c : level.coefficient) c = static_cast<float>(1e-3 * (random.uniform() - 0.5));
    field.add(std::move(level));
  }
  return field;
}

TEST(SplineField, BasisIsTheUniformBSpline) {
  for (double t = 0.0; t < 1.0; t += 0.0625) {
    const auto b = cubic_basis(t);
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(b[k], tests::b_spline(3, t + 3.0 - static_cast<double>(k)), 1e-15);
      sum += b[k];
    }
    EXPECT_NEAR(sum, 1.0, 1e-15);
  }
}

TEST(SplineField, ValueIsTheSumOfAllFunctions) {
  for (const bool closed : {false, true}) {
    const SplineField field = random_field(closed, 1);
    Random random(2);
    for (int k = 0; k < 2000; ++k) {
      const double a = kFieldLength * random.uniform(), s = kFieldWidth * random.uniform();
      double sum = 0.0;
      for (const SplineLevel& level : field.levels())
        for (std::size_t f = 0; f < level.size(); ++f)
          sum += level.coefficient[f] * tests::function_value(level, f, a, s);
      ASSERT_NEAR(field.value(a, s), sum, 1e-15);
    }
  }
}

TEST(SplineField, OutsideItIsClampedOrWrapped) {
  const SplineField open = random_field(false, 3), closed = random_field(true, 3);
  for (const double s : {0.0, 0.01, kFieldWidth}) {
    EXPECT_DOUBLE_EQ(open.value(-0.1, s), open.value(0.0, s));
    EXPECT_DOUBLE_EQ(open.value(kFieldLength + 0.1, s), open.value(kFieldLength, s));
    EXPECT_NEAR(closed.value(-0.1, s), closed.value(kFieldLength - 0.1, s), 1e-15);
    EXPECT_NEAR(closed.value(3 * kFieldLength + 0.1, s), closed.value(0.1, s), 1e-15);
    EXPECT_NEAR(closed.value(kFieldLength, s), closed.value(0.0, s), 1e-15);
  }
  EXPECT_DOUBLE_EQ(open.value(0.3, -1.0), open.value(0.3, 0.0));
  EXPECT_DOUBLE_EQ(open.value(0.3, 1.0), open.value(0.3, kFieldWidth));
}

TEST(SplineField, ContinuousToTheSecondDerivativeAcrossTheSeam) {
  const SplineField field = random_field(true, 4);
  const double h = 0.2 * kFieldLength / 32;  // four steps lie within one interval, where the field is cubic
  for (const double s : {0.005, 0.033, 0.055}) {
    struct Side {
      double f, d1, d2;
    };
    // exact for cubics
    const auto side = [&](double step) {
      std::array<double, 4> f;
      for (std::size_t k = 0; k < 4; ++k)
        f[k] = field.value(kFieldLength + step * static_cast<double>(k) - (step < 0.0 && k == 0 ? 1e-12 : 0.0), s);
      return Side{f[0], (-11.0 * f[0] + 18.0 * f[1] - 9.0 * f[2] + 2.0 * f[3]) / (6.0 * step),
                  (2.0 * f[0] - 5.0 * f[1] + 4.0 * f[2] - f[3]) / (step * step)};
    };
    const Side before = side(-h), after = side(h);
    EXPECT_NEAR(before.f, after.f, 1e-12);
    EXPECT_NEAR(before.d1, after.d1, 1e-8);
    EXPECT_NEAR(before.d2, after.d2, 1e-6);
    EXPECT_GT(std::fabs(after.d2), 1e-3);
  }
}

TEST(SplineField, FinestKnotsWhereCoefficientsMatter) {
  SplineField field(kFieldLength, kFieldWidth, true);
  SplineLevel coarse = tests::level_of(kFieldLength, kFieldWidth, 8, 2, true),
              fine = tests::level_of(kFieldLength, kFieldWidth, 64, 2, true);
  const std::size_t at = 20;  // the function over intervals 17 to 20
  fine.coefficient[at * fine.functions_s() + 1] = 5e-6f;
  coarse.coefficient[0] = 1e-3f;  // over intervals 5 to 8, that is 5, 6, 7, 0: function f begins at interval f - 3
  const double knot = fine.knot_a, coarse_knot = coarse.knot_a;
  field.add(fine);
  field.add(coarse);
  for (std::size_t k = 0; k < 64; ++k) {
    const double a = knot * (static_cast<double>(k) + 0.5);
    bool in_fine = false, in_coarse = false;
    for (double s = 0.0; s <= kFieldWidth; s += kFieldWidth / 8) {
      in_fine = in_fine || tests::function_value(fine, at * fine.functions_s() + 1, a, s) > 0.0;
      in_coarse = in_coarse || tests::function_value(coarse, 0, a, s) > 0.0;
    }
    EXPECT_DOUBLE_EQ(field.finest_knot_a(a, 1e-6), in_fine ? knot : in_coarse ? coarse_knot : kFieldLength) << k;
    EXPECT_DOUBLE_EQ(field.finest_knot_a(a, 1e-5), in_coarse ? coarse_knot : kFieldLength) << k;
    EXPECT_DOUBLE_EQ(field.finest_knot_a(a, 1e-2), kFieldLength);
    EXPECT_EQ(in_fine, k >= 17 && k <= 20);
  }
}

}  // namespace
}  // namespace treadmark::scans
