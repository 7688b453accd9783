// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/limited_spline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/random.hpp"

namespace treadmark::vehicle {
namespace {

std::vector<double> counted(std::size_t n, double step = 1.0) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = step * static_cast<double>(i);
  return x;
}

/// Largest jump of the second derivative, but for three points at each end.
double largest_jump(const LimitedSpline& spline, const std::vector<double>& x) {
  double largest = 0.0;
  for (std::size_t i = 3; i + 3 < x.size(); ++i)
    largest = std::max(largest, std::abs(spline.at(x[i] - 1e-9).second - spline.at(x[i]).second));
  return largest;
}

TEST(LimitedSpline, CubicsAreReproduced) {
  // On unequal distances; no inflection within, where limiting sets in.
  const auto f = [](double x) { return 2.0 + 0.5 * x + 0.2 * x * x + 0.01 * x * x * x; };
  std::vector<double> x, y;
  Random random(3);
  for (double at = 0.0; at < 20.0; at += 0.3 + random.uniform()) {
    x.push_back(at);
    y.push_back(f(at));
  }
  const LimitedSpline spline(x, y);
  EXPECT_EQ(spline.limited(), 0);
  for (double at = 0.0; at < x.back(); at += 0.07) {
    const Along value = spline.at(at);
    EXPECT_NEAR(value.value, f(at), 1e-11);
    EXPECT_NEAR(value.first, 0.5 + 0.4 * at + 0.03 * at * at, 1e-11);
    EXPECT_NEAR(value.second, 0.4 + 0.06 * at, 1e-10);
  }
}

TEST(LimitedSpline, WavesKeepTheirHeight) {
  // Error of a cubic spline through n points a wave: (2 pi / n)^4 5/384 of the amplitude (Hall and Meyer 1976), eight
  // points away from the ends, whose slopes are estimates. Limits take nothing off peaks between or at points.
  for (const int n : {12, 16, 20, 40})
    for (const double phase : {0.0, 0.1, 0.3, 0.5, 1.0 / n}) {
      std::vector<double> x = counted(static_cast<std::size_t>(10 * n), 10.0 / n), y;
      const auto f = [phase](double at) { return std::sin(2.0 * kPi * (at / 10.0 + phase)); };
      for (const double at : x) y.push_back(f(at));
      const LimitedSpline spline(x, y);
      double largest = 0.0;
      for (double at = 80.0 / n; at < x.back() - 80.0 / n; at += 0.01)
        largest = std::max(largest, std::abs(spline.at(at).value - f(at)));
      const double h = 2.0 * kPi / n;
      EXPECT_LT(largest, h * h * h * h * 5.0 / 384.0) << n;
      // At a peak a slope below the error of a parabola, h^3 / 12, may be taken for none: the curvature, which is 1 in
      // the unit of h, then jumps by 8/h of that.
      EXPECT_LE(spline.limited(), 4) << n;
      EXPECT_LT(largest_jump(spline, x) * std::pow(10.0 / (2.0 * kPi), 2), 8.0 / 12.0 * h * h) << n;
    }
}

TEST(LimitedSpline, StepsAndRampsDoNotOvershoot) {
  for (const std::vector<double>& y : {std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1},
                                       {0, 0, 0, 0, 0.01, 1, 1.001, 1.001},
                                       {1, 1, 0.9, 0.1, 0, 0, -5, -5},
                                       {0, 0, 0, 1, 2, 3, 3, 3}}) {
    const LimitedSpline spline(counted(y.size()), y);
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    double before = spline.at(0.0).value;
    for (double x = 0.0; x <= spline.last(); x += 0.01) {
      const double value = spline.at(x).value;
      EXPECT_GE(value, *low - 1e-15);
      EXPECT_LE(value, *high + 1e-15);
      EXPECT_GE((value - before) * (y.back() - y.front()), -1e-15) << "goes back at " << x;
      before = value;
    }
    EXPECT_GT(spline.limited(), 0);
  }
}

TEST(LimitedSpline, APeakOfOnePointStaysThePeak) {
  const LimitedSpline spline(counted(9), {0, 0, 0, 0, 1, 0, 0, 0, 0});
  for (double x = 0.0; x <= 8.0; x += 0.01) {
    EXPECT_LE(spline.at(x).value, 1.0);
    EXPECT_GE(spline.at(x).value, 0.0);
  }
}

TEST(LimitedSpline, DerivativesEqualDifferencesAndJoin) {
  std::vector<double> x, y;
  Random random(7);
  for (double at = 0.0; at < 50.0; at += 0.2 + random.uniform()) {
    x.push_back(at);
    y.push_back(random.uniform());
  }
  const LimitedSpline spline(x, y);
  const double h = 1e-4;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    EXPECT_NEAR(spline.at(x[i]).value, y[i], 1e-15);
    const double middle = 0.5 * (x[i] + x[i + 1]);
    const Along at = spline.at(middle), low = spline.at(middle - h), high = spline.at(middle + h);
    EXPECT_NEAR((high.value - low.value) / (2 * h), at.first, 1e-5);
    EXPECT_NEAR((high.first - low.first) / (2 * h), at.second, 1e-4);
    if (i == 0) continue;
    EXPECT_NEAR(spline.at(x[i] - 1e-12).first, spline.at(x[i]).first, 1e-9);
  }
}

TEST(LimitedSpline, FewPointsAndEnds) {
  const LimitedSpline two({0.0, 2.0}, {1.0, 5.0});
  EXPECT_EQ(two.at(1.0).value, 3.0);
  EXPECT_EQ(two.at(-1.0).value, 1.0);
  EXPECT_EQ(two.at(9.0).value, 5.0);
  EXPECT_EQ(two.at(9.0).first, 0.0);
  const LimitedSpline three({0.0, 1.0, 2.0}, {0.0, 1.0, 4.0});
  EXPECT_NEAR(three.at(1.5).value, 2.25, 1e-12);
  EXPECT_THROW(LimitedSpline({0.0}, {0.0}), Error);
  EXPECT_THROW(LimitedSpline({0.0, 0.0}, {0.0, 1.0}), Error);
  EXPECT_THROW(LimitedSpline({1.0, 0.0}, {0.0, 1.0}), Error);
  EXPECT_THROW(LimitedSpline({0.0, 1.0}, {0.0, kNaN}), Error);
}

}  // namespace
}  // namespace treadmark::vehicle
