// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/bilinear_elements.hpp"

#include <gtest/gtest.h>

#include "point_solutions.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"
#include "treadmark/solvers/kalker/halfspace/gauss_legendre.hpp"

namespace treadmark::kalker {
namespace {

TEST(BilinearElements, MatchQuadratureOfThePointSolutions) {
  const double dx = 0.4, dy = 0.7;
  const BilinearElements kernel(dx, dy, kPoisson, kDifference);
  for (const auto& [X, Y] : {std::pair{0.7, 0.0}, {0.0, -1.1}, {-0.8, 0.2}, {0.9, -1.1}, {-1.6, -2.8}, {9.7, 4.1}}) {
    InfluenceBlock expected;
    for_gauss_nodes(-dx, dx, -dy, dy, 24, [&](double x, double y, double weight) {
      const double tent = (1.0 - std::abs(x) / dx) * (1.0 - std::abs(y) / dy);
      add(expected, weight * tent, point_solution(X - x, Y - y, kPoisson, kDifference));
    });
    const InfluenceBlock found = kernel.at(X, Y);
    for (const auto& [name, c] : kAllCoefficients)
      EXPECT_NEAR(found.*c, expected.*c, 1e-11) << name << ' ' << X << ' ' << Y;
  }
}

TEST(BilinearElements, AreTheMeanOfConstantElements) {
  // A tent is a rectangle smeared over the size of a rectangle: holds near the load, too, where the point solutions are
  // singular.
  const double dx = 0.8, dy = 0.5;
  const BilinearElements bilinear(dx, dy, kPoisson, kDifference);
  const ConstantElements constant(dx, dy, kPoisson, kDifference);
  for (const auto& [X, Y] : {std::pair{0.0, 0.0}, {0.4, 0.25}, {0.8, 0.5}, {-0.8, 0.0}, {0.3, -0.1}}) {
    InfluenceBlock expected;
    for_gauss_nodes(-dx / 2, dx / 2, -dy / 2, dy / 2, 40, [&](double x, double y, double weight) {
      add(expected, weight / (dx * dy), constant.at(X - x, Y - y));
    });
    const InfluenceBlock found = bilinear.at(X, Y);
    for (const auto& [name, c] : kAllCoefficients)
      EXPECT_NEAR(found.*c, expected.*c, 1e-6) << name << ' ' << X << ' ' << Y;
  }
}

TEST(BilinearElements, AreTheWeightedSumOfFinerOnes) {
  // Also for long elements, whose cells are split, at their corners and far away.
  for (const auto& [dx, dy] : {std::pair{1.0, 1.6}, {0.3e-3, 1.0}, {40.0, 1.0}}) {
    const BilinearElements whole(dx, dy, kPoisson, kDifference), fine(dx / 2, dy / 2, kPoisson, kDifference);
    for (const double X : {0.0, 0.1 * dx, 0.5 * dx, -dx, 1.7 * dx, 4.0 * dy, -90.0 * dx})
      for (const double Y : {0.0, 0.5 * dy, -0.3 * dy, dy, 3.3 * dx, 25.0 * dy}) {
        InfluenceBlock sum;
        for (int ix = -1; ix <= 1; ++ix)
          for (int iy = -1; iy <= 1; ++iy)
            add(sum, (1.0 - 0.5 * std::abs(ix)) * (1.0 - 0.5 * std::abs(iy)),
                fine.at(X - ix * dx / 2, Y - iy * dy / 2));
        const InfluenceBlock found = whole.at(X, Y);
        for (const auto& [name, c] : kAllCoefficients)
          EXPECT_NEAR(found.*c, sum.*c, 2e-13 * found.nn) << name << ' ' << X << ' ' << Y << ' ' << dx;
      }
  }
}

TEST(BilinearElements, ApproachConstantElementsWithTheSquareOfTheDistance) {
  // A tent's second moments are twice those of a rectangle: dx^2/6 instead of dx^2/12.
  const BilinearElements bilinear(1.0, 1.0, kPoisson, kDifference);
  const ConstantElements constant(1.0, 1.0, kPoisson, kDifference);
  for (const double distance : {10.0, 20.0, 40.0}) {
    const double X = 0.8 * distance, Y = -0.6 * distance;
    const InfluenceBlock b = bilinear.at(X, Y), c = constant.at(X, Y);
    // Laplace operator of 1/r in the plane: 1/r^3.
    EXPECT_NEAR((b.nn / c.nn - 1.0) * distance * distance * 24.0, 1.0, 3.0 / distance);
    EXPECT_NEAR(b.nx / c.nx, 1.0, 1.0 / (distance * distance * distance));  // x / r^2 is harmonic
  }
}

TEST(BilinearElements, AreReciprocalAndSymmetric) {
  const BilinearElements kernel(0.3, 0.5, kPoisson, kDifference);
  EXPECT_TRUE(kernel.coupled() && kernel.symmetric());
  EXPECT_FALSE(BilinearElements(0.3, 0.5, kPoisson, 0.0).coupled());
  for (const auto& [X, Y] : {std::pair{0.1, 0.2}, {0.15, 0.25}, {-0.7, 0.3}, {2.0, -9.0}}) {
    const InfluenceBlock there = kernel.at(X, Y), back = kernel.at(-X, -Y);
    EXPECT_DOUBLE_EQ(there.xn, back.nx);
    EXPECT_DOUBLE_EQ(there.yn, back.ny);
    EXPECT_DOUBLE_EQ(there.xy, back.yx);
    const InfluenceBlock mirror_image = mirrored(there, true, false), beside = kernel.at(-X, Y);
    for (const auto& [name, c] : kAllCoefficients) EXPECT_DOUBLE_EQ(mirror_image.*c, beside.*c) << name;
  }
}

TEST(BilinearElements, OddCoefficientsVanishOnTheAxes) {
  const BilinearElements kernel(0.3, 0.5, kPoisson, kDifference);
  const InfluenceBlock ahead = kernel.at(0.7, 0.0), beside = kernel.at(0.0, -0.2);
  for (const double zero : {ahead.xy, ahead.yn, ahead.ny, beside.xy, beside.xn, beside.nx}) EXPECT_EQ(zero, 0.0);
  EXPECT_GT(std::abs(ahead.xn), 0.0);
  EXPECT_GT(std::abs(beside.yn), 0.0);
}

TEST(BilinearElements, RefuseSizesThatAreNotPositive) { EXPECT_THROW(BilinearElements(1.0, -1.0, 0.3, 0.0), Error); }

TEST(GaussLegendre, IntegratesPolynomialsOfTwiceItsNodes) {
  for (int count = 1; count <= kMostGaussNodes; ++count) {
    const GaussRule rule = gauss_legendre(count);
    ASSERT_EQ(rule.nodes.size(), static_cast<std::size_t>(count));
    for (int power = 0; power < 2 * count; ++power) {
      double sum = 0.0;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], power);
      EXPECT_NEAR(sum, power % 2 == 0 ? 2.0 / (power + 1) : 0.0, 1e-14) << count << ' ' << power;
    }
  }
  EXPECT_THROW(gauss_legendre(0), Error);
  EXPECT_THROW(gauss_legendre(kMostGaussNodes + 1), Error);
}

}  // namespace
}  // namespace treadmark::kalker
