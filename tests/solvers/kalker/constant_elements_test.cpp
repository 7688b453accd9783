// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"

#include <gtest/gtest.h>

#include <complex>

#include "point_solutions.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/halfspace/influence.hpp"
#include "treadmark/tests/support/meant_overflow.hpp"

namespace treadmark::kalker {
namespace {

TEST(ConstantElements, MatchQuadratureOfThePointSolutions) {
  const double dx = 0.4, dy = 0.7;
  const ConstantElements kernel(dx, dy, kPoisson, kDifference);
  for (const auto& [X, Y] : {std::pair{0.6, 0.0}, {0.0, -0.9}, {-0.5, 0.2}, {0.9, -1.1}, {-1.6, -2.8}, {9.7, 4.1}}) {
    InfluenceBlock expected;
    for_gauss_nodes(-dx / 2, dx / 2, -dy / 2, dy / 2, 24, [&](double x, double y, double weight) {
      add(expected, weight, point_solution(X - x, Y - y, kPoisson, kDifference));
    });
    const InfluenceBlock found = kernel.at(X, Y);
    for (const auto& [name, c] : kAllCoefficients)
      EXPECT_NEAR(found.*c, expected.*c, 1e-11) << name << ' ' << X << ' ' << Y;
  }
}

TEST(ConstantElements, AreTheSumOfTheirParts) {
  // Inside, on borders and corners, where quadrature has no accuracy. The parts meet the point in other places than the
  // whole.
  const double dx = 1.0, dy = 1.6;
  const ConstantElements whole(dx, dy, kPoisson, kDifference), part(dx / 5, dy / 4, kPoisson, kDifference);
  for (const double X : {0.0, 0.1, 0.2, 0.3, 0.5, 0.61, 1.0, 1.5, -0.25, -0.5})
    for (const double Y : {0.0, 0.2, 0.4, 0.8, 1.0, 1.6, 2.4, -0.33, -0.8}) {
      InfluenceBlock sum;
      for (int ix = 0; ix < 5; ++ix)
        for (int iy = 0; iy < 4; ++iy) add(sum, 1.0, part.at(X - (ix - 2) * dx / 5, Y - (iy - 1.5) * dy / 4));
      const InfluenceBlock found = whole.at(X, Y);
      for (const auto& [name, c] : kAllCoefficients)
        EXPECT_NEAR(found.*c, sum.*c, 1e-14) << name << ' ' << X << ' ' << Y;
    }
}

/// Integral of 1 / (x + i y) over the rectangle as a series of moments, for points beyond its corners.
std::complex<double> coupling_series(double X, double Y, double dx, double dy) {
  const std::complex<double> corner(0.5 * dx, 0.5 * dy), Z(X, Y);
  std::complex<double> sum;
  for (int n = 0; n < 40; n += 2)
    sum += 4.0 * std::imag(std::pow(corner, n + 2)) / ((n + 1.0) * (n + 2.0) * std::pow(Z, n + 1));
  return sum;
}

TEST(ConstantElements, CouplingKeepsItsDigitsFarAway) {
  const treadmark::testing::MeantOverflow meant;  // in the powers of the series
  for (const auto& [dx, dy] : {std::pair{1.0, 1.0}, {0.4e-3, 0.7e-3}, {1.0, 30.0}, {2000.0, 1.0}})
    for (const double distance : {3.0, 5.0, 20.0, 300.0, 1e4, 1e7})
      for (const double direction : {0.3, 0.7, 1.1, 1.5, 2.5, 4.0, 6.0}) {
        const double R = distance * 0.5 * std::hypot(dx, dy), X = R * std::cos(direction), Y = R * std::sin(direction);
        const std::complex<double> expected = coupling_series(X, Y, dx, dy);
        const double tolerance = 1e-13 * std::abs(expected);
        EXPECT_NEAR(coupling_integral(X, Y, dx, dy), expected.real(), tolerance)
            << dx << ' ' << dy << ' ' << X << ' ' << Y;
        EXPECT_NEAR(coupling_integral(Y, X, dy, dx), -expected.imag(), tolerance)
            << dx << ' ' << dy << ' ' << X << ' ' << Y;
      }
}

TEST(ConstantElements, CouplingKeepsItsDigitsNearTheAxisWhereItVanishes) {
  // The derivative at X = 0 is the integral of dx / (dx^2/4 + y^2) over y.
  const double dx = 0.6, dy = 1.0, X = 1e-9;
  for (const double Y : {0.0, 0.2, 0.8, 3.0, 40.0}) {
    const auto primitive = [&](double y) { return 2.0 * std::atan(2.0 * y / dx); };
    const double expected = X * (primitive(Y + 0.5 * dy) - primitive(Y - 0.5 * dy));
    EXPECT_NEAR(coupling_integral(X, Y, dx, dy) / expected, 1.0, 1e-11) << Y;
  }
}

TEST(ConstantElements, EqualHalfSpacesAreUncoupled) {
  const ConstantElements kernel(0.3, 0.5, kPoisson, 1e-7);
  EXPECT_FALSE(kernel.coupled());
  for (const auto& [X, Y] : {std::pair{0.0, 0.0}, {0.3, -0.5}, {-0.15, 0.25}, {7.0, 1.3}}) {
    const InfluenceBlock c = kernel.at(X, Y);
    EXPECT_EQ(c.nn, influence(Component::nn, X, Y, 0.3, 0.5, kPoisson));
    EXPECT_EQ(c.xx, influence(Component::xx, X, Y, 0.3, 0.5, kPoisson));
    EXPECT_EQ(c.yy, influence(Component::yy, X, Y, 0.3, 0.5, kPoisson));
    EXPECT_EQ(c.xy, influence(Component::xy, X, Y, 0.3, 0.5, kPoisson));
    EXPECT_EQ(c.yx, c.xy);
    for (const double zero : {c.xn, c.yn, c.nx, c.ny}) EXPECT_EQ(zero, 0.0);
  }
}

TEST(ConstantElements, WorkOfTwoElementsOnEachOtherIsReciprocal) {
  const ConstantElements kernel(0.3, 0.5, kPoisson, kDifference);
  for (const auto& [X, Y] : {std::pair{0.1, 0.2}, {0.15, 0.25}, {-0.7, 0.3}, {2.0, -9.0}}) {
    const InfluenceBlock there = kernel.at(X, Y), back = kernel.at(-X, -Y);
    EXPECT_DOUBLE_EQ(there.xn, back.nx);
    EXPECT_DOUBLE_EQ(there.yn, back.ny);
    EXPECT_DOUBLE_EQ(there.xy, back.yx);
    EXPECT_DOUBLE_EQ(there.nn, back.nn);
  }
}

TEST(ConstantElements, AreContinuousAcrossBorders) {
  const ConstantElements kernel(1.0, 1.0, kPoisson, kDifference);
  const double tiny = 1e-10;
  for (const auto& [X, Y] :
       {std::pair{0.5, 0.2}, {0.5, 0.5}, {-0.5, 0.5}, {0.2, -0.5}, {1.0, 0.5}, {0.5, 1.0}, {1.0, 1.0}}) {
    const InfluenceBlock centre = kernel.at(X, Y);
    for (const auto& [ex, ey] : {std::pair{tiny, 0.0}, {-tiny, 0.0}, {0.0, tiny}, {0.0, -tiny}, {tiny, -tiny}}) {
      const InfluenceBlock beside = kernel.at(X + ex, Y + ey);
      for (const auto& [name, c] : kAllCoefficients)
        EXPECT_NEAR(beside.*c, centre.*c, 1e-8) << name << ' ' << X << ' ' << Y;
    }
  }
}

TEST(ConstantElements, RefuseSizesThatAreNotPositive) { EXPECT_THROW(ConstantElements(0.0, 1.0, 0.3, 0.0), Error); }

}  // namespace
}  // namespace treadmark::kalker
