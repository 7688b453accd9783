// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using testing::kSteel;
using testing::OwnedProblem;

constexpr NormalModel kModels[] = {NormalModel::kpec, NormalModel::analyn};

/// Problem at a given approach.
OwnedProblem at_approach(const Grid2& grid, std::vector<double> gap, double approach, NormalModel model) {
  OwnedProblem owned(grid, std::move(gap));
  owned.problem.force_prescribed = false;
  owned.problem.approach = approach;
  owned.problem.normal_model = model;
  return owned;
}

template <class Gap>
std::vector<double> gap_of(const Grid2& grid, const Gap& gap) {
  std::vector<double> h;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) h.push_back(gap(grid.x(ix), grid.y(iy)));
  return h;
}

ContactSolution solve(OwnedProblem owned) {
  ContactSolver solver;
  return solver.solve_normal(owned.problem);
}

HertzShape ellipse(double ratio) {
  const double c = 5e-3;
  return hertz_from_semi_axes(c * std::sqrt(ratio), c / std::sqrt(ratio), {true, 1e5}, kSteel);
}

/// Deviations from Hertz' solution on 40 x 40 elements in the contact.
struct Deviation {
  double force, pressure, area;
};

Deviation from_hertz(double ratio, NormalModel model) {
  const HertzShape shape = ellipse(ratio);
  const Grid2 grid = hertz_grid(shape, 48, 48, 1.2);
  const ContactSolution solution = solve(at_approach(grid, hertz_gap(shape, grid), shape.approach, model));
  return {solution.force_n / shape.force - 1.0, solution.max_pressure / hertz_max_pressure(shape) - 1.0,
          solution.elements_contact * grid.cell_area() / (M_PI * shape.semi_axis_x * shape.semi_axis_y) - 1.0};
}

TEST(VirtualPenetration, IsHertzOnAnEllipse) {
  // The README states these deviations.
  for (const double ratio : {0.3, 0.5, 1.0, 2.0, 3.0}) {
    const Deviation kpec = from_hertz(ratio, NormalModel::kpec), analyn = from_hertz(ratio, NormalModel::analyn);
    for (const Deviation& deviation : {kpec, analyn}) {
      EXPECT_LT(std::abs(deviation.force), 0.002);
      EXPECT_LT(std::abs(deviation.pressure), 0.002);
      EXPECT_LT(std::abs(deviation.area), 0.01);
    }
  }
}

/// A wheel on a rail head that has one radius on this side of y = 0 and another on that, smooth at the joint.
double two_radii(double x, double y) { return x * x / (2.0 * 0.46) + y * y / (2.0 * (y < 0.0 ? 0.3 : 0.08)); }

TEST(VirtualPenetration, FollowsTheFullSolutionOnTwoRadii) {
  const Grid2 grid{-9.9e-3, -11.9e-3, 0.2e-3, 0.2e-3, 100, 120};
  const std::vector<double> gap = gap_of(grid, two_radii);
  const double approach = 70e-6;
  const ContactSolution full = solve(at_approach(grid, gap, approach, NormalModel::full));
  for (const NormalModel model : kModels) {
    const ContactSolution solution = solve(at_approach(grid, gap, approach, model));
    EXPECT_NEAR(solution.force_n / full.force_n, 1.0, 0.03);
    // The step of the curvature across the rows is seen by neither method as the half-space does.
    EXPECT_NEAR(solution.max_pressure / full.max_pressure, 1.0, 0.15);
    EXPECT_NEAR(static_cast<double>(solution.elements_contact) / full.elements_contact, 1.0, 0.03);
    // Both put the force on the side of the greater radius, as the full solution does.
    EXPECT_LT(full.moment_x, 0.0);
    EXPECT_NEAR((solution.moment_x / solution.force_n) / (full.moment_x / full.force_n), 1.0, 0.25);
  }
}

TEST(VirtualPenetration, MovesWithTheGap) {
  // The same gap, three elements further in x and two in y: equal but for the last bits of the transform.
  const Grid2 grid{-9.9e-3, -11.9e-3, 0.3e-3, 0.3e-3, 66, 80};
  const auto moved = [&](double x, double y) { return two_radii(x - 3 * grid.dx, y - 2 * grid.dy); };
  for (const NormalModel model : kModels) {
    const ContactSolution one = solve(at_approach(grid, gap_of(grid, two_radii), 70e-6, model));
    const ContactSolution other = solve(at_approach(grid, gap_of(grid, moved), 70e-6, model));
    EXPECT_NEAR(other.force_n / one.force_n, 1.0, 1e-9);
    EXPECT_EQ(other.elements_contact, one.elements_contact);
    for (int iy = 0; iy + 2 < grid.ny; ++iy)
      for (int ix = 0; ix + 3 < grid.nx; ++ix)
        ASSERT_NEAR(other.pressure[grid.index(ix + 3, iy + 2)], one.pressure[grid.index(ix, iy)],
                    1e-8 * one.max_pressure);
  }
}

