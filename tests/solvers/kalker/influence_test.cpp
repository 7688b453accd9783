// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "treadmark/solvers/kalker/halfspace/influence.hpp"
#include "treadmark/tests/solvers/kalker/point_solutions.hpp"

namespace treadmark::kalker {
namespace {

/// Point solutions of Boussinesq (normal) and Cerruti (tangential), times G, for the pair of equal bodies (both
/// deflect).
double point_load(Component component, double x, double y, double poisson) {
  const double r = std::hypot(x, y);
  switch (component) {
    case Component::nn:
      return (1.0 - poisson) / (std::numbers::pi * r);
    case Component::xx:
      return ((1.0 - poisson) / r + poisson * x * x / (r * r * r)) / std::numbers::pi;
    case Component::yy:
      return ((1.0 - poisson) / r + poisson * y * y / (r * r * r)) / std::numbers::pi;
    case Component::xy:
      return poisson * x * y / (r * r * r) / std::numbers::pi;
  }
  return 0.0;
}

/// Five-point Gauss rule on panels; exact enough when the singularity lies outside the rectangle.
double gauss(const std::function<double(double)>& f, double a, double b, int panels) {
  constexpr std::array<double, 5> node{-0.906179845938664, -0.5384693101056831, 0.0, 0.5384693101056831,
                                       0.906179845938664};
  constexpr std::array<double, 5> weight{0.23692688505618908, 0.47862867049936647, 0.5688888888888889,
                                         0.47862867049936647, 0.23692688505618908};
  const double h = (b - a) / panels;
  double sum = 0.0;
  for (int panel = 0; panel < panels; ++panel)
    for (std::size_t i = 0; i < node.size(); ++i) sum += weight[i] * f(a + h * (panel + 0.5 + 0.5 * node[i]));
  return 0.5 * h * sum;
}

double by_quadrature(Component component, double X, double Y, double dx, double dy, double poisson) {
  const int panels = 60;
  return gauss(
      [&](double xs) {
        return gauss([&](double ys) { return point_load(component, X - xs, Y - ys, poisson); }, -dy / 2, dy / 2,
                     panels);
      },
      -dx / 2, dx / 2, panels);
}

/// Over the loaded element itself: polar coordinates about its centre remove the 1/r singularity.
double own_element_by_quadrature(Component component, double dx, double dy, double poisson) {
  const double corner = std::atan2(dy, dx);
  const auto along_ray = [&](double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double reach = std::min(dx / 2 / std::max(c, 1e-300), dy / 2 / std::max(s, 1e-300));
    return reach * point_load(component, c, s, poisson);
  };
  return 4.0 * (gauss(along_ray, 0.0, corner, 40) + gauss(along_ray, corner, std::numbers::pi / 2, 40));
}

constexpr std::array kComponents{Component::nn, Component::xx, Component::yy, Component::xy};

TEST(Influence, MatchesQuadratureOfThePointSolutions) {
  constexpr double kQuadrature = 1e-10;  // of the Gauss rule next to the singularity
  const double dx = 0.4e-3, dy = 0.7e-3;
  for (const auto component : kComponents)
    for (const auto& [ix, iy] : {std::pair{1, 0}, {0, 1}, {-1, 2}, {3, -2}, {-4, -5}, {25, 13}}) {
      const double X = ix * dx, Y = iy * dy;
      const double expected = by_quadrature(component, X, Y, dx, dy, kPoisson);
      const double scale = dx * dy / std::hypot(X, Y);
      EXPECT_NEAR(influence(component, X, Y, dx, dy, kPoisson), expected, kQuadrature * scale) << ix << ' ' << iy;
    }
}

TEST(Influence, OwnElementMatchesPolarQuadrature) {
  for (const double dy : {0.1, 1.0, 3.0})
    for (const auto component : {Component::nn, Component::xx, Component::yy}) {
      const double expected = own_element_by_quadrature(component, 1.0, dy, kPoisson);
      EXPECT_NEAR(influence(component, 0.0, 0.0, 1.0, dy, kPoisson), expected, 1e-7 * expected);
    }
}

TEST(Influence, UnitSquareUnderPressureSinksAsPublished) {
  // Love 1929: centre of a square of side 1 under unit pressure sinks by 4 ln(1+sqrt 2) (1-nu)/(2 pi G) in each body.
  const double both_bodies = 4.0 * std::log(1.0 + std::numbers::sqrt2) * (1.0 - kPoisson) / std::numbers::pi;
  EXPECT_NEAR(influence(Component::nn, 0, 0, 1, 1, kPoisson), both_bodies, 1e-14);
}

TEST(Influence, KeepsItsDigitsFarAway) {
  // At r = 1e6 elements the rectangle is a point load up to (element / r)^2 = 1e-12.
  for (const auto component : kComponents) {
    const double X = 8e5, Y = 6e5;
    const double expected = point_load(component, X, Y, kPoisson);
    EXPECT_NEAR(influence(component, X, Y, 1, 1, kPoisson) / expected, 1.0, 1e-9);
  }
}

TEST(Influence, HasTheSymmetriesOfARectangle) {
  const auto c = [](Component component, double X, double Y) { return influence(component, X, Y, 0.3, 0.5, 0.3); };
  for (const auto component : {Component::nn, Component::xx, Component::yy}) {
    EXPECT_DOUBLE_EQ(c(component, 0.7, 0.4), c(component, -0.7, 0.4));
    EXPECT_DOUBLE_EQ(c(component, 0.7, 0.4), c(component, 0.7, -0.4));
  }
  EXPECT_DOUBLE_EQ(c(Component::xy, 0.7, 0.4), -c(Component::xy, -0.7, 0.4));
  EXPECT_DOUBLE_EQ(influence(Component::xx, 0.7, 0.4, 0.3, 0.5, 0.3),
                   influence(Component::yy, 0.4, 0.7, 0.5, 0.3, 0.3));
}

TEST(Influence, IsContinuousWhereTheObservationCrossesAnElementEdge) {
  const double tiny = 1e-9;
  for (const auto component : kComponents) {
    const double at_edge = influence(component, 0.5, 0.2, 1, 1, kPoisson);
    EXPECT_NEAR(influence(component, 0.5 + tiny, 0.2, 1, 1, kPoisson), at_edge, 1e-7);
    EXPECT_NEAR(influence(component, 0.5 - tiny, 0.2, 1, 1, kPoisson), at_edge, 1e-7);
    EXPECT_TRUE(std::isfinite(influence(component, 0.5, 0.5, 1, 1, kPoisson)));
  }
}

}  // namespace
}  // namespace treadmark::kalker
