// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// A ball-bearing-like wheel rolling freely in a deep groove (Li 2002): half-space coefficients turned row by row.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "treadmark/solvers/kalker/contact_solver.hpp"

namespace treadmark::kalker {
namespace {

/// Results of the reference program (conformal contact, inclinations row by row, displacements turned), four digits.
struct PrintedGroove {
  double groove = 0.0;     ///< radius [m]
  double approach = 0.0;   ///< [m]
  double overspeed = 0.0;  ///< wheel's circumferential over travelling speed - 1, from the condition F_x = 0
  double force_n = 0.0, max_pressure = 0.0, power = 0.0;  ///< sum of pressures times area [N], [Pa], [W]
  int contact = 0, adhesion = 0;
};

constexpr PrintedGroove kPrinted[] = {{10.25e-3, 0.02237e-3, 2.366e-4, 9956.0, 520.6e6, -0.08602, 1207, 928},
                                      {10.10e-3, 0.01928e-3, 4.667e-4, 9967.0, 397.6e6, -0.3223, 1573, 842},
                                      {10.05e-3, 0.01718e-3, 6.975e-4, 10050.0, 336.1e6, -0.7063, 1891, 659},
                                      {10.02e-3, 0.01493e-3, 10.744e-4, 10340.0, 283.6e6, -1.578, 2337, 328}};
constexpr double kVerticalForce = 10e3;  ///< [N], by which the approach was found

constexpr double kWheelProfile = 10e-3, kRolling = 420e-3, kVelocity = 0.42;

/// The wheel pressed down by the approach, on the cylinder half-way between both surfaces: y along its arc, body 1 the
/// groove, n into it.
struct DeepGroove {
  explicit DeepGroove(const PrintedGroove& p) : radius(0.5 * (p.groove + kWheelProfile)) {
    const double dx = 0.095833e-3, dy = 0.25e-3;
    const int half_x = 35, half_y = static_cast<int>(1.35 * radius / dy);
    Grid2& grid = problem.grid = {-half_x * dx, -half_y * dy, dx, dy, 2 * half_x + 1, 2 * half_y + 1};
    for (int iy = 0; iy < grid.ny; ++iy) add_row(p, iy);
    problem.gap = gap;
    problem.extra_slip_x = slip_x;
    problem.extra_slip_y = slip_y;
    problem.force_prescribed = false;
    problem.approach = p.approach;
    problem.material.shear_modulus_1 = problem.material.shear_modulus_2 = 80e9;
    problem.friction.kinetic = 0.3;
    problem.regime = Regime::steady;
    problem.rolling.velocity = kVelocity;
    problem.fx_relative = 0.0;
    problem.creepage.xi = 3e-4;
    problem.settings.eps = 1e-6;
    problem.settings.max_coupling = 20;
    problem.influence.kind = InfluenceSettings::Kind::angle_corrected;
    problem.influence.linear = false;
    problem.influence.variant = 3;
  }
  double angle(int iy) const { return problem.grid.y(iy) / radius; }

  void add_row(const PrintedGroove& p, int iy) {
    const Grid2& grid = problem.grid;
    const double a = angle(iy), y = radius * std::sin(a);
    if (iy % 3 == 0) {
      problem.influence.position.push_back(grid.y(iy));
      problem.influence.inclination.push_back(-a);  // the groove rises against n
    }
    const double groove = p.groove - std::sqrt(p.groove * p.groove - y * y);
    const double profile = kWheelProfile - std::sqrt(kWheelProfile * kWheelProfile - y * y);
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double x = grid.x(ix), circle = kRolling - profile;
      const double wheel = kRolling - std::sqrt(circle * circle - x * x);
      gap.push_back((wheel - groove) * std::cos(a) + p.approach * (1.0 - std::cos(a)));  // the wheel sinks vertically
      // A wheel's circle is the smaller, the higher it lies; its rotation has a component about the normal there.
      slip_x.push_back(-0.5 * (profile + groove) / kRolling);
      slip_y.push_back(std::sin(a) * x / kRolling);
    }
  }
  double vertical_force(const ContactSolution& s) const {
    double sum = 0.0;
    for (int iy = 0; iy < problem.grid.ny; ++iy)
      for (int ix = 0; ix < problem.grid.nx; ++ix) {
        const std::size_t i = problem.grid.index(ix, iy);
        sum += s.pressure[i] * std::cos(angle(iy)) - s.traction_y[i] * std::sin(angle(iy));
      }
    return sum * problem.grid.cell_area();
  }

  double radius;  ///< of the cylinder [m]
  ContactProblem problem;
  std::vector<double> gap, slip_x, slip_y;
};

TEST(DeepGroove, RollsAsTheReferenceProgramsDoes) {
  for (const PrintedGroove& printed : kPrinted) {
    SCOPED_TRACE(printed.groove);
    const DeepGroove groove(printed);
    const ContactSolution s = ContactSolver().solve(groove.problem);
    ASSERT_EQ(s.status, Status::ok) << s.normal.message << s.tangential.message;
    // four digits of the approach leave 0.1 % of the forces
    EXPECT_NEAR(groove.vertical_force(s), kVerticalForce, 1.5e-3 * kVerticalForce);
    EXPECT_NEAR(s.force_n, printed.force_n, 1.5e-3 * printed.force_n);
    EXPECT_NEAR(s.max_pressure, printed.max_pressure, 1e-3 * printed.max_pressure);
    EXPECT_NEAR(s.elements_contact, printed.contact, 5);
    EXPECT_NEAR(s.elements_adhesion, printed.adhesion, 8);
    EXPECT_NEAR(s.creepage.xi, printed.overspeed, 0.01 * printed.overspeed);
    EXPECT_NEAR(s.frictional_power, printed.power, 0.025 * std::abs(printed.power));
  }
}

/// What the correction is for: coefficients of a plane give other adhesion areas and pressures.
TEST(DeepGroove, IsNotAPlane) {
  DeepGroove groove(kPrinted[3]);
  groove.problem.influence = {};
  const ContactSolution s = ContactSolver().solve(groove.problem);
  EXPECT_GT(std::abs(s.force_n / kPrinted[3].force_n - 1.0), 0.01);
}

}  // namespace
}  // namespace treadmark::kalker