TEST(VirtualPenetration, MirrorsWithTheGap) {
  const Grid2 grid{-9.9e-3, -11.9e-3, 0.2e-3, 0.2e-3, 100, 120};
  for (const NormalModel model : kModels) {
    const ContactSolution one = solve(at_approach(grid, gap_of(grid, two_radii), 70e-6, model));
    const ContactSolution other =
        solve(at_approach(grid, gap_of(grid, [](double x, double y) { return two_radii(-x, -y); }), 70e-6, model));
    EXPECT_NEAR(other.force_n / one.force_n, 1.0, 1e-6);
    EXPECT_NEAR(other.moment_x, -one.moment_x, 1e-6 * one.force_n * 1e-2);
  }
}

TEST(VirtualPenetration, DoesNotDependOnTheLevelOfTheGap) {
  const HertzShape shape = ellipse(0.5);
  const Grid2 grid = hertz_grid(shape, 40, 40, 1.2);
  std::vector<double> gap = hertz_gap(shape, grid);
  for (const NormalModel model : kModels) {
    const ContactSolution one = solve(at_approach(grid, gap, shape.approach, model));
    std::vector<double> higher = gap;
    for (double& h : higher) h += 0.3e-3;
    const ContactSolution other = solve(at_approach(grid, higher, shape.approach + 0.3e-3, model));
    EXPECT_NEAR(other.force_n / one.force_n, 1.0, 1e-9);
  }
}

TEST(VirtualPenetration, KpecMakesTheDisplacementTheDepth) {
  const HertzShape shape = ellipse(2.0);
  const Grid2 grid = hertz_grid(shape, 41, 41, 1.2);
  OwnedProblem owned = at_approach(grid, hertz_gap(shape, grid), shape.approach, NormalModel::kpec);
  owned.problem.settings.conventions = Conventions::contact;
  const ContactSolution reference = ContactSolver().solve_normal(owned.problem);
  EXPECT_NEAR(reference.displacement_n[grid.index(20, 20)] / shape.approach, 1.0, 1e-9);
  EXPECT_GT(reference.elastic_energy, 0.0);
  owned.problem.settings.conventions = Conventions::treadmark;
  const ContactSolution solution = ContactSolver().solve_normal(owned.problem);
  double wanted = 0.0, found = 0.0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double depth = shape.approach - owned.gap[i], weight = std::max(0.0, depth - 0.5 * shape.approach);
    wanted += weight * depth;
    found += weight * solution.displacement_n[i];
  }
  EXPECT_NEAR(found / wanted, 1.0, 1e-9);
}

/// A worn head with two places of about the same depth 8 mm apart; one lies deeper by the tilt [m].
double two_places(double x, double y, double tilt) {
  const double s = std::pow(y / 4e-3, 2) - 1.0;
  return x * x / (2.0 * 0.46) + 0.02 * x * y + 1.5e-6 * s * s + tilt * y / 8e-3;
}

/// Where a force changes most between neighbouring ones of 400 values of a parameter, and there of 10 four times:
/// relative change left, over a 40 000 000th of the range.
template <class Force>
double largest_jump(double from, double to, const Force& force) {
  int steps = 400;
  double change = 0.0;
  for (int round = 0; round < 5; ++round, steps = 10) {
    double before = force(from), at = from, most = -1.0;
    const double step = (to - from) / steps;
    for (int i = 1; i <= steps; ++i) {
      const double now = force(from + i * step), difference = std::abs(now - before) / now;
      if (difference > most) most = difference, at = from + (i - 1) * step;
      before = now;
    }
    change = most;
    from = at, to = at + step;
  }
  return change;
}

