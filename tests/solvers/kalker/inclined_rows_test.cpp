// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Contact with coefficients of influence that are turned row by row, solved as a whole.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "owned_problem.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/halfspace/angle_corrected_kernel.hpp"
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"

namespace treadmark::kalker::testing {
namespace {

using RowFields = std::array<std::vector<double>, 3>;  ///< x, y, n

/// A ball of dissimilar material in a groove; partly slipping where it rolls. The grid is not symmetric about the
/// contact.
OwnedProblem groove(Regime regime, int n = 16) {
  const double d = 14e-3 / n;
  const Grid2 grid{-0.5 * (n - 1) * d, -0.5 * (n + 1) * d, d, d, n, n + 3};
  std::vector<double> gap;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) gap.push_back(1.2 * grid.x(ix) * grid.x(ix) + 2.4 * grid.y(iy) * grid.y(iy));
  OwnedProblem owned(grid, std::move(gap));
  ContactProblem& p = owned.problem;
  p.material.shear_modulus_1 = 60e9;
  p.material.poisson_1 = 0.2;
  p.material.layer_flexibility = 2e-15;
  p.normal_force = 8e4;
  p.regime = regime;
  p.creepage = {-8e-4, 4e-4, 0.15};
  if (regime == Regime::shift) p.creepage = {-4e-6, 2e-6, 8e-4};
  p.rolling.step = d;
  p.settings.eps = 1e-9;
  p.settings.max_coupling = 60;
  p.influence.kind = InfluenceSettings::Kind::angle_corrected;
  p.influence.linear = false;
  p.influence.position = {-6e-3, -2e-3, 0.0, 1e-3, 5e-3};
  p.influence.inclination = {-0.5, -0.25, 0.05, 0.1, 0.45};
  return owned;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double d = 0.0;
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) d = std::max(d, std::abs(a[i] - b[i]));
  return d;
}

double largest(const std::vector<double>& a) {
  double d = 0.0;
  for (const double v : a) d = std::max(d, std::abs(v));
  return d;
}

void expect_same(const ContactSolution& a, const ContactSolution& b, double tolerance) {
  ASSERT_EQ(a.status, Status::ok) << a.normal.message << a.tangential.message;
  ASSERT_EQ(b.status, Status::ok) << b.normal.message << b.tangential.message;
  EXPECT_LE(distance(a.pressure, b.pressure), tolerance * largest(b.pressure));
  EXPECT_LE(distance(a.displacement_n, b.displacement_n), tolerance * largest(b.displacement_n));
  if (b.traction_x.empty()) return;
  EXPECT_LE(distance(a.traction_x, b.traction_x), tolerance * largest(b.pressure));
  EXPECT_LE(distance(a.traction_y, b.traction_y), tolerance * largest(b.pressure));
  EXPECT_LE(distance(a.displacement_y, b.displacement_y), tolerance * largest(b.displacement_y));
}

constexpr std::array kRegimes{Regime::frictionless, Regime::shift, Regime::transient, Regime::steady};

/// Two solutions, of which the second goes on from the first where the regime has a history.
std::array<ContactSolution, 2> two_steps(ContactProblem problem) {
  ContactSolver solver;
  ContactSolution first = solver.solve(problem);
  problem.history = HistoryUse::keep_going;
  return {std::move(first), solver.solve(problem)};
}

/// Inclination by its definition: linear from point to point, the first and last piece prolonged.
double inclination(const InfluenceSettings& s, double y) {
  std::size_t i = 0;
  while (i + 2 < s.position.size() && y > s.position[i + 1]) ++i;
  return s.inclination[i] +
         (y - s.position[i]) * (s.inclination[i + 1] - s.inclination[i]) / (s.position[i + 1] - s.position[i]);
}

/// Displacements of all elements by all tractions, term by term.
RowFields dense_displacement(const ContactProblem& p, const ContactSolution& by, double shift_x) {
  const Grid2& g = p.grid;
  const CombinedMaterial m = combine(p.material);
  const ConstantElements half_space(g.dx, g.dy, m.poisson, m.difference);
  RowFields u;
  for (auto& field : u) field.assign(g.size(), 0.0);
  for (std::size_t j = 0; j < g.size(); ++j) {
    if (by.pressure[j] == 0.0) continue;
    const int jx = static_cast<int>(j) % g.nx, jy = static_cast<int>(j) / g.nx;
    const double px = by.traction_x.empty() ? 0.0 : by.traction_x[j],
                 py = by.traction_y.empty() ? 0.0 : by.traction_y[j];
    for (std::size_t i = 0; i < g.size(); ++i) {
      const int ix = static_cast<int>(i) % g.nx, iy = static_cast<int>(i) / g.nx;
      const double X = g.x(ix) - g.x(jx) + shift_x, Y = g.y(iy) - g.y(jy);
      const double alpha = inclination(p.influence, g.y(jy)) - inclination(p.influence, g.y(iy));
      const InfluenceBlock b =
          corrected_for_angle(half_space.at(X, Y), alpha, static_cast<AngleCorrection>(p.influence.variant));
      const double layer = Y == 0.0 && std::abs(X) < 0.1 * g.dx ? p.material.layer_flexibility : 0.0;
      const double pn = by.pressure[j];
      u[0][i] += (b.xx * px + b.xy * py + b.xn * pn) / m.shear_modulus + layer * px;
      u[1][i] += (b.yx * px + b.yy * py + b.yn * pn) / m.shear_modulus + layer * py;
      u[2][i] += (b.nx * px + b.ny * py + b.nn * pn) / m.shear_modulus;
    }
  }
  return u;
}

