// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/toeplitz_operator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <thread>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/halfspace/influence.hpp"

namespace treadmark::kalker {
namespace {

double lopsided_kernel(int dix, int diy) { return 1.0 / (1.0 + std::abs(dix - 0.3) + 2.0 * std::abs(diy + 0.4)); }

std::vector<double> random_values(std::size_t size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> field(size);
  for (double& value : field) value = uniform(generator);
  return field;
}

std::vector<double> direct_sum(int nx, int ny, const std::vector<double>& p) {
  std::vector<double> u(p.size());
  for (int i = 0; i < nx * ny; ++i)
    for (int j = 0; j < nx * ny; ++j)
      u[static_cast<std::size_t>(i)] +=
          lopsided_kernel(i % nx - j % nx, i / nx - j / nx) * p[static_cast<std::size_t>(j)];
  return u;
}

/// Rounding of sums of at most a thousand terms of order one.
constexpr double kSumRounding = 1e-12;

class ToeplitzShapes : public ::testing::TestWithParam<std::pair<int, int>> {};

TEST_P(ToeplitzShapes, EqualsTheDirectSum) {
  const auto [nx, ny] = GetParam();
  const ToeplitzOperator op(nx, ny, lopsided_kernel);
  const auto p = random_values(op.size(), 5);
  std::vector<double> u(op.size());
  op.apply(p, u);
  const auto expected = direct_sum(nx, ny, p);
  for (std::size_t i = 0; i < u.size(); ++i)
    ASSERT_NEAR(u[i], expected[i], kSumRounding * static_cast<double>(u.size()));
}

INSTANTIATE_TEST_SUITE_P(Sizes, ToeplitzShapes,
                         ::testing::Values(std::pair{1, 1}, std::pair{5, 1}, std::pair{1, 6}, std::pair{8, 8},
                                           std::pair{9, 8}, std::pair{130, 1}, std::pair{1, 77}, std::pair{23, 31}));

TEST(ToeplitzTransform, KernelsAndFieldsMayBeSummedBetweenTransforms) {
  const int nx = 12, ny = 9;
  const ToeplitzTransform transform(nx, ny);
  const auto one = transform.kernel_spectrum(lopsided_kernel);
  const auto two =
      transform.kernel_spectrum([](int dix, int diy) { return influence(Component::xy, dix, diy, 1, 1, 0.3); });
  const auto p = random_values(transform.size(), 1), q = random_values(transform.size(), 2);
  Spectrum sp(transform.spectrum_size()), sq(transform.spectrum_size());
  transform.forward(p, sp);
  transform.forward(q, sq);
  for (std::size_t k = 0; k < sp.size(); ++k) sp[k] = one[k] * sp[k] + two[k] * sq[k];
  std::vector<double> together(transform.size()), u1(transform.size()), u2(transform.size());
  transform.inverse(sp, together);
  ToeplitzOperator(nx, ny, lopsided_kernel).apply(p, u1);
  ToeplitzOperator(nx, ny, [](int dix, int diy) { return influence(Component::xy, dix, diy, 1, 1, 0.3); }).apply(q, u2);
  for (std::size_t i = 0; i < u1.size(); ++i) ASSERT_NEAR(together[i], u1[i] + u2[i], 1e-10);
}

TEST(ToeplitzOperator, IsBitwiseReproducibleAcrossThreads) {
  const ToeplitzOperator op(40, 33, lopsided_kernel);
  const auto p = random_values(op.size(), 9);
  std::vector<std::vector<double>> results(4, std::vector<double>(op.size()));
  std::vector<std::thread> threads;
  for (auto& u : results)
    threads.emplace_back([&] {
      for (int repeat = 0; repeat < 10; ++repeat) op.apply(p, u);
    });
  for (std::thread& thread : threads) thread.join();
  for (const auto& u : results) EXPECT_EQ(u, results.front());
}

TEST(ToeplitzOperator, RejectsFieldsOfAnotherSize) {
  const ToeplitzOperator op(4, 3, lopsided_kernel);
  std::vector<double> p(12), u(11);
  EXPECT_THROW(op.apply(p, u), Error);
  EXPECT_THROW(ToeplitzOperator(0, 3, lopsided_kernel), Error);
}

}  // namespace
}  // namespace treadmark::kalker
