// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/solvers/kalker/contact_span.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"

namespace treadmark::kalker {
namespace {

/// An elliptic contact with this many elements across both axes, the middle anywhere within an element.
struct Ellipse {
  HertzShape shape;
  std::vector<double> gap;
  ContactProblem problem;

  Ellipse(double ratio, double across_x, double across_y, double shift_x, double shift_y) {
    constexpr double kForce = 80e3, kCurvature = 1.0;
    shape = hertz_from_curvatures(kCurvature, ratio * kCurvature, {true, kForce}, combine(problem.material));
    const double dx = 2.0 * shape.semi_axis_x / across_x, dy = 2.0 * shape.semi_axis_y / across_y;
    const int half_x = static_cast<int>(0.75 * across_x) + 2, half_y = static_cast<int>(0.75 * across_y) + 2;
    problem.grid = {(shift_x - half_x) * dx, (shift_y - half_y) * dy, dx, dy, 2 * half_x + 1, 2 * half_y + 1};
    const Grid2& g = problem.grid;
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix)
        gap.push_back(shape.curvature_x * g.x(ix) * g.x(ix) + shape.curvature_y * g.y(iy) * g.y(iy));
    problem.gap = gap;
    problem.normal_force = kForce;
  }
  double pressure() const { return 1.5 * shape.force / (kPi * shape.semi_axis_x * shape.semi_axis_y); }
  double area() const { return kPi * shape.semi_axis_x * shape.semi_axis_y; }
};

double error(double found, double right) { return std::abs(right - found) / found; }

TEST(Refinement, BoundsTheErrorOfHertzContacts) {
  Random random(1);
  ContactSolver solver, coarse;
  double tightest = 0.0;
  for (const double across : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0, 14.0, 20.0, 28.0})
    for (const double ratio : {1.0, 3.0, 20.0})
      for (int k = 0; k < 8; ++k) {
        const Ellipse e(ratio, across, across * (k % 2 == 0 ? 1.0 : 1.7), random.uniform() - 0.5,
                        random.uniform() - 0.5);
        const ContactSolution s = solver.solve(e.problem);
        const Refinement r = estimate_refinement(e.problem, s, false, coarse);
        const double p = error(s.max_pressure, e.pressure()),
                     a = error(s.elements_contact * e.problem.grid.cell_area(), e.area());
        if (false)
          printf("%g %g %d  p %.4f est %.4f   a %.4f est %.4f  force est %.4f\n", across, ratio, k, p, r.pressure, a,
                 r.area, r.force);
        EXPECT_LE(p, r.pressure) << across << " across, ratio " << ratio;
        EXPECT_LE(a, r.area) << across << " across, ratio " << ratio;
        tightest = std::max(tightest, p / r.pressure);
      }
  EXPECT_GT(tightest, 0.3) << "an estimate far above every error tells nothing";
}

}  // namespace
}  // namespace treadmark::kalker
