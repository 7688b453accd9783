// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/optimisation/minimise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "treadmark/core/constants.hpp"

namespace treadmark::optimisation {
namespace {

constexpr double kFound = 1e-3;  // of the tolerance with which the search ends

class Minimise : public ::testing::TestWithParam<Method> {};

/// (x - 2)^2 + (y - 1)^2 on the line x + y <= 1: the foot of the perpendicular, (1, 0).
TEST_P(Minimise, FindsTheFootOfThePerpendicular) {
  Minimisation problem;
  problem.start = {0.0, 0.5}, problem.lower = {-3.0, -3.0}, problem.upper = {3.0, 3.0};
  problem.constraints = 1;
  problem.method = GetParam();
  problem.tolerance = 1e-7;
  problem.at = [](const std::vector<double>& p) {
    const double x = p[0] - 2.0, y = p[1] - 1.0;
    return PointValues{x * x + y * y, {2.0 * x, 2.0 * y}, {p[0] + p[1] - 1.0}, {1.0, 1.0}};
  };
  const Minimum found = minimise(problem);
  EXPECT_EQ(found.report.status, Status::ok) << found.report.message;
  EXPECT_NEAR(found.point[0], 1.0, kFound);
  EXPECT_NEAR(found.point[1], 0.0, kFound);
  EXPECT_GT(found.report.iterations, 1);
}

/// The largest of (x - 1)^2 + 1 and (x + 1)^2 is least where they meet, at x = 1/4: t is a variable above both.
TEST_P(Minimise, FindsTheLeastOfTheLargest) {
  Minimisation problem;
  problem.start = {-0.9, 5.0}, problem.lower = {-2.0, -kInfinity}, problem.upper = {2.0, kInfinity};
  problem.constraints = 2;
  problem.method = GetParam();
  problem.tolerance = 1e-7;
  problem.at = [](const std::vector<double>& p) {
    const double a = p[0] - 1.0, b = p[0] + 1.0;
    return PointValues{p[1], {0.0, 1.0}, {a * a + 1.0 - p[1], b * b - p[1]}, {2.0 * a, -1.0, 2.0 * b, -1.0}};
  };
  const Minimum found = minimise(problem);
  EXPECT_NEAR(found.point[0], 0.25, kFound);
  EXPECT_NEAR(found.point[1], 1.5625, kFound);
}

TEST_P(Minimise, TurnsBackWhereThereIsNothing) {
  Minimisation problem;
  problem.start = {0.0}, problem.lower = {-5.0}, problem.upper = {5.0};
  problem.method = GetParam();
  problem.tolerance = 1e-7;
  bool beyond = false;
  problem.at = [&](const std::vector<double>& p) -> std::optional<PointValues> {
    beyond |= p[0] > 1.0;
    if (p[0] > 1.0) return std::nullopt;
    const double x = p[0] - 0.9;
    return PointValues{40.0 * x * x, {80.0 * x}, {}, {}};  // so steep that the first step goes too far
  };
  EXPECT_NEAR(minimise(problem).point[0], 0.9, kFound);
  EXPECT_TRUE(beyond);
}

TEST_P(Minimise, EndsWhereThereIsNothingBeside) {
  Minimisation problem;
  problem.start = {0.0}, problem.lower = {-5.0}, problem.upper = {5.0};
  problem.method = GetParam();
  int asked = 0;
  problem.at = [&](const std::vector<double>& p) -> std::optional<PointValues> {
    if (++asked > 1000) throw std::runtime_error("endless");
    if (p[0] > 0.0) return std::nullopt;
    return PointValues{-p[0], {-1.0}, {}, {}};
  };
  const Minimum found = minimise(problem);
  EXPECT_EQ(found.report.status, Status::not_converged) << found.report.message;
  EXPECT_EQ(found.point[0], 0.0);
}

TEST_P(Minimise, PassesOnWhatIsThrownAndAsksForTheSamePointsAgain) {
  std::vector<std::vector<double>> first, again;
  for (std::vector<std::vector<double>>* asked : {&first, &again}) {
    Minimisation problem;
    problem.start = {0.3, 0.4}, problem.lower = {-1.0, -1.0}, problem.upper = {1.0, 1.0};
    problem.method = GetParam();
    problem.at = [&](const std::vector<double>& p) {
      asked->push_back(p);
      if (asked->size() == 4) throw std::runtime_error("enough");
      const double bent = p[1] - p[0] * p[0];
      return PointValues{100.0 * bent * bent + (1.0 - p[0]) * (1.0 - p[0]),
                         {-400.0 * p[0] * bent - 2.0 * (1.0 - p[0]), 200.0 * bent},
                         {},
                         {}};
    };
    EXPECT_THROW(minimise(problem), std::runtime_error);
  }
  EXPECT_EQ(first.size(), 4u);
  EXPECT_EQ(first, again);
}

INSTANTIATE_TEST_SUITE_P(Methods, Minimise, ::testing::Values(Method::slsqp, Method::mma));

}  // namespace
}  // namespace treadmark::optimisation
