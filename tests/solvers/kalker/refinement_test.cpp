// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/solvers/kalker/plausibility.hpp"
#include "treadmark/tests/support/documented_errors.hpp"

namespace treadmark::kalker {
namespace {

/// An elliptic contact with so many elements across its axes, the middle anywhere within an element.
struct Ellipse {
  HertzShape shape;
  std::vector<double> gap;
  ContactProblem problem;

  Ellipse(double ratio, double across_x, double across_y, Vec2 shift = Vec2::Zero()) {
    constexpr double kForce = 80e3, kCurvature = 1.0, kBorder = 0.75;
    shape = hertz_from_curvatures(kCurvature, ratio * kCurvature, {true, kForce}, combine(problem.material));
    const double dx = 2.0 * shape.semi_axis_x / across_x, dy = 2.0 * shape.semi_axis_y / across_y;
    const int half_x = static_cast<int>(kBorder * across_x) + 2, half_y = static_cast<int>(kBorder * across_y) + 2;
    problem.grid = {(shift.x() - half_x) * dx, (shift.y() - half_y) * dy, dx, dy, 2 * half_x + 1, 2 * half_y + 1};
    gap = hertz_gap(shape, problem.grid);
    problem.gap = gap;
    problem.normal_force = kForce;
    problem.approach = shape.approach;
  }
  double area() const { return kPi * shape.semi_axis_x * shape.semi_axis_y; }
};

double area_of(const ContactSolution& s, const Grid2& g) { return s.elements_contact * g.cell_area(); }
double error(double found, double right) { return std::abs(right - found) / found; }

// Hertz 1882.
TEST(Refinement, BoundsTheErrorsOfEllipses) {
  Random random(1);
  ContactSolver solver, coarse;
  for (const double across : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 14.0, 20.0, 28.0})
    for (const double ratio : {1.0, 20.0})
      for (const double more : {1.0, 1.7}) {
        SCOPED_TRACE(::testing::Message() << across << " across, ratio " << ratio << ", " << more);
        Ellipse e(ratio, across, more * across, {random.uniform() - 0.5, random.uniform() - 0.5});
        ContactSolution s = solver.solve(e.problem);
        Refinement r = estimate_refinement(e.problem, s, false, coarse);
        EXPECT_LE(error(s.max_pressure, hertz_max_pressure(e.shape)), r.pressure);
        EXPECT_LE(error(area_of(s, e.problem.grid), e.area()), r.area);
        EXPECT_EQ(r.force, 0.0) << "it is given";
        EXPECT_LT(std::abs(r.peak_exponent), 0.1);
        e.problem.force_prescribed = false;
        s = solver.solve(e.problem);
        if (s.status == Status::no_contact) continue;  // between the middles of elements
        r = estimate_refinement(e.problem, s, false, coarse);
        EXPECT_LE(error(s.force_n, e.shape.force), r.force);
        EXPECT_EQ(estimate_refinement(e.problem, s, true, coarse).force, 0.0);
        if (across < 20.0) continue;
        EXPECT_LT(r.pressure, 5e-3) << "it tells something";
        EXPECT_LE(r.area, 0.051);
        EXPECT_LT(r.force, 5e-3);
      }
}

// Against 61 elements across.
TEST(Refinement, BoundsTheErrorsOfCreepForces) {
  Random random(2);
  ContactSolver solver, fine_solver, coarse;
  const auto rolling = [](Ellipse e, const Creepage& creepage) {
    e.problem.gap = e.gap;
    e.problem.regime = Regime::steady;
    e.problem.creepage = creepage;
    e.problem.rolling.step = e.problem.grid.dx;
    return e;
  };
  for (int k = 0; k < 4; ++k) {
    const Creepage creepage{2e-3 * random.uniform(), 2e-3 * random.uniform(), k % 2 == 0 ? 0.0 : 0.2};
    const Ellipse right = rolling(Ellipse(2.0, 61.0, 61.0), creepage);
    ContactProblem exact = right.problem;
    exact.gap = right.gap;
    const ContactSolution best = fine_solver.solve(exact);
    const double bound = exact.friction.static_friction() * exact.normal_force;
    for (const double across : {1.5, 3.0, 5.0, 7.0, 10.0, 16.0, 24.0}) {
      const Ellipse e =
          rolling(Ellipse(2.0, across, 1.3 * across, {random.uniform() - 0.5, random.uniform() - 0.5}), creepage);
      ContactProblem problem = e.problem;
      problem.gap = e.gap;
      const ContactSolution s = solver.solve(problem);
      EXPECT_LE(std::hypot(s.force_x - best.force_x, s.force_y - best.force_y),
                bound * estimate_refinement(problem, s, true, coarse).force)
          << across << " across, case " << k;
    }
  }
}

// A wave of 1 um that twenty elements across hold and a third of them do not.
TEST(Refinement, IsLargeWhereSurfacesAreRough) {
  Ellipse e(1.0, 24.0, 24.0);
  const Grid2& g = e.problem.grid;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      constexpr double kElements = 4.0, kDepth = 1e-6;
      e.gap[g.index(ix, iy)] += kDepth * std::sin(2.0 * kPi * ix / kElements);
    }
  ContactSolver solver, coarse;
  const Refinement r = estimate_refinement(e.problem, solver.solve(e.problem), false, coarse);
  EXPECT_GT(r.pressure, 0.05);
}

