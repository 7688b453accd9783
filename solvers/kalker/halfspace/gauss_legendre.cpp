// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/gauss_legendre.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark::kalker {

namespace {

/// Legendre polynomial of degree n and its derivative at |x| < 1.
std::pair<double, double> legendre(int n, double x) {
  double before = 1.0, value = x;
  for (int k = 2; k <= n; ++k) before = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * before) / k);
  return {value, n * (x * value - before) / (x * x - 1.0)};
}

struct StoredRule {
  std::vector<double> nodes, weights;
};

StoredRule make_rule(int n) {
  StoredRule rule;
  for (int i = n; i >= 1; --i) {
    double x = std::cos(std::numbers::pi * (i - 0.25) / (n + 0.5));
    for (int iteration = 0; iteration < 8; ++iteration) {  // Newton converges in four
      const auto [value, slope] = legendre(n, x);
      x -= value / slope;
    }
    if (2 * i == n + 1) x = 0.0;
    const double slope = legendre(n, x).second;
    rule.nodes.push_back(x);
    rule.weights.push_back(2.0 / ((1.0 - x * x) * slope * slope));
  }
  return rule;
}

std::array<StoredRule, kMostGaussNodes> make_rules() {
  std::array<StoredRule, kMostGaussNodes> rules;
  for (int n = 1; n <= kMostGaussNodes; ++n) rules[static_cast<std::size_t>(n - 1)] = make_rule(n);
  return rules;
}

}  // namespace

GaussRule gauss_legendre(int count) {
  static const std::array<StoredRule, kMostGaussNodes> rules = make_rules();
  if (count < 1 || count > kMostGaussNodes)
    throw Error(ErrorKind::configuration, "there is no Gauss rule of " + std::to_string(count) + " nodes");
  const StoredRule& rule = rules[static_cast<std::size_t>(count - 1)];
  return {rule.nodes, rule.weights};
}

}  // namespace treadmark::kalker
