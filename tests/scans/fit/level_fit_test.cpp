// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/level_fit.hpp"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/scans/fit/level_samples.hpp"

namespace treadmark::scans {
namespace {

constexpr double kLevelLength = 0.4, kLevelWidth = 0.06;
constexpr std::size_t kLevelRows = 64, kLevelColumns = 16;

/// A small problem: points with weights of different size, a few of them zero, and values without meaning.
struct Problem {
  Band band;
  BandPoints points;
  std::vector<float> residual, weight;

  Problem(bool closed, std::uint64_t seed) : band(tests::straight_band(kLevelLength, kLevelWidth, closed)) {
    points = tests::sorted(band, kLevelRows, kLevelColumns,
                           tests::scattered(band, kLevelRows, kLevelColumns, 3, 100e-6, seed,
                                            [](double a, double s) { return 0.3e-3 * std::sin(20.0 * a + 50.0 * s); }));
    residual = points.d;
    Random random(seed + 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double sigma = 50e-6 * (0.5 + random.uniform());
      weight.push_back(random.uniform() < 0.1 ? 0.0f : static_cast<float>(1.0 / (sigma * sigma)));
    }
  }
};

double basis(const Problem& p, const SplineLevel& level, std::size_t f, std::size_t i) {
  return tests::function_value(level, f, p.points.a[i], p.points.s[i]);
}

TEST(LevelFit, SumsAgreeWithBruteForce) {
  for (const bool closed : {false, true})
    for (const std::size_t along : {4u, 16u}) {
      Problem p(closed, 1);
      p.residual[10] = 5e-3f;  // is cut off
      p.residual[500] = -5e-3f;
      const SplineLevel level = tests::level_of(kLevelLength, kLevelWidth, along, 4, closed);
      const FunctionSums sums = sum_functions(p.points, p.residual, p.weight, level);
      std::vector<double> wbr(level.size(), 0.0), wbb(level.size(), 0.0), count(level.size(), 0.0),
          scale(level.size(), 0.0);
      for (std::size_t i = 0; i < p.points.size(); ++i) {
        if (p.weight[i] == 0.0f) continue;
        const double w = p.weight[i], most = 4.0 / std::sqrt(w), r = std::clamp<double>(p.residual[i], -most, most);
        for (std::size_t f = 0; f < level.size(); ++f) {
          const double b = basis(p, level, f, i);
          wbr[f] += w * b * r;
          scale[f] += w * b * std::fabs(r);
          wbb[f] += w * b * b;
          count[f] += b;
        }
      }
      ASSERT_EQ(sums.wbr.size(), level.size());
      for (std::size_t f = 0; f < level.size(); ++f) {
        EXPECT_NEAR(sums.wbr[f], wbr[f], 1e-5 * scale[f]);
        EXPECT_NEAR(sums.wbb[f], wbb[f], 1e-5 * wbb[f] + 1e-3);
        EXPECT_NEAR(sums.points[f], count[f], 1e-5 * count[f] + 1e-6);
      }
    }
}

/// Coefficients of the active functions by dense algebra in double precision.
Eigen::VectorXd dense(const Problem& p, const SplineLevel& level, const std::vector<std::size_t>& functions,
                      std::span<const float> ridge) {
  const auto n = static_cast<Eigen::Index>(functions.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n), b(n);
  for (std::size_t i = 0; i < p.points.size(); ++i) {
    for (Eigen::Index k = 0; k < n; ++k) b[k] = basis(p, level, functions[static_cast<std::size_t>(k)], i);
    matrix += static_cast<double>(p.weight[i]) * b * b.transpose();
    rhs += static_cast<double>(p.weight[i]) * p.residual[i] * b;
  }
  const double trace = matrix.trace();
  for (Eigen::Index k = 0; k < n; ++k)
    matrix(k, k) +=
        ridge.empty() ? 1e-5 * trace / static_cast<double>(n) : ridge[functions[static_cast<std::size_t>(k)]];
  return matrix.ldlt().solve(rhs);
}

void expect_dense(bool closed, std::size_t along, std::size_t across, bool some, bool with_ridge) {
  Problem p(closed, 2);
  SplineLevel level = tests::level_of(kLevelLength, kLevelWidth, along, across, closed);
  std::vector<float> ridge;
  Random random(5);
  if (with_ridge)
    for (std::size_t f = 0; f < level.size(); ++f) ridge.push_back(static_cast<float>(1e9 * (0.2 + random.uniform())));
  std::vector<std::size_t> functions;
  for (std::size_t f = 0; f < level.size(); ++f) {
    level.active[f] = some && random.uniform() < 0.5 ? 0 : 1;
    if (level.active[f] != 0) functions.push_back(f);
  }
  const Eigen::VectorXd wanted = dense(p, level, functions, ridge);
  const std::vector<float> before = p.residual;
  const LevelSolution solution = fit_level(p.points, p.residual, p.weight, ridge, level);
  EXPECT_GT(solution.iterations, 0);
  EXPECT_LT(solution.reduction, 1e-6);
  SplineField field(kLevelLength, kLevelWidth, closed), exact(kLevelLength, kLevelWidth, closed);
  SplineLevel dense_level = level;
  for (std::size_t k = 0; k < functions.size(); ++k)
    dense_level.coefficient[functions[k]] = static_cast<float>(wanted[static_cast<Eigen::Index>(k)]);
  field.add(level);
  exact.add(dense_level);
  for (std::size_t f = 0; f < level.size(); ++f)
    if (level.active[f] == 0) {
      EXPECT_EQ(level.coefficient[f], 0.0f);
    }
  const double size = wanted.cwiseAbs().maxCoeff();
  for (std::size_t k = 0; k < functions.size(); ++k)
    EXPECT_NEAR(level.coefficient[functions[k]], wanted[static_cast<Eigen::Index>(k)],
                (with_ridge ? 2e-5 : 2e-3) * size);
  for (std::size_t i = 0; i < p.points.size(); ++i) {
    ASSERT_NEAR(field.value(p.points.a[i], p.points.s[i]), exact.value(p.points.a[i], p.points.s[i]), 1e-8);
    // points without weight are followed too
    ASSERT_NEAR(p.residual[i], before[i] - field.value(p.points.a[i], p.points.s[i]), 1e-9);
  }
}

TEST(LevelFit, AgreesWithDenseLeastSquares) {
  for (const bool closed : {false, true})
    for (const bool some : {false, true})
      for (const bool ridge : {false, true}) {
        SCOPED_TRACE(::testing::Message() << "closed " << closed << " some " << some << " ridge " << ridge);
        expect_dense(closed, 4, 2, some, ridge);  // round a closed band every function meets every other on both sides
        expect_dense(closed, 16, 4, some, ridge);
      }
}

TEST(LevelFit, ALargeRidgeHoldsCoefficientsBack) {
  Problem p(true, 3);
  SplineLevel level = tests::level_of(kLevelLength, kLevelWidth, 8, 2, true);
  const std::vector<float> ridge(level.size(), 1e16f), before = p.residual;
  fit_level(p.points, p.residual, p.weight, ridge, level);
  for (const float c : level.coefficient) EXPECT_LT(std::fabs(c), 1e-8f);
  for (std::size_t i = 0; i < before.size(); ++i) ASSERT_NEAR(p.residual[i], before[i], 1e-8);
}

TEST(LevelFit, TheSameForAnyNumberOfThreads) {
  std::vector<std::vector<float>> coefficients, residuals;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    Problem p(true, 4);
    SplineLevel level = tests::level_of(kLevelLength, kLevelWidth, 32, 8, true);
    fit_level(p.points, p.residual, p.weight, {}, level);
    coefficients.push_back(level.coefficient);
    residuals.push_back(p.residual);
  }
  EXPECT_EQ(coefficients[0], coefficients[1]);
  EXPECT_EQ(residuals[0], residuals[1]);
}

}  // namespace
}  // namespace treadmark::scans
