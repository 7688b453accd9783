// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "treadmark/solvers/kalker/fastsim/fastsim.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/tests/support/documented_errors.hpp"

namespace treadmark::kalker {
namespace {

using FirstStep = FastsimSettings::FirstStep;

constexpr double kA = 6e-3, kB = 4e-3, kFastsimLoad = 80e3, kFastsimMu = 0.3, kFlexibility = 2.5e-14;
/// Peak of the parabolic bound [Pa].
constexpr double kBound = kFastsimMu * 2.0 * kFastsimLoad / (std::numbers::pi * kA * kB);

/// Force of FASTSIM with a parabolic bound, n x n elements across the ellipse, which lies off their middle by
/// shift_x, shift_y elements.
Vec2 force_at(int n, FirstStep first_step, const Creepage& creepage, double shift_x, double shift_y) {
  const HertzShape shape = hertz_from_semi_axes(kA, kB, {true, kFastsimLoad}, combine(Material{}));
  ContactProblem problem;
  problem.grid = hertz_grid(shape, n, n, 1.0);
  Grid2& grid = problem.grid;
  grid = {grid.x0 + (shift_x - 1.0) * grid.dx, grid.y0 + (shift_y - 1.0) * grid.dy, grid.dx, grid.dy, n + 2, n + 2};
  problem.friction.kinetic = kFastsimMu;
  problem.regime = Regime::steady;
  problem.tangential_model = TangentialModel::fastsim_one_flexibility;
  problem.fastsim.flexibility = kFlexibility;
  problem.fastsim.first_step = first_step;
  problem.creepage = creepage;
  ContactSolution solution;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) solution.pressure.push_back(parabolic_pressure(shape, grid.x(ix), grid.y(iy)));
  solve_fastsim(problem, solution);
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < solution.pressure.size(); ++i)
    sum += Vec2(solution.traction_x[i], solution.traction_y[i]);
  return sum * grid.cell_area();
}

/// Mean over places of the ellipse on its elements, a Kronecker sequence: where its edge cuts them makes single forces
/// scatter.
Vec2 force(int n, FirstStep first_step, const Creepage& creepage) {
  constexpr int kPlaces = 300;
  Vec2 sum = Vec2::Zero();
  for (int k = 0; k < kPlaces; ++k) {
    const double x = 0.7548776662466927 * k, y = 0.5698402909980532 * k;
    sum += force_at(n, first_step, creepage, x - std::floor(x) - 0.5, y - std::floor(y) - 0.5);
  }
  return sum / kPlaces;
}

/// The integrals of FASTSIM under longitudinal creepage (Kalker 1982): in each row tractions grow in proportion to the
/// way from the leading edge, until they reach the parabola; sum over the rows.
double force_by_quadrature(double xi) {
  constexpr int kRows = 20000;
  const double growth = xi / kFlexibility, curvature = kBound / (kA * kA), slip_length = growth / curvature;
  double sum = 0.0;
  for (int k = 0; k < kRows; ++k) {
    const double y = -1.0 + (k + 0.5) * 2.0 / kRows, half = kA * std::sqrt(1.0 - y * y);
    const double slip = std::min(slip_length, 2.0 * half), adhesion = 2.0 * half - slip;
    // half^2 - x^2 over the slip area from the trailing edge on
    const double parabola = half * slip * slip - slip * slip * slip / 3.0;
    sum += 0.5 * growth * adhesion * adhesion + curvature * parabola;
  }
  return -sum * 2.0 * kB / kRows;
}

constexpr double kSlipping = 1.2e-3, kSpin = 0.4;

TEST(FastsimConvergence, QuadratureKnowsItsLimits) {
  const double small = 1e-7;
  EXPECT_NEAR(force_by_quadrature(small) / (-8.0 / 3.0 * kA * kA * kB * small / kFlexibility), 1.0, 1e-3);
  EXPECT_NEAR(force_by_quadrature(1.0) / (-kFastsimMu * kFastsimLoad), 1.0, 1e-6);
  const double share = force_by_quadrature(kSlipping) / (-kFastsimMu * kFastsimLoad);
  EXPECT_GT(share, 0.3);
  EXPECT_LT(share, 0.9);
}

TEST(FastsimConvergence, HalfAFirstStepIsOfSecondOrderWithoutSlip) {
  const double small = 1e-7, spin = 1e-5;
  const double by_creepage = -8.0 / 3.0 * kA * kA * kB * small / kFlexibility,
               by_spin = -std::numbers::pi / 4.0 * kA * kA * kA * kB * spin / kFlexibility,
               slipping = force_by_quadrature(kSlipping);
  // Spin with slip has no formula: both first steps lead there.
  const Creepage turning{0.5 * kSlipping, 0.0, kSpin};
  const Vec2 turned = force_at(1000, FirstStep::half, turning, 0.0, 0.0);
  EXPECT_LT((force_at(1000, FirstStep::whole, turning, 0.0, 0.0) - turned).norm(), 1e-3 * turned.norm());
  const std::array<int, 4> sizes{10, 15, 20, 40};
  std::array<std::array<double, 4>, 4> half{}, whole{};
  for (std::size_t k = 0; k < sizes.size(); ++k)
    for (const FirstStep step : {FirstStep::half, FirstStep::whole}) {
      auto& error = step == FirstStep::half ? half[k] : whole[k];
      const int n = sizes[k];
      error = {force(n, step, {small, 0.0, 0.0}).x() / by_creepage - 1.0,
               force(n, step, {0.0, 0.0, spin}).y() / by_spin - 1.0,
               force(n, step, {kSlipping, 0.0, 0.0}).x() / slipping - 1.0,
               (force(n, step, turning) - turned).norm() / turned.norm()};
    }
  const std::array<const char*, 4> names{"creepage", "spin", "creepage,slip", "spin,slip"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    SCOPED_TRACE(names[i]);
    for (std::size_t k = 0; k < sizes.size(); ++k)
      treadmark::testing::expect_documented(names[i], sizes[k], {half[k][i], whole[k][i]});
    // From 10 to 40 elements: second order is a factor 16, first order 4. Where elements slip the edge of the contact,
    // which runs through elements, and the direction of slip leave half a step at first order, too.
    EXPECT_GT(std::abs(half[0][i]), (i < 2 ? 12.0 : 2.5) * std::abs(half[3][i]));
    EXPECT_LT(std::abs(whole[0][i]), 5.0 * std::abs(whole[3][i]));
    for (std::size_t k = 0; k < sizes.size(); ++k)
      EXPECT_LT(std::abs(half[k][i]), (i < 3 ? 0.2 : 0.6) * std::abs(whole[k][i]));
  }
}

}  // namespace
}  // namespace treadmark::kalker
