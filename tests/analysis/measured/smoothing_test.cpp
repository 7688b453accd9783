// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measured/smoothing.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "noisy_head.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::measured {
namespace {

using testing::head;
using testing::head_at;
using testing::rounded;
using testing::with_noise;

/// Of heights z the second derivative of the parabola of least squares over the points with |y - middle| <= half [1/m]:
/// the weights of that sum, 0 for all other points.
std::vector<double> bend_weights(const Profile& p, double middle, double half) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  const auto row = [&](double y) {
    const double t = (y - middle) / half;
    return std::fabs(t) > 1.0 ? Eigen::Vector3d(0.0, 0.0, 0.0) : Eigen::Vector3d(1.0, t, t * t);
  };
  for (const double y : p.y) normal += row(y) * row(y).transpose();
  const Eigen::Matrix3d inverse = normal.inverse();
  std::vector<double> weights;
  for (const double y : p.y) weights.push_back(2.0 / (half * half) * (inverse * row(y))[2]);
  return weights;
}

double bend(const Profile& p, double middle, double half) {
  const std::vector<double> weights = bend_weights(p, middle, half);
  return std::inner_product(weights.begin(), weights.end(), p.z.begin(), 0.0);
}

double farthest(const Profile& p, double within) {
  double most = 0.0;
  for (std::size_t i = 0; i < p.y.size(); ++i)
    if (std::fabs(p.y[i]) < within) most = std::max(most, std::fabs(p.z[i] - head_at(p.y[i]).z));
  return most;
}

TEST(SmoothingByNoise, LeavesExactPointsAlone) {
  for (const double step : {0.05e-3, 0.25e-3, 1e-3})
    for (const double unit : {0.0, 1e-9, 1e-7}) {
      const Profile given = unit > 0.0 ? rounded(head(step), unit) : head(step);
      const Profile smooth = smoothed_by_noise(given);
      EXPECT_EQ(smooth.y, given.y);
      EXPECT_EQ(smooth.z, given.z);
      ASSERT_TRUE(smooth.scatter);
      EXPECT_EQ(smooth.scatter->removed, 0.0);
    }
}

TEST(SmoothingByNoise, KeepsCrownShoulderAndGaugeCorner) {
  for (const double step : {0.1e-3, 0.3e-3, 1e-3})
    for (const double noise : {3e-6, 10e-6}) {
      const Profile noisy = with_noise(head(step), noise, 3), smooth = smoothed_by_noise(noisy);
      ASSERT_EQ(smooth.y.size(), noisy.y.size());
      EXPECT_NEAR(smooth.scatter->removed, noise, 0.45 * noise);
      EXPECT_LT(farthest(smooth, 33e-3), 3.0 * noise) << step;
      // the crown within what parabolas over so many points would leave, which fit noise alone there
      const double left = noise / (25e-6 * std::sqrt(10e-3 / step)) * std::sqrt(180.0) * 2.0;
      EXPECT_NEAR(bend(smooth, 0.0, 5e-3), bend(head(step), 0.0, 5e-3), 0.6 * left) << step << ' ' << noise;
      if (step < 1e-3) {  // of some 120
        EXPECT_NEAR(bend(smooth, 30e-3, 3e-3), bend(head(step), 30e-3, 3e-3), 10.0);
      }
    }
}

TEST(SmoothingByNoise, KnowsRoundedNumbersWithinHalfAStep) {
  for (const double step : {0.05e-3, 0.2e-3, 1e-3}) {
    const double unit = 0.05e-3;
    Profile smooth = smoothed_by_noise(rounded(head(step), unit));
    for (double& z : smooth.z) z -= 0.312345e-3;
    EXPECT_EQ(smooth.scatter->rounding_z, unit);
    EXPECT_LT(farthest(smooth, 33e-3), 0.5 * unit) << step;
    const std::vector<double> weights = bend_weights(smooth, 0.0, 8e-3);
    double deviation = deviation_of_sum(*smooth.scatter, smooth.scatter->s, weights);
    for (const std::vector<double>& other : smooth.scatter->others)
      deviation = std::hypot(deviation, std::inner_product(weights.begin(), weights.end(), other.begin(), 0.0));
    EXPECT_LT(deviation, 0.5) << step;  // 1.0 is what rounding itself makes of it
    EXPECT_NEAR(bend(smooth, 0.0, 8e-3), 1.0 / 0.3, 2.5 * deviation) << step;
  }
}

