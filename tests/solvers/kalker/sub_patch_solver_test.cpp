// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using testing::largest_difference;

/// Two bumps 8 mm apart pressed against a plane: two contacts in one grid.
struct TwoBumps {
  ContactProblem problem;
  std::vector<double> gap;

  explicit TwoBumps(double coupling) {
    problem.grid = {-4e-3, -8e-3, 0.25e-3, 0.25e-3, 33, 65};
    const Grid2& g = problem.grid;
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) {
        const double x = g.x(ix), y = g.y(iy);
        gap.push_back(2.0 * x * x + std::min(3.0 * (y - 4e-3) * (y - 4e-3), 2.0 * (y + 4e-3) * (y + 4e-3) + 2e-6));
        problem.sub_patches.part.push_back(y > 0.0 ? 1 : 2);
      }
    problem.gap = gap;
    problem.force_prescribed = false;
    problem.approach = 1e-5;
    problem.settings.eps = 1e-7;
    problem.sub_patches.count = 2;
    problem.sub_patches.coupling = {1.0, coupling, coupling, 1.0};
  }
};

TEST(SubPatches, FullCouplingIsOnePatch) {
  TwoBumps bumps(1.0);
  ContactSolver solver;
  const ContactSolution parts = solver.solve_normal(bumps.problem);
  bumps.problem.sub_patches = {};
  const ContactSolution whole = solver.solve_normal(bumps.problem);
  ASSERT_EQ(parts.status, Status::ok);
  EXPECT_EQ(parts.elements_contact, whole.elements_contact);
  EXPECT_LT(largest_difference(parts.pressure, whole.pressure), 1e-4 * whole.max_pressure);
  EXPECT_NEAR(parts.force_n, whole.force_n, 1e-5 * whole.force_n);
}

TEST(SubPatches, TheReferenceProgramDoesNotTellThemApartInApproximateTheories) {
  for (const NormalModel model : {NormalModel::kpec, NormalModel::analyn}) {
    TwoBumps bumps(0.3);
    bumps.problem.normal_model = model;
    bumps.problem.settings.conventions = Conventions::contact;
    const ContactSolution quirky = ContactSolver().solve_normal(bumps.problem);
    bumps.problem.settings.conventions = Conventions::treadmark;
    const ContactSolution parts = ContactSolver().solve_normal(bumps.problem);
    bumps.problem.settings.conventions = Conventions::contact;
    bumps.problem.sub_patches = {};
    const ContactSolution whole = ContactSolver().solve_normal(bumps.problem);
    EXPECT_EQ(quirky.pressure, whole.pressure);
    EXPECT_GT(std::abs(parts.force_n / whole.force_n - 1.0), 1e-2);
  }
}

TEST(SubPatches, ElasticEnergyOfTheReferenceProgramIsThatOfFullInfluence) {
  TwoBumps bumps(0.3);
  const ContactSolution parts = ContactSolver().solve_normal(bumps.problem);
  bumps.problem.settings.conventions = Conventions::contact;
  const ContactSolution quirky = ContactSolver().solve_normal(bumps.problem);
  EXPECT_EQ(quirky.pressure, parts.pressure);
  EXPECT_GT(quirky.elastic_energy, parts.elastic_energy);
  // In contact the influence of parts on themselves and 0.3 times that of the other make up approach less gap.
  double work = 0.0;
  for (std::size_t i = 0; i < parts.pressure.size(); ++i)
    work += parts.pressure[i] * (bumps.problem.approach - bumps.gap[i]);
  work *= 0.5 * bumps.problem.grid.cell_area();
  EXPECT_NEAR(parts.elastic_energy, work, 1e-5 * work);
}

TEST(SubPatches, NoCouplingIsTwoPatches) {
  TwoBumps bumps(0.0);
  const ContactSolution parts = ContactSolver().solve_normal(bumps.problem);
  double separate = 0.0;
  for (const std::uint8_t part : {1, 2}) {
    TwoBumps one(0.0);
    for (std::size_t i = 0; i < one.gap.size(); ++i)
      if (one.problem.sub_patches.part[i] != part) one.gap[i] = std::nan("");
    one.problem.sub_patches = {};
    separate += ContactSolver().solve_normal(one.problem).force_n;
  }
  EXPECT_NEAR(parts.force_n, separate, 1e-6 * separate);
}

TEST(SubPatches, ForceFallsSteadilyWithCoupling) {
  double last = 1e30;
  for (const double coupling : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const double force = ContactSolver().solve_normal(TwoBumps(coupling).problem).force_n;
    EXPECT_LT(force, last) << "what the other part pushes away needs no pressure";
    last = force;
  }
}

TEST(SubPatches, ForceFindsTheApproachThatGivesIt) {
  for (const double coupling : {0.0, 0.3, 1.0})
    for (const double approach : {3e-6, 1e-5, 4e-5}) {  // the second bump touches from 2e-6 on
      TwoBumps bumps(coupling);
      bumps.problem.approach = approach;
      const ContactSolution at = ContactSolver().solve_normal(bumps.problem);
      bumps.problem.force_prescribed = true;
      bumps.problem.normal_force = at.force_n;
      bumps.problem.approach = 0.0;
      const ContactSolution under = ContactSolver().solve_normal(bumps.problem);
      ASSERT_EQ(under.status, Status::ok) << under.normal.message;
      EXPECT_NEAR(under.force_n, at.force_n, 2.0 * bumps.problem.settings.eps * at.force_n);
      EXPECT_NEAR(under.approach, approach, 1e-6 * approach);
      EXPECT_LT(largest_difference(under.pressure, at.pressure), 1e-4 * at.max_pressure);
    }
}

TEST(SubPatches, TakeApproximatePressures) {
  for (const NormalModel model : {NormalModel::kpec, NormalModel::analyn}) {
    TwoBumps full(0.5), fast(0.5);
    fast.problem.normal_model = model;
    const ContactSolution a = ContactSolver().solve_normal(full.problem),
                          b = ContactSolver().solve_normal(fast.problem);
    ASSERT_EQ(b.status, Status::ok) << b.normal.message;
    // ellipses: both approximations are close to the full solution
    EXPECT_NEAR(b.force_n, a.force_n, 0.02 * a.force_n);
    EXPECT_NEAR(b.max_pressure, a.max_pressure, 0.02 * a.max_pressure);
  }
}

TEST(SubPatches, RefusesWhatItCannotSolve) {
  TwoBumps bumps(0.5);
  bumps.problem.normal_model = NormalModel::elliptic;
  EXPECT_THROW(ContactSolver().solve_normal(bumps.problem), Error);
  TwoBumps wrong(1.5);
  EXPECT_THROW(ContactSolver().solve_normal(wrong.problem), Error);
}

}  // namespace
}  // namespace treadmark::kalker
