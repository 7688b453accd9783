// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "treadmark/backends/spline/banded.hpp"
#include "treadmark/backends/spline/slices/fit_slices.hpp"
#include "treadmark/backends/spline/slices/slice_net.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"

namespace treadmark::spline {
namespace {

constexpr double kNetRounding = 1e-13;

// Rail slices over uneven x; z(x, y) is sampled at n points across.
SliceSet rail_slices(const std::vector<double>& x, const std::function<double(double, double)>& z, int points = 21) {
  SliceSet set;
  set.body = Body::rail;
  set.name = "test rail";
  for (const double position : x) {
    set.u.push_back(position);
    set.profiles.push_back(
        testing::graph_profile(Body::rail, -10e-3, 10e-3, points, [&](double y) { return z(position, y); }));
  }
  return set;
}

const std::vector<double> kUneven{0.0, 0.01, 0.025, 0.03, 0.05, 0.07, 0.075, 0.1};

// (y, w) at u and v of a net.
NetPair value_at(const SliceNet& net, double u, double v) {
  const int cell = std::min(static_cast<int>(v) - 1, net.cells() - 1);
  return net.at(net.find(u), cell, v - (cell + 1)).value;
}

TEST(BsplineBasis, IsAPartitionOfUnityWithLocalSupport) {
  const auto knots = extended_knots(kUneven);
  ASSERT_EQ(knots.size(), kUneven.size() + 6);
  EXPECT_NEAR(knots[0], -0.03, 1e-15);
  EXPECT_NEAR(knots.back(), 0.175, 1e-15);
  for (int span = 3; span < static_cast<int>(knots.size()) - 4; ++span) {
    const BasisPowers basis = basis_powers(knots, span);
    const double h = knots[static_cast<std::size_t>(span) + 1] - knots[static_cast<std::size_t>(span)];
    for (const double t : {0.0, 0.3 * h, h}) {
      double sum = 0.0;
      for (const auto& b : basis) {
        EXPECT_GE(power_value(b, t), -kNetRounding);
        sum += power_value(b, t);
      }
      EXPECT_NEAR(sum, 1.0, kNetRounding);
    }
    EXPECT_NEAR(power_value(basis[3], 0.0), 0.0, kNetRounding);  // the next one begins here
    EXPECT_NEAR(power_value(basis[0], h), 0.0, kNetRounding);    // the first one ends there
  }
}

TEST(LineCoefficients, NotAKnotReproducesCubics) {
  const auto cubic = [](double x) { return 1.0 + 20.0 * x - 300.0 * x * x + 4000.0 * x * x * x; };
  std::vector<double> values;
  for (const double x : kUneven) values.push_back(cubic(x));
  const auto c = line_coefficients(kUneven, values, false);
  const auto knots = extended_knots(kUneven);
  for (std::size_t i = 0; i + 1 < kUneven.size(); ++i) {
    const BasisPowers basis = basis_powers(knots, static_cast<int>(i) + 3);
    for (const double f : {0.0, 0.4, 1.0}) {
      const double t = f * (kUneven[i + 1] - kUneven[i]);
      double value = 0.0;
      for (std::size_t b = 0; b < 4; ++b) value += c[i + b] * power_value(basis[b], t);
      EXPECT_NEAR(value, cubic(kUneven[i] + t), 1e-12);
    }
  }
}

TEST(LineCoefficients, ApproximationTakesValuesAsCoefficients) {
  const std::vector<double> values{1, 5, 2, 8, 3, 3, 7, 4};
  const auto c = line_coefficients(kUneven, values, true);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(c[i + 1], values[i]);
  EXPECT_EQ(c.front(), 2 * 1 - 5);
  EXPECT_EQ(c.back(), 2 * 4 - 7);
}

TEST(SliceNet, InterpolationReproducesCubicsInBothDirections) {
  // y is linear in v for straight slices, so z must be linear in y for arc length and y to agree: z = c(x) + d(x) y.
  const auto c = [](double x) { return 1e-3 + 0.2 * x - 3.0 * x * x + 20.0 * x * x * x; };
  const SliceNet net = fit_slices(rail_slices(kUneven, [&](double x, double y) { return c(x) + 0.1 * y; }));
  EXPECT_EQ(net.positions(), 1 + 1 + 40);  // 20.0998 mm in steps of at most 0.5 mm
  for (double x = 0.0; x <= 0.1; x += 0.0037)
    for (double v = 1.0; v <= net.positions(); v += 0.77) {
      const NetPair p = value_at(net, x, v);
      EXPECT_NEAR(p.y, -10e-3 + 20e-3 * (v - 1) / (net.positions() - 1), kNetRounding);
      EXPECT_NEAR(p.w, c(x) + 0.1 * p.y, kNetRounding);
    }
}

TEST(SliceNet, ApproximationWeighsNeighboursOneFourOne) {
  std::vector<double> x;
  for (int i = 0; i < 9; ++i) x.push_back(0.01 * i);
  const auto z = [](double position, double) { return position == 0.04 ? 6e-3 : 0.0; };
  SliceSet set = rail_slices(x, z);
  set.approximate_u = true;
  const SliceNet net = fit_slices(set);
  EXPECT_NEAR(value_at(net, 0.03, 11.3).w, 1e-3, kNetRounding);
  EXPECT_NEAR(value_at(net, 0.04, 11.3).w, 4e-3, kNetRounding);
  EXPECT_NEAR(value_at(net, 0.05, 11.3).w, 1e-3, kNetRounding);
  EXPECT_NEAR(value_at(net, 0.02, 11.3).w, 0.0, kNetRounding);
  set.approximate_u = false;
  EXPECT_NEAR(value_at(fit_slices(set), 0.04, 11.3).w, 6e-3, kNetRounding);
  EXPECT_NEAR(value_at(fit_slices(set), 0.05, 11.3).w, 0.0, kNetRounding);
}

TEST(SliceNet, GoesOnConstantlyBeyondTheSlices) {
  const SliceNet net = fit_slices(rail_slices(kUneven, [](double x, double y) { return 2.0 * x * x + 0.1 * y; }));
  for (const double v : {1.0, 7.6, 40.0}) {
    EXPECT_NEAR(value_at(net, -3.0, v).w, value_at(net, 0.0, v).w, kNetRounding);
    EXPECT_NEAR(value_at(net, 5.0, v).w, value_at(net, 0.1, v).w, kNetRounding);
    EXPECT_EQ(net.at(net.find(-0.5), 3, 0.4).by_u.w, 0.0);
  }
}

TEST(SliceNet, DerivativesEqualDifferences) {
  const SliceNet net = fit_slices(testing::bending_rail());
  const double u = 0.0123, f = 0.37, du = 1e-6, df = 1e-4;
  const int cell = 41;
  const auto at = [&](double a, double b) { return net.at(net.find(a), cell, b); };
  const NetValue value = at(u, f);
  EXPECT_NEAR(value.by_u.w, (at(u + du, f).value.w - at(u - du, f).value.w) / (2 * du), 1e-9);
  EXPECT_NEAR(value.by_v.y, (at(u, f + df).value.y - at(u, f - df).value.y) / (2 * df), 1e-11);
  const NetSecond second = net.second_at(net.find(u), cell, f);
  EXPECT_NEAR(second.by_uu.w, (at(u + du, f).by_u.w - at(u - du, f).by_u.w) / (2 * du), 1e-7);
  EXPECT_NEAR(second.by_uv.y, (at(u + du, f).by_v.y - at(u - du, f).by_v.y) / (2 * du), 1e-9);
  EXPECT_NEAR(second.by_vv.w, (at(u, f + df).by_v.w - at(u, f - df).by_v.w) / (2 * df), 1e-10);
  const NetValue on_break = net.at_break(net.find(u), cell), same = at(u, 0.0);
  EXPECT_NEAR(on_break.value.w, same.value.w, kNetRounding);
  EXPECT_NEAR(on_break.by_u.y, same.by_u.y, kNetRounding);
  EXPECT_NEAR(on_break.by_v.w, same.by_v.w, kNetRounding);
}

TEST(SliceNet, FeaturesKeepTheirLines) {
  // The first part is 6 mm long at x = 0 and grows with x; v = 1 + intervals of part 1 must stay on the feature.
  SliceSet set = rail_slices(kUneven, [](double, double) { return 0.0; });
  for (const double x : kUneven) set.features.push_back({0.0, 6e-3 + 0.02 * x, 1e3});
  const SliceNet net = fit_slices(set);
  const int intervals = 1 + static_cast<int>(8.0 / 0.5), rest = 1 + static_cast<int>(14.0 / 0.5);
  EXPECT_EQ(net.positions(), 1 + intervals + rest);
  for (double x = 0.0; x <= 0.1; x += 0.013) {
    EXPECT_NEAR(value_at(net, x, 1.0 + intervals).y, -10e-3 + 6e-3 + 0.02 * x, kNetRounding);
    EXPECT_NEAR(value_at(net, x, net.positions()).y, 10e-3, kNetRounding);
  }
}

TEST(SliceNet, MissingPartsStayMissing) {
  // The second part exists for x <= 0.05 only.
  SliceSet set = rail_slices(kUneven, [](double x, double y) { return 0.3 * x + 0.1 * y; });
  for (const double x : kUneven) set.features.push_back({0.0, 8e-3, x < 0.06 ? 1e3 : kNaN});
  const SliceNet net = fit_slices(set);
  const int intervals = 1 + static_cast<int>(8.0 / 0.5);
  EXPECT_NEAR(value_at(net, 0.08, 5.0).w, 0.3 * 0.08 + 0.1 * value_at(net, 0.08, 5.0).y, 1e-12);
  EXPECT_TRUE(std::isnan(value_at(net, 0.08, intervals + 8.0).w));
  EXPECT_TRUE(std::isnan(value_at(net, 0.3, intervals + 8.0).w));
  EXPECT_FALSE(std::isnan(value_at(net, 0.03, intervals + 8.0).w));
  EXPECT_FALSE(std::isnan(value_at(net, -0.3, intervals + 8.0).w));
}

TEST(SliceNet, WheelsCloseSmoothlyOverTheSeam) {
  constexpr double kPi = std::numbers::pi;
  for (const bool approximate : {false, true}) {
    SliceSet wheel;
    wheel.body = Body::wheel;
    wheel.name = "three-cornered wheel";
    wheel.approximate_u = approximate;
    const auto dr = [](double theta) { return 1e-4 * std::cos(3.0 * theta + 0.4); };
    for (int i = 0; i < 100; ++i) {
      const double theta = -kPi + 0.01 + 2 * kPi * i / 100;
      wheel.u.push_back(theta);
      wheel.profiles.push_back(
          testing::graph_profile(Body::wheel, 20e-3, -20e-3, 11, [&](double) { return dr(theta); }));
    }
    const SliceNet net = fit_slices(wheel);
    double worst = 0.0;
    for (double theta = -3.5; theta < 3.5; theta += 0.011)
      worst = std::max(worst, std::abs(value_at(net, theta, 20.5).w - dr(theta)));
    // Interpolation error 3^4 h^4 / 384; approximation damps by (2 + cos 3h) / 3.
    EXPECT_LT(worst, approximate ? 1e-4 * 1.1 * std::pow(3 * 2 * kPi / 100, 2) / 6 : 5e-10);
    // The same value, slope and curvature from both sides of the seam, in 1e-8 steps of angle.
    const double seam = wheel.u.front();
    const NetValue before = net.at(net.find(seam - 1e-9), 19, 0.5), after = net.at(net.find(seam + 1e-9), 19, 0.5);
    EXPECT_NEAR(before.value.w, after.value.w, 1e-12);
    EXPECT_NEAR(before.by_u.w, after.by_u.w, 1e-11);
  }
}

TEST(SliceNet, AFirstSliceGivenAgainAfterATurnClosesTheWheelToo) {
  constexpr double kPi = std::numbers::pi;
  const auto dr = [](double theta) { return 1e-4 * std::cos(3.0 * theta + 0.4); };
  SliceSet wheel;
  wheel.body = Body::wheel;
  wheel.name = "wheel";
  for (int i = 0; i <= 60; ++i) {
    wheel.u.push_back(-kPi + 2 * kPi * i / 60);
    wheel.profiles.push_back(
        testing::graph_profile(Body::wheel, 20e-3, -20e-3, 11, [&](double) { return dr(2 * kPi * i / 60 - kPi); }));
  }
  const auto jumps = [](const SliceNet& net) {
    const NetValue before = net.at(net.find(-kPi - 1e-9), 19, 0.5), after = net.at(net.find(-kPi + 1e-9), 19, 0.5);
    const NetSecond second_before = net.second_at(net.find(-kPi - 1e-9), 19, 0.5),
                    second_after = net.second_at(net.find(-kPi + 1e-9), 19, 0.5);
    return std::array{std::abs(before.value.w - after.value.w), std::abs(before.by_u.w - after.by_u.w),
                      std::abs(second_before.by_uu.w - second_after.by_uu.w)};
  };
  const auto closed = jumps(fit_slices(wheel));
  EXPECT_LT(closed[0], 1e-12);
  EXPECT_LT(closed[1], 1e-11);
  EXPECT_LT(closed[2], 2e-9) << "of 9e-4";
  wheel.open_seam = true;
  const auto open = jumps(fit_slices(wheel));
  EXPECT_LT(open[0], 1e-12);
  EXPECT_GT(open[2], 100.0 * closed[2]);
  // a last slice that differs is no repetition
  wheel.open_seam = false;
  for (double& z : wheel.profiles.back().z) z += 1e-4;
  EXPECT_GT(jumps(fit_slices(wheel))[0], 0.9e-4);
}

TEST(SliceNet, AnOpenSeamIsConstant) {
  constexpr double kPi = std::numbers::pi;
  SliceSet wheel;
  wheel.body = Body::wheel;
  wheel.name = "wheel";
  wheel.open_seam = true;
  for (int i = 0; i < 20; ++i) {
    wheel.u.push_back(-kPi + 0.1 + 2 * kPi * i / 20);
    wheel.profiles.push_back(testing::graph_profile(Body::wheel, 20e-3, -20e-3, 11, [&](double) { return 1e-4 * i; }));
  }
  const SliceNet net = fit_slices(wheel);
  EXPECT_NEAR(value_at(net, wheel.u.back() + 0.1, 3.0).w, 19e-4, 1e-12);
  EXPECT_NEAR(value_at(net, -kPi + 0.05, 3.0).w, 0.0, 1e-12);
}

TEST(SliceKinks, PartsKeepTheirFeaturesAndBadOnesAreRefused) {
  SliceSet set = rail_slices({0.0, 0.1, 0.2, 0.3, 0.4}, [](double, double) { return 0.0; });
  EXPECT_EQ(split_at_kinks(set).size(), 1u);
  set.features.assign(5, {0.0, 4e-3, 9e-3, 15e-3});
  set.kinks = {1, 2};
  const auto parts = split_at_kinks(set);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[1].features[3], (std::vector<double>{4e-3, 9e-3}));
  for (const SliceSet& part : parts) EXPECT_TRUE(part.kinks.empty());
  for (const std::vector<int>& bad : {std::vector<int>{0}, {3}, {2, 1}, {-1}, {1, 1}}) {
    set.kinks = bad;
    EXPECT_THROW(split_at_kinks(set), Error);
  }
  set.features.clear();
  set.kinks = {1};
  EXPECT_THROW(split_at_kinks(set), Error);
}

TEST(SliceNet, AnArcOfAWheelGoesOnConstantly) {
  SliceSet wheel;
  wheel.body = Body::wheel;
  wheel.name = "arc";
  for (int i = 0; i < 6; ++i) {
    wheel.u.push_back(0.1 * i);
    wheel.profiles.push_back(testing::graph_profile(Body::wheel, 20e-3, -20e-3, 11, [&](double) { return 1e-3 * i; }));
  }
  const SliceNet net = fit_slices(wheel);
  EXPECT_NEAR(value_at(net, 0.25, 3.0).w, 2.5e-3, kNetRounding);
  EXPECT_NEAR(value_at(net, 2.0, 3.0).w, 5e-3, kNetRounding);
  EXPECT_NEAR(value_at(net, -2.0, 3.0).w, 0.0, kNetRounding);
  EXPECT_NEAR(value_at(net, -2.0 + 2 * std::numbers::pi, 3.0).w, 0.0, kNetRounding);
}

TEST(SliceNet, BadSlicesAreRefused) {
  SliceSet set = rail_slices({0.0, 0.1, 0.2}, [](double, double) { return 0.0; });
  EXPECT_THROW(fit_slices(set), Error);
  set = rail_slices(kUneven, [](double, double) { return 0.0; });
  std::swap(set.u[2], set.u[3]);
  EXPECT_THROW(fit_slices(set), Error);
  std::swap(set.u[2], set.u[3]);
  set.features.assign(kUneven.size(), {0.0, 8e-3, 1e3});
  set.features[2] = {0.0, kNaN, 1e3};  // missing in the middle
  EXPECT_THROW(fit_slices(set), Error);
  set.features[2] = {0.0, 8e-3, kNaN};  // then too few slices in a row have the part
  EXPECT_THROW(fit_slices(set), Error);
  set.features[2] = {0.0, 30e-3, 1e3};  // beyond the end
  EXPECT_THROW(fit_slices(set), Error);
}

}  // namespace
}  // namespace treadmark::spline