/// All conditions of contact hold for displacements by the dense matrix. before: the previous instant, or null.
void expect_solution(const ContactProblem& p, const ContactSolution& s, const ContactSolution* before) {
  ASSERT_EQ(s.status, Status::ok) << s.normal.message << s.tangential.message;
  const Grid2& g = p.grid;
  const RowFields u = dense_displacement(p, s, 0.0);
  const double depth = 1e-6 * s.approach;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double e = p.gap[i] - s.approach + u[2][i];
    if (s.pressure[i] > 0.0)
      EXPECT_NEAR(e, 0.0, depth) << i;
    else
      EXPECT_GE(e, -depth) << i;
  }
  EXPECT_NEAR(s.force_n, p.normal_force, 1e-8 * p.normal_force);
  if (p.regime == Regime::frictionless) return;

  const bool steady = p.regime == Regime::steady, rolling = p.regime != Regime::shift;
  const double length = rolling ? g.dx : 1.0, shift = rolling ? g.dx : 0.0;
  RowFields then;
  for (auto& field : then) field.assign(g.size(), 0.0);
  if (steady || before) then = dense_displacement(p, steady ? s : *before, shift);
  int adhesion = 0, slip = 0;
  double typical = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i)
    if (s.pressure[i] > 0.0) typical = std::max({typical, std::abs(s.slip_x[i]), std::abs(s.slip_y[i])});
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (!(s.pressure[i] > 0.0)) continue;
    const double x = g.x(static_cast<int>(i) % g.nx) + (rolling ? p.rolling.spin_offset_factor * g.dx : 0.0);
    const double y = g.y(static_cast<int>(i) / g.nx);
    const double sx = p.creepage.xi - p.creepage.phi * y + (u[0][i] - then[0][i]) / length;
    const double sy = p.creepage.eta + p.creepage.phi * x + (u[1][i] - then[1][i]) / length;
    EXPECT_NEAR(s.slip_x[i], sx, 1e-5 * typical) << i;
    EXPECT_NEAR(s.slip_y[i], sy, 1e-5 * typical) << i;
    const double bound = p.friction.kinetic * s.pressure[i], size = std::hypot(s.traction_x[i], s.traction_y[i]);
    if (s.state[i] == ElementState::adhesion) {
      ++adhesion;
      EXPECT_LE(size, bound * (1.0 + 1e-6));
      EXPECT_LE(std::hypot(sx, sy), 1e-5 * typical);
    } else {
      ++slip;
      EXPECT_NEAR(size, bound, 1e-6 * bound);
      EXPECT_NEAR(s.traction_x[i] * sy - s.traction_y[i] * sx, 0.0, 2e-5 * bound * typical);
      EXPECT_LE(s.traction_x[i] * sx + s.traction_y[i] * sy, 1e-5 * bound * typical);
    }
  }
  EXPECT_GT(adhesion, 8);
  EXPECT_GT(slip, 8);
}

TEST(InclinedRows, SolutionsFulfilTheConditionsOfADenseMatrix) {
  for (const Regime regime : kRegimes)
    for (const int variant : {1, 2, 3, 4}) {
      SCOPED_TRACE(std::to_string(static_cast<int>(regime)) + ", variant " + std::to_string(variant));
      OwnedProblem c = groove(regime);
      c.problem.influence.variant = variant;
      if (regime == Regime::shift || regime == Regime::transient) {
        const auto [first, second] = two_steps(c.problem);
        expect_solution(c.problem, first, nullptr);
        expect_solution(c.problem, second, &first);
      } else {
        expect_solution(c.problem, ContactSolver().solve(c.problem), nullptr);
      }
    }
}

TEST(InclinedRows, OnAStraightLineTheyAreTheLinearMethod) {
  for (const Regime regime : kRegimes)
    for (const int variant : {1, 2, 3, 4}) {
      SCOPED_TRACE(std::to_string(static_cast<int>(regime)) + ", variant " + std::to_string(variant));
      OwnedProblem c = groove(regime);
      c.problem.influence.variant = variant;
      for (std::size_t i = 0; i < c.problem.influence.position.size(); ++i)
        c.problem.influence.inclination[i] = 0.1 + 70.0 * c.problem.influence.position[i];
      const auto rows = two_steps(c.problem);
      c.problem.influence.linear = true;
      const auto line = two_steps(c.problem);
      expect_same(rows[0], line[0], 1e-6);
      expect_same(rows[1], line[1], 1e-6);
    }
}

