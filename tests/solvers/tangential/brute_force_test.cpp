// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <array>
#include <random>

#include "tangential_cases.hpp"

namespace treadmark::kalker::testing {
namespace {

/// Agreement of tractions, relative to the largest bound: both methods are iterated far below.
constexpr double kAgreement = 1e-8;

/// Kernel integrals of Cerruti's solution, term by term at the corners (Kalker 1990, eq. for rectangles).
std::array<double, 3> coefficients(double X, double Y, double dx, double dy, double nu) {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const int i : {-1, 1})
    for (const int j : {-1, 1}) {
      const double x = X + 0.5 * i * dx, y = Y + 0.5 * j * dy, r = std::hypot(x, y), sign = i * j;
      const double j1 = y * std::log(x + r), j2 = x * std::log(y + r);
      xx += sign * (j1 + (1.0 - nu) * j2);
      yy += sign * (j2 + (1.0 - nu) * j1);
      xy -= sign * nu * r;
    }
  return {xx / std::numbers::pi, xy / std::numbers::pi, yy / std::numbers::pi};
}

/// Slip of a small problem with a dense matrix.
struct Dense {
  int n = 0;
  std::vector<double> a, w, bound;  ///< 2n x 2n, 2n, n

  explicit Dense(const Case& c) {
    const ContactProblem& p = c.problem;
    const Grid2& g = p.grid;
    n = static_cast<int>(g.size());
    const CombinedMaterial m = combine(p.material);
    const bool rolling = p.regime == Regime::steady;
    const double direction = std::cos(p.rolling.chi) > 0.0 ? 1.0 : -1.0, step = rolling ? g.dx : 1.0;
    a.resize(static_cast<std::size_t>(4 * n * n));
    w.resize(static_cast<std::size_t>(2 * n));
    for (int i = 0; i < n; ++i) {
      const int ix = i % g.nx, iy = i / g.nx;
      bound.push_back(p.friction.kinetic * c.solution.pressure[static_cast<std::size_t>(i)]);
      const double x = g.x(ix) - p.creepage.spin_x + (rolling ? direction * p.rolling.spin_offset_factor * step : 0.0);
      const double y = g.y(iy) - p.creepage.spin_y;
      w[static_cast<std::size_t>(i)] = step * (p.creepage.xi - p.creepage.phi * y);
      w[static_cast<std::size_t>(n + i)] = step * (p.creepage.eta + p.creepage.phi * x);
      for (int j = 0; j < n; ++j) {
        const double X = g.x(ix) - g.x(j % g.nx), Y = g.y(iy) - g.y(j / g.nx);
        std::array<double, 3> b = coefficients(X, Y, g.dx, g.dy, m.poisson);
        double layer = ix == j % g.nx && iy == j / g.nx ? p.material.layer_flexibility : 0.0;
        if (rolling) {
          const std::array<double, 3> before = coefficients(X + direction * g.dx, Y, g.dx, g.dy, m.poisson);
          for (std::size_t k = 0; k < 3; ++k) b[k] -= before[k];
          if (iy == j / g.nx && ix + static_cast<int>(direction) == j % g.nx) layer -= p.material.layer_flexibility;
        }
        at(i, j) = b[0] / m.shear_modulus + layer;
        at(i, n + j) = at(n + i, j) = b[1] / m.shear_modulus;
        at(n + i, n + j) = b[2] / m.shear_modulus + layer;
      }
    }
  }
  double& at(int i, int j) { return a[static_cast<std::size_t>(i * 2 * n + j)]; }

  std::vector<double> slip(const std::vector<double>& p) const {
    std::vector<double> s(w);
    const std::size_t m = s.size();
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < m; ++j) s[i] += a[i * m + j] * p[j];
    return s;
  }