double kpec_force(double tilt, double approach, double aside, Conventions conventions = Conventions::treadmark) {
  const Grid2 grid{-9.9e-3 + aside, -14.9e-3 + aside, 0.6e-3, 0.6e-3, 34, 50};
  OwnedProblem owned = at_approach(grid, gap_of(grid, [&](double x, double y) { return two_places(x, y, tilt); }),
                                   approach, NormalModel::kpec);
  owned.problem.settings.conventions = conventions;
  return solve(std::move(owned)).force_n;
}

TEST(VirtualPenetration, KpecIsContinuous) {
  constexpr double kSmooth = 1e-4, kJump = 1e-2;
  EXPECT_LT(largest_jump(-3e-6, 3e-6, [](double tilt) { return kpec_force(tilt, 60e-6, 0.0); }), kSmooth);
  EXPECT_LT(largest_jump(5e-6, 60e-6, [](double approach) { return kpec_force(1e-6, approach, 0.0); }), kSmooth);
  EXPECT_LT(largest_jump(0.0, 0.6e-3, [](double aside) { return kpec_force(1e-6, 60e-6, aside); }), kSmooth);
  EXPECT_GT(largest_jump(-3e-6, 3e-6, [](double tilt) { return kpec_force(tilt, 60e-6, 0.0, Conventions::contact); }),
            kJump)
      << "the reference program scales at the deepest element";
}

TEST(VirtualPenetration, KpecOnTwoPlacesIsNearTheFullSolution) {
  const Grid2 grid{-9.9e-3, -14.9e-3, 0.3e-3, 0.3e-3, 67, 100};
  for (const double tilt : {0.0, 1e-6}) {
    const std::vector<double> gap = gap_of(grid, [&](double x, double y) { return two_places(x, y, tilt); });
    const double full = solve(at_approach(grid, gap, 60e-6, NormalModel::full)).force_n;
    EXPECT_NEAR(solve(at_approach(grid, gap, 60e-6, NormalModel::kpec)).force_n / full, 1.0, 0.03);
  }
}

TEST(VirtualPenetration, SeparateAreasOfARowAreSeparateContacts) {
  // Two equal indenters one behind the other: each has its own area, and the area between is free.
  const Grid2 grid{-19.8e-3, -5.9e-3, 0.2e-3, 0.2e-3, 199, 60};
  const auto pair = [](double x, double y) { return (std::pow(std::abs(x) - 12e-3, 2) + y * y) / (2.0 * 0.3); };
  const ContactSolution solution = solve(at_approach(grid, gap_of(grid, pair), 40e-6, NormalModel::kpec));
  ASSERT_EQ(solution.status, Status::ok);
  const ContactSolution full = solve(at_approach(grid, gap_of(grid, pair), 40e-6, NormalModel::full));
  for (int iy = 0; iy < grid.ny; ++iy) EXPECT_EQ(solution.pressure[grid.index(99, iy)], 0.0);
  EXPECT_NEAR(solution.moment_y / solution.force_n, 0.0, 1e-5);
  EXPECT_NEAR(solution.force_n / full.force_n, 1.0, 0.1);
}

TEST(VirtualPenetration, KeepsOutOfExcludedElements) {
  const HertzShape shape = ellipse(1.0);
  const Grid2 grid = hertz_grid(shape, 41, 41, 1.2);
  std::vector<double> gap = hertz_gap(shape, grid);
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < 12; ++ix) gap[grid.index(ix, iy)] = std::nan("");
  for (const NormalModel model : kModels) {
    const ContactSolution solution = solve(at_approach(grid, gap, shape.approach, model));
    ASSERT_EQ(solution.status, Status::ok);
    for (std::size_t i = 0; i < gap.size(); ++i)
      if (std::isnan(gap[i])) {
        ASSERT_EQ(solution.pressure[i], 0.0);
      }
    EXPECT_GT(solution.force_n, 0.6 * shape.force);
    EXPECT_LT(solution.force_n, 1.1 * shape.force);
  }
}

TEST(VirtualPenetration, WorksAtTheBorderOfTheGrid) {
  // The deepest point lies in the first column and row; flat bodies have no curvature at all.
  const Grid2 grid{0.0, 0.0, 0.3e-3, 0.3e-3, 30, 30};
  for (const NormalModel model : kModels) {
    const ContactSolution corner =
        solve(at_approach(grid, gap_of(grid, [](double x, double y) { return x * x + y * y; }), 40e-6, model));
    EXPECT_EQ(corner.status, Status::ok);
    EXPECT_GT(corner.force_n, 0.0);
    const ContactSolution flat =
        solve(at_approach(grid, gap_of(grid, [](double, double) { return 0.0; }), 40e-6, model));
    EXPECT_EQ(flat.status, Status::ok);
    EXPECT_TRUE(std::isfinite(flat.force_n));
    EXPECT_GT(flat.force_n, 0.0);
  }
}