TEST(InclinedRows, OfOneInclinationTheyAreTheHalfSpace) {
  for (const Regime regime : kRegimes) {
    OwnedProblem c = groove(regime);
    c.problem.influence.inclination.assign(5, 0.4);
    const auto rows = two_steps(c.problem);
    c.problem.influence = {};
    const auto plane = two_steps(c.problem);
    expect_same(rows[0], plane[0], 1e-6);
    expect_same(rows[1], plane[1], 1e-6);
  }
}

TEST(InclinedRows, MirrorImagesStayMirrorImages) {
  // the same groove seen from the other side
  for (const int variant : {1, 2, 3, 4}) {
    OwnedProblem c = groove(Regime::steady);
    c.problem.influence.variant = variant;
    Grid2& grid = c.problem.grid;
    grid.y0 = -0.5 * (grid.ny - 1) * grid.dy;
    for (int iy = 0; iy < grid.ny; ++iy)
      for (int ix = 0; ix < grid.nx; ++ix)
        c.gap[grid.index(ix, iy)] = 1.2 * grid.x(ix) * grid.x(ix) + 2.4 * grid.y(iy) * grid.y(iy);
    const ContactSolution a = ContactSolver().solve(c.problem);
    OwnedProblem m = c;
    InfluenceSettings& in = m.problem.influence;
    for (std::size_t i = 0; i < in.position.size(); ++i) {
      in.position[i] = -c.problem.influence.position[in.position.size() - 1 - i];
      in.inclination[i] = -c.problem.influence.inclination[in.position.size() - 1 - i];
    }
    m.problem.creepage.eta *= -1.0;
    m.problem.creepage.phi *= -1.0;
    const ContactSolution b = ContactSolver().solve(m.problem);
    ASSERT_EQ(a.status, Status::ok);
    ASSERT_EQ(b.status, Status::ok);
    const double scale = largest(a.pressure);
    for (int iy = 0; iy < grid.ny; ++iy)
      for (int ix = 0; ix < grid.nx; ++ix) {
        const std::size_t i = grid.index(ix, iy), j = grid.index(ix, grid.ny - 1 - iy);
        EXPECT_NEAR(b.pressure[j], a.pressure[i], 1e-6 * scale);
        EXPECT_NEAR(b.traction_x[j], a.traction_x[i], 1e-6 * scale);
        EXPECT_NEAR(b.traction_y[j], -a.traction_y[i], 1e-6 * scale);
      }
  }
}

/// A sequence keeps coefficients, but not the inclinations of another instant.
TEST(InclinedRows, InclinationsMayChangeFromCaseToCase) {
  OwnedProblem c = groove(Regime::steady);
  ContactSolver solver;
  const ContactSolution first = solver.solve(c.problem);
  OwnedProblem other = c;
  for (double& a : other.problem.influence.inclination) a *= 0.5;
  const ContactSolution second = solver.solve(other.problem);
  expect_same(second, ContactSolver().solve(other.problem), 1e-6);
  EXPECT_GT(distance(first.pressure, second.pressure), 1e-4 * largest(second.pressure));
  expect_same(solver.solve(c.problem), first, 1e-6);
}

TEST(InclinedRows, SensitivitiesAreDerivatives) {
  OwnedProblem c = groove(Regime::steady);
  c.problem.sensitivities = true;
  c.problem.material.poisson_1 = c.problem.material.poisson_2;
  c.problem.creepage = {-2e-4, 1e-4, 0.05};
  c.problem.settings.max_coupling = 1;
  c.problem.settings.eps = 1e-10;
  const ContactSolution s = ContactSolver().solve(c.problem);
  ASSERT_TRUE(s.sensitivities);
  const double step = 1e-8;
  ContactProblem moved = c.problem;
  moved.creepage.eta += step;
  const ContactSolution t = ContactSolver().solve(moved);
  const double scale = std::abs(s.sensitivities->by_creepage[1][1]);
  EXPECT_NEAR((t.force_y - s.force_y) / step, s.sensitivities->by_creepage[1][1], 2e-3 * scale);
  EXPECT_NEAR((t.force_x - s.force_x) / step, s.sensitivities->by_creepage[1][0], 2e-3 * scale);
}

TEST(InclinedRows, ApproximatePressuresKnowThemToo) {
  OwnedProblem c = groove(Regime::frictionless);
  c.problem.force_prescribed = false;
  c.problem.approach = 3e-5;
  c.problem.normal_model = NormalModel::kpec;
  for (double& a : c.problem.influence.inclination) a *= 2.0;
  const double bent = ContactSolver().solve(c.problem).force_n;
  c.problem.influence = {};
  const double plane = ContactSolver().solve(c.problem).force_n;
  EXPECT_GT(std::abs(bent / plane - 1.0), 1e-3);
  EXPECT_LT(std::abs(bent / plane - 1.0), 0.2);
}

TEST(InclinedRows, RefuseTablesWithoutMeaning) {
  OwnedProblem c = groove(Regime::steady);
  c.problem.influence.inclination.pop_back();
  EXPECT_THROW(ContactSolver().solve(c.problem), Error);
}

}  // namespace
}  // namespace treadmark::kalker::testing