TEST(SmoothingByNoise, HoldsCornersThatStandOut) {
  Profile roof;  // 12 degrees, at y = 0
  for (int i = -200; i <= 200; ++i) roof.y.push_back(0.1e-3 * i), roof.z.push_back(0.1 * std::fabs(roof.y.back()));
  const Profile smooth = smoothed_by_noise(with_noise(roof, 3e-6, 5));
  double most = 0.0;
  for (std::size_t i = 0; i < roof.y.size(); ++i) most = std::max(most, std::fabs(smooth.z[i] - roof.z[i]));
  EXPECT_LT(most, 25e-6);  // a parabola over 2 mm to both sides would take 75
}

TEST(SmoothingByNoise, TakesTheMeetingOfTwoArcsForNoCorner) {
  constexpr double kSharpest = 1.0 / 0.080;
  Profile even;  // points 0.2 mm apart along the head
  for (double y = -35.7e-3; y < 35.7e-3; y += 0.2e-3 / std::hypot(1.0, head_at(y).slope))
    even.y.push_back(y), even.z.push_back(head_at(y).z);
  for (const double noise : {0.7e-6, 1e-6, 3e-6})
    for (unsigned seed = 1; seed <= 30; ++seed) {
      Profile noisy = with_noise(even, noise, seed);
      std::mt19937 random(seed + 100);
      std::normal_distribution<double> normal(0.0, noise);
      for (double& y : noisy.y) y += normal(random);
      const Profile smooth = smoothed_by_noise(noisy);
      for (double y = -14e-3; y <= 14e-3; y += 0.25e-3)
        EXPECT_LT(bend(smooth, y, 0.7e-3), 1.6 * kSharpest) << noise << ' ' << seed << ' ' << y;
    }
}

TEST(SmoothingByNoise, IsTheSameWhicheverWayThePointsRun) {
  const Profile noisy = with_noise(head(0.3e-3), 10e-6, 8);
  Profile turned = noisy;
  for (double& y : turned.y) y = -y;
  std::reverse(turned.y.begin(), turned.y.end());
  std::reverse(turned.z.begin(), turned.z.end());
  const Profile a = smoothed_by_noise(noisy), b = smoothed_by_noise(turned);
  const std::size_t n = a.y.size();
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(a.z[i], b.z[n - 1 - i], 0.2e-6);
}

/// Three points on the crown: what the middle one lies above the others' mean is what bends.
TEST(SmoothingByNoise, KnowsItsOwnError) {
  constexpr double kApart = 4e-3, kStep = 0.3e-3, kNoise = 10e-6;
  const std::array<double, 3> weights{-0.5, 1.0, -0.5};
  int cases = 0, inside = 0;
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const double middle : {-15e-3, 0.0, 15e-3}) {
      const Profile p = smoothed_by_noise(with_noise(head(kStep), kNoise, seed));
      double error = 0.0;
      std::vector<double> at;
      for (int k = -1; k <= 1; ++k) {
        const auto i = static_cast<std::size_t>(std::lround((middle + k * kApart - p.y.front()) / kStep));
        at.push_back(p.scatter->s[i]);
        error += weights[static_cast<std::size_t>(k + 1)] * (p.z[i] - head_at(p.y[i]).z);
      }
      const double deviation = deviation_of_sum(*p.scatter, at, weights);
      EXPECT_GT(deviation, 0.05 * kNoise);
      EXPECT_LT(deviation, 0.5 * kNoise);
      ++cases, inside += std::fabs(error) < 2.0 * deviation ? 1 : 0;
    }
  EXPECT_GE(inside, 9 * cases / 10);
}

TEST(SmoothingByNoise, TakesWhatNobodyWouldMeasure) {
  Profile zigzag, few;
  for (int i = 0; i < 60; ++i) zigzag.y.push_back(1e-3 * i), zigzag.z.push_back(i % 2 * 1e-3);
  for (int i = 0; i < 10; ++i) few.y.push_back(1e-3 * i), few.z.push_back(i % 2 * 1e-3);
  EXPECT_EQ(smoothed_by_noise(few).z, few.z);
  for (const double z : smoothed_by_noise(zigzag).z) EXPECT_TRUE(std::isfinite(z));
}

}  // namespace
}  // namespace treadmark::measured
