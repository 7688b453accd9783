// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "tangential_cases.hpp"

namespace treadmark::kalker::testing {
namespace {

/// Tractions of equivalent problems, relative to the largest: the accuracy asked for, and then some.
constexpr double kEps = 1e-9, kSame = 1e-7;

/// An ellipse with pressures that have no symmetry.
Case lopsided(Regime regime) {
  Case c = wheel_case(20);
  const Grid2& g = c.problem.grid;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) c.solution.pressure[g.index(ix, iy)] *= 1.0 + 30.0 * g.x(ix) - 60.0 * g.y(iy);
  c.problem.regime = regime;
  c.problem.settings.eps = kEps;
  c.problem.creepage = {-6e-4, 3e-4, 0.25, 1e-4, -2e-4};
  if (regime == Regime::shift) c.problem.creepage = {-6e-6, 3e-6, 5e-4, 1e-4, -2e-4};
  return c;
}

/// Field with columns and/or rows in reverse order.
template <class T>
std::vector<T> reversed(const std::vector<T>& field, const Grid2& g, bool in_x, bool in_y) {
  std::vector<T> out(field.size());
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix)
      out[g.index(in_x ? g.nx - 1 - ix : ix, in_y ? g.ny - 1 - iy : iy)] = field[g.index(ix, iy)];
  return out;
}

Case mirrored(const Case& original, bool in_x, bool in_y) {
  Case c = original;
  Grid2& g = c.problem.grid;
  Creepage& k = c.problem.creepage;
  c.solution.pressure = reversed(c.solution.pressure, g, in_x, in_y);
  c.solution.state = reversed(c.solution.state, g, in_x, in_y);
  if (in_x) {
    g.x0 = -g.x(g.nx - 1);
    k.xi = -k.xi;
    k.spin_x = -k.spin_x;
    c.problem.rolling.chi = std::numbers::pi - c.problem.rolling.chi;
  }
  if (in_y) {
    g.y0 = -g.y(g.ny - 1);
    k.eta = -k.eta;
    k.spin_y = -k.spin_y;
  }
  if (in_x != in_y) k.phi = -k.phi;
  return c;
}

void expect_mirror_image(Regime regime, bool in_x, bool in_y) {
  Case a = lopsided(regime);
  Case b = mirrored(a, in_x, in_y);
  ASSERT_EQ(a.solve().tangential.status, Status::ok);
  ASSERT_EQ(b.solve().tangential.status, Status::ok);
  const Grid2& g = a.problem.grid;
  std::vector<double> x = reversed(b.solution.traction_x, g, in_x, in_y);
  std::vector<double> y = reversed(b.solution.traction_y, g, in_x, in_y);
  for (double& v : x) v *= in_x ? -1.0 : 1.0;
  for (double& v : y) v *= in_y ? -1.0 : 1.0;
  const double scale = largest(a.solution.traction_x);
  EXPECT_LE(distance(a.solution.traction_x, x), kSame * scale);
  EXPECT_LE(distance(a.solution.traction_y, y), kSame * scale);
}

TEST(Invariance, MirroredSidewaysInRolling) { expect_mirror_image(Regime::steady, false, true); }
TEST(Invariance, MirroredLengthwaysRollingTheOtherWay) { expect_mirror_image(Regime::steady, true, false); }
TEST(Invariance, TurnedByHalfATurn) { expect_mirror_image(Regime::steady, true, true); }
TEST(Invariance, MirroredShift) { expect_mirror_image(Regime::shift, true, false); }

TEST(Invariance, TractionsScaleWithTheFrictionBound) {
  // Lengths and directions stay; pressures and creepages times 3 give tractions times 3.
  for (const Regime regime : {Regime::steady, Regime::shift}) {
    Case a = lopsided(regime), b = a;
    for (double& p : b.solution.pressure) p *= 3.0;
    Creepage& k = b.problem.creepage;
    k.xi *= 3.0;
    k.eta *= 3.0;
    k.phi *= 3.0;
    a.solve();
    b.solve();
    for (double& p : a.solution.traction_x) p *= 3.0;
    EXPECT_LE(distance(a.solution.traction_x, b.solution.traction_x), kSame * largest(b.solution.traction_x));
  }
}

TEST(Conditions, HoldInEveryElement) {
  for (const Regime regime : {Regime::steady, Regime::shift}) {
    Case c = lopsided(regime);
    ASSERT_EQ(c.solve().tangential.status, Status::ok);
    const ContactSolution& s = c.solution;
    EXPECT_LT(s.tangential.residual, 1e-7);
    const double slip_scale = std::max(largest(s.slip_x), largest(s.slip_y)), bound_scale = 0.3 * largest(s.pressure);
    int adhesion = 0, slip = 0;
    for (std::size_t i = 0; i < s.state.size(); ++i) {
      const double p = std::hypot(s.traction_x[i], s.traction_y[i]), v = std::hypot(s.slip_x[i], s.slip_y[i]);
      const double bound = 0.3 * s.pressure[i];
      if (s.state[i] == ElementState::exterior) {
        EXPECT_EQ(p, 0.0);
        EXPECT_EQ(v, 0.0);
      } else if (s.state[i] == ElementState::adhesion) {
        ++adhesion;
        EXPECT_LE(p, bound * (1.0 + 1e-9));
        EXPECT_LE(v, 1e-6 * slip_scale);
      } else {
        ++slip;
        EXPECT_NEAR(p, bound, 1e-6 * bound_scale);
        // Antiparallel.
        EXPECT_NEAR(s.traction_x[i] * s.slip_x[i] + s.traction_y[i] * s.slip_y[i], -p * v,
                    1e-6 * bound_scale * slip_scale);
      }
    }
    EXPECT_GT(adhesion, 10);
    EXPECT_GT(slip, 10);
    EXPECT_LT(totals(c).power, 0.0);  // friction dissipates
    EXPECT_GT(totals(c).energy, 0.0);
  }
}

TEST(Conditions, PatchesApartInfluenceEachOtherOnlyElastically) {
  // Two separate areas in the same rows: the second one gets no tractions transported from the first.
  Case c = wheel_case(20);
  const Grid2 one = c.problem.grid;
  Case two = c;
  two.problem.grid.nx = 12 * one.nx;
  two.solution.pressure.assign(two.problem.grid.size(), 0.0);
  two.solution.state.clear();
  const int gap = 11 * one.nx;
  for (int iy = 0; iy < one.ny; ++iy)
    for (int ix = 0; ix < one.nx; ++ix)
      for (const int offset : {0, gap})
        two.solution.pressure[two.problem.grid.index(ix + offset, iy)] = c.solution.pressure[one.index(ix, iy)];
  c.problem.creepage = two.problem.creepage = {-6e-4, 3e-4, 0.0, 0.0, 0.0};
  c.solve();
  ASSERT_EQ(two.solve().tangential.status, Status::ok);
  const double alone = totals(c).x, both = totals(two).x;
  // 22 semi-axes apart, the influence falls with the square of the distance.
  EXPECT_NEAR(both, 2.0 * alone, 0.01 * alone);
  EXPECT_NE(both, 2.0 * alone);
}

}  // namespace
}  // namespace treadmark::kalker::testing
