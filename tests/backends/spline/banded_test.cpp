// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "treadmark/backends/spline/banded.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::spline {
namespace {

constexpr double kBandedRounding = 1e-11;  // random matrices with condition numbers up to some thousands

TEST(Banded, CholeskyAgreesWithADenseSolver) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> d(-1.0, 1.0);
  for (const int band : {1, 2, 3}) {
    const int n = 12;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    BandedCholesky matrix(n, band);
    for (int i = 0; i < n; ++i)
      for (int j = std::max(0, i - band); j <= i; ++j) {
        const double value = i == j ? 4.0 + d(random) : d(random);
        dense(i, j) = dense(j, i) = matrix.at(i, j) = value;
      }
    Eigen::VectorXd rhs = Eigen::VectorXd::NullaryExpr(n, [&] { return d(random); });
    std::vector<double> x(rhs.data(), rhs.data() + n);
    matrix.factor();
    matrix.solve(x);
    const Eigen::VectorXd expected = dense.fullPivLu().solve(rhs);
    for (int i = 0; i < n; ++i) EXPECT_NEAR(x[static_cast<std::size_t>(i)], expected(i), kBandedRounding);
  }
}

TEST(Banded, LuWithPivotingAgreesWithADenseSolver) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> d(-1.0, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 4 + trial, band = 3;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    BandedLu matrix(n, band);
    for (int i = 0; i < n; ++i)
      for (int j = std::max(0, i - band); j <= std::min(n - 1, i + band); ++j)
        dense(i, j) = matrix.at(i, j) = i == j ? 0.01 * d(random) : d(random);  // small pivots
    Eigen::VectorXd rhs = Eigen::VectorXd::NullaryExpr(n, [&] { return d(random); });
    std::vector<double> x(rhs.data(), rhs.data() + n);
    matrix.factor();
    matrix.solve(x);
    const Eigen::VectorXd expected = dense.fullPivLu().solve(rhs);
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(x[static_cast<std::size_t>(i)], expected(i), kBandedRounding * (1 + expected.norm()));
  }
}

TEST(Banded, SingularMatricesAreRefused) {
  BandedCholesky indefinite(2, 1);
  indefinite.at(0, 0) = 1.0, indefinite.at(1, 0) = 2.0, indefinite.at(1, 1) = 1.0;
  EXPECT_THROW(indefinite.factor(), Error);
  BandedLu zero(3, 1);
  EXPECT_THROW(zero.factor(), Error);
}

}  // namespace
}  // namespace treadmark::spline