// At an edge of a rigid body pressure grows with 1/sqrt of the distance (Sneddon 1948), and so with 1/sqrt of the size
// of elements; where surfaces turn away from each other by an angle, as at the end of a flat, more slowly.
TEST(Refinement, SeesPressureWithoutLimitAtEdgesAndKinks) {
  constexpr double kAngle = 0.065;  // of a flat of 60 mm on a wheel of 0.46 m
  ContactSolver solver, coarse;
  for (const char* where : {"end", "kink"})
    for (const int across : {20, 40, 60}) {
      SCOPED_TRACE(::testing::Message() << where << ", " << across);
      const bool kink = where == std::string("kink");
      Ellipse e(1.0, across, across, {0.2, 0.4});
      const Grid2& g = e.problem.grid;
      const double end = 0.3 * e.shape.semi_axis_x;
      for (int iy = 0; iy < g.ny; ++iy)
        for (int ix = 0; ix < g.nx; ++ix)
          if (const double beyond = g.x(ix) - end; beyond > 0.0)
            e.gap[g.index(ix, iy)] += kink ? kAngle * beyond : std::nan("");
      const ContactSolution s = solver.solve(e.problem);
      const Refinement r = estimate_refinement(e.problem, s, true, coarse);
      treadmark::testing::expect_documented(where, across, {r.peak_exponent});
      EXPECT_NEAR(r.peak.x(), end, g.dx);
      EXPECT_GT(r.peak_exponent, kink ? 0.1 : 0.4);
      EXPECT_LT(r.peak_exponent, 0.5);
      std::vector<Remark> remarks;
      judge_refinement(r, 1, remarks);
      // Elements as large as the zone where it grows do not tell.
      EXPECT_EQ(ranges::any_of(remarks, [](const Remark& one) { return one.kind == RemarkKind::edge_pressure; }),
                !kink || across > 20);
    }
}

TEST(Refinement, DoesNotRememberTheCallBefore) {
  const Ellipse a(1.0, 24.0, 24.0, {0.3, 0.1}), b(7.0, 12.0, 24.0);
  ContactSolver coarse, fresh;
  const ContactSolution of_a = ContactSolver().solve(a.problem), of_b = ContactSolver().solve(b.problem);
  estimate_refinement(b.problem, of_b, false, coarse);
  const Refinement after = estimate_refinement(a.problem, of_a, false, coarse),
                   first = estimate_refinement(a.problem, of_a, false, fresh);
  EXPECT_EQ(after.pressure, first.pressure);
  EXPECT_EQ(after.area, first.area);
}

TEST(Refinement, OfAStrip) {
  ContactProblem p;
  const HertzShape line = hertz_line_from_curvature(1.0, 0.1, {true, 80e3}, combine(p.material));
  ContactSolver solver, coarse;
  for (const int n : {3, 9, 33}) {
    p.grid = hertz_grid(line, n, 1, 1.2);
    const std::vector<double> gap = hertz_gap(line, p.grid);
    p.gap = gap;
    p.normal_force = 80e3;
    const ContactSolution s = solver.solve(p);
    EXPECT_LE(error(s.max_pressure, hertz_max_pressure(line)), estimate_refinement(p, s, true, coarse).pressure) << n;
  }
}

}  // namespace
}  // namespace treadmark::kalker