  /// Extragradient method (Korpelevich 1976): converges for every monotone operator, slowly.
  std::vector<double> solve(int iterations) const {
    const std::size_t m = w.size(), count = bound.size();
    double norm = 0.0;
    for (std::size_t i = 0; i < m; ++i) {
      double row = 0.0;
      for (std::size_t j = 0; j < m; ++j) row += std::abs(a[i * m + j]);
      norm = std::max(norm, row);
    }
    const double step = 0.7 / norm;
    const auto projected = [&](std::vector<double> p) {
      for (std::size_t i = 0; i < count; ++i) {
        const double size = std::hypot(p[i], p[count + i]);
        if (size <= bound[i]) continue;
        p[i] *= bound[i] / size;
        p[count + i] *= bound[i] / size;
      }
      return p;
    };
    const auto moved = [&](const std::vector<double>& p, const std::vector<double>& s) {
      std::vector<double> q(p);
      for (std::size_t i = 0; i < m; ++i) q[i] -= step * s[i];
      return projected(q);
    };
    std::vector<double> p(m);
    for (int k = 0; k < iterations; ++k) {
      const std::vector<double> q = moved(p, slip(moved(p, slip(p))));
      const double change = distance(p, q);
      p = q;
      if (change <= 1e-15 * largest(bound)) break;
    }
    return p;
  }
};

/// Every element in contact, pressures between 20 and 100 % of a maximum.
Case random_case(std::mt19937& generator, Regime regime) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Case c;
  c.problem.grid = {-0.5e-3, -0.6e-3, 0.2e-3, 0.2e-3 * (0.5 + unit(generator)), 6, 6};
  c.problem.regime = regime;
  c.problem.material.poisson_1 = c.problem.material.poisson_2 = 0.5 * unit(generator);
  c.problem.friction.kinetic = 0.3;
  c.problem.rolling.chi = unit(generator) < 0.5 ? 0.0 : std::numbers::pi;
  c.problem.settings.eps = 1e-11;
  if (unit(generator) < 0.4) c.problem.material.layer_flexibility = unit(generator) * c.problem.grid.dx / 82e9;
  for (std::size_t i = 0; i < c.problem.grid.size(); ++i)
    c.solution.pressure.push_back(1e9 * (0.2 + 0.8 * unit(generator)));
  // From mostly adhesion to mostly slip.
  const double scale = std::pow(10.0, -4.0 + 2.0 * unit(generator)) * (regime == Regime::shift ? 1e-3 : 1.0);
  const double angle = 2.0 * std::numbers::pi * unit(generator);
  c.problem.creepage = {scale * std::cos(angle), scale * std::sin(angle), 3e3 * (unit(generator) - 0.5) * scale,
                        0.1e-3 * unit(generator), -0.1e-3 * unit(generator)};
  return c;
}

void expect_agreement(Regime regime, unsigned seed) {
  std::mt19937 generator(seed);
  int adhesion = 0, slip = 0;
  for (int k = 0; k < 8; ++k) {
    Case c = random_case(generator, regime);
    ASSERT_EQ(c.solve().tangential.status, Status::ok) << c.solution.tangential.message;
    const Dense dense(c);
    const std::vector<double> p = dense.solve(20000);
    const std::size_t n = dense.bound.size();
    const double scale = largest(dense.bound);
    EXPECT_LE(distance(c.solution.traction_x, {p.begin(), p.begin() + static_cast<std::ptrdiff_t>(n)}),
              kAgreement * scale);
    EXPECT_LE(distance(c.solution.traction_y, {p.begin() + static_cast<std::ptrdiff_t>(n), p.end()}),
              kAgreement * scale);
    adhesion += totals(c).adhesion;
    slip += totals(c).slip;
  }
  EXPECT_GT(adhesion, 20);  // both kinds of elements were put to the test
  EXPECT_GT(slip, 20);
}

TEST(BruteForce, SteadyRolling) { expect_agreement(Regime::steady, 11); }
TEST(BruteForce, Shift) { expect_agreement(Regime::shift, 12); }

}  // namespace
}  // namespace treadmark::kalker::testing