TEST(VirtualPenetration, StartsWithASingleElement) {
  // From far less than an element to the whole contact; the force of small ones is as good as the grid.
  const HertzShape shape = ellipse(0.5);
  const Grid2 grid = hertz_grid(shape, 41, 41, 1.2);
  for (const NormalModel model : kModels)
    for (double approach = 1e-5 * shape.approach; approach < shape.approach; approach *= 3.0) {
      const ContactSolution solution = solve(at_approach(grid, hertz_gap(shape, grid), approach, model));
      ASSERT_EQ(solution.status, Status::ok);
      const double hertz = shape.force * std::pow(approach / shape.approach, 1.5);
      EXPECT_GT(solution.force_n, 0.0);
      if (approach > 0.01 * shape.approach) {
        EXPECT_NEAR(solution.force_n / hertz, 1.0, 0.35);
      }
    }
}

TEST(VirtualPenetration, BoundsTheTractionsOfSimplifiedTheory) {
  // The cheapest way through a non-Hertzian contact against the full one.
  const Grid2 grid{-9.9e-3, -11.9e-3, 0.4e-3, 0.4e-3, 50, 60};
  OwnedProblem owned = at_approach(grid, gap_of(grid, two_radii), 70e-6, NormalModel::full);
  owned.problem.regime = Regime::steady;
  owned.problem.creepage = {8e-4, 4e-4, 0.1};
  ContactSolver solver;
  const ContactSolution full = solver.solve(owned.problem);
  for (const NormalModel normal : kModels)
    for (const TangentialModel tangential : {TangentialModel::fastsim, TangentialModel::fastrip}) {
      owned.problem.normal_model = normal;
      owned.problem.tangential_model = tangential;
      const ContactSolution solution = solver.solve(owned.problem);
      ASSERT_EQ(solution.status, Status::ok);
      EXPECT_NEAR(solution.force_x, full.force_x, 0.05 * 0.3 * full.force_n);
      EXPECT_NEAR(solution.force_y, full.force_y, 0.05 * 0.3 * full.force_n);
      EXPECT_NEAR(solution.elastic_energy, full.elastic_energy, 0.1 * full.elastic_energy);
    }
}

TEST(VirtualPenetration, NeedsAnApproachThatTouches) {
  const HertzShape shape = ellipse(1.0);
  const Grid2 grid = hertz_grid(shape, 20, 20, 1.2);
  for (const NormalModel model : kModels) {
    EXPECT_EQ(solve(at_approach(grid, hertz_gap(shape, grid), -1e-6, model)).status, Status::no_contact);
    const std::vector<double> excluded(grid.size(), std::nan(""));
    EXPECT_EQ(solve(at_approach(grid, excluded, 1e-3, model)).status, Status::no_contact);
  }
}

void expect_refused(OwnedProblem owned, const char* why) {
  try {
    solve(owned);
    ADD_FAILURE() << "accepted, though " << why;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration) << why;
  }
}

TEST(VirtualPenetration, RefusesBadInput) {
  const HertzShape shape = ellipse(1.0);
  const Grid2 grid = hertz_grid(shape, 20, 20, 1.2);
  for (const NormalModel model : kModels) {
    OwnedProblem force = at_approach(grid, hertz_gap(shape, grid), shape.approach, model);
    force.problem.force_prescribed = true;
    force.problem.normal_force = 1e5;
    expect_refused(force, "the force is prescribed");
    std::vector<double> short_gap = hertz_gap(shape, grid);
    short_gap.pop_back();
    expect_refused(at_approach(grid, short_gap, shape.approach, model), "the gap does not fit the grid");
    std::vector<double> infinite = hertz_gap(shape, grid);
    infinite[5] = -HUGE_VAL;
    expect_refused(at_approach(grid, infinite, shape.approach, model), "the gap is infinite");
    const Grid2 line = hertz_grid(shape, 20, 1, 1.2);
    expect_refused(at_approach(line, hertz_gap(shape, line), shape.approach, model), "there is one row");
    expect_refused(at_approach(grid, hertz_gap(shape, grid), std::nan(""), model), "the approach is not a number");
  }
}

}  // namespace
}  // namespace treadmark::kalker
