// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/plausibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::OwnedProblem;

constexpr double kLimit = 5e9;

/// A patch of 6 mm by 4 mm under 80 kN, with margins of a fifth.
OwnedProblem plain_patch(double enlarged = 1.2, double force = 80e3, int elements = 24) {
  const HertzShape shape = hertz_from_semi_axes(6e-3, 4e-3, {true, force}, combine(Material{}));
  return testing::hertzian(shape, hertz_grid(shape, elements, elements, enlarged));
}

std::vector<RemarkKind> judged(const ContactProblem& problem, const ContactSolution& solution,
                               bool closed_border = false) {
  std::vector<Remark> remarks;
  judge({problem.grid, problem.material, problem.friction.static_friction(), problem.regime == Regime::steady,
         problem.regime == Regime::shift, kLimit, kInfinity, closed_border},
        solution, 1, remarks);
  std::vector<RemarkKind> kinds;
  for (const Remark& r : remarks) {
    EXPECT_EQ(r.patch, 1);
    EXPECT_FALSE(r.text.empty());
    kinds.push_back(r.kind);
  }
  return kinds;
}

std::vector<RemarkKind> judged(const ContactProblem& problem) {
  return judged(problem, ContactSolver().solve(problem));
}

TEST(Plausibility, OrdinaryPatchIsWithoutDoubt) {
  OwnedProblem patch = plain_patch();
  EXPECT_THAT(judged(patch.problem), IsEmpty());
  patch.problem.regime = Regime::steady;
  patch.problem.creepage = {2e-3, -1e-3, 0.2};
  EXPECT_THAT(judged(patch.problem), IsEmpty());
  patch.problem.regime = Regime::shift;
  patch.problem.creepage = {2e-6, -1e-6, 1e-4};
  EXPECT_THAT(judged(patch.problem), IsEmpty());
}

TEST(Plausibility, GridThatCutsThePatch) {
  EXPECT_THAT(judged(plain_patch(0.8).problem), Contains(RemarkKind::grid_cuts_contact));
}

TEST(Plausibility, GridThatIsAllWhereBodiesMayTouch) {
  const OwnedProblem patch = plain_patch(0.8);
  const std::vector<RemarkKind> kinds = judged(patch.problem, ContactSolver().solve(patch.problem), true);
  EXPECT_THAT(kinds, Contains(RemarkKind::grid_bounds_contact));
  EXPECT_THAT(kinds, Not(Contains(RemarkKind::grid_cuts_contact)));
}

// The outermost rows end beyond the patch, and their middle lies in it.
TEST(Plausibility, PatchThatEndsWithinTheOutermostElements) {
  const OwnedProblem patch = plain_patch(1.1, 80e3, 10);
  EXPECT_THAT(judged(patch.problem), Not(Contains(RemarkKind::grid_cuts_contact)));
  EXPECT_THAT(judged(patch.problem), Contains(RemarkKind::grid_touches_contact));
  EXPECT_THAT(judged(plain_patch(0.8).problem), Not(Contains(RemarkKind::grid_touches_contact)));
}

TEST(Plausibility, EveryElementInContact) {
  OwnedProblem patch = plain_patch(0.5, 80e3, 11);
  EXPECT_THAT(judged(patch.problem), Contains(RemarkKind::grid_cuts_contact));
}

TEST(Plausibility, DirectionOfOneElementHasNoBorder) {
  OwnedProblem strip = plain_patch();
  strip.problem.grid.ny = 1;
  strip.problem.grid.dy = 1.0;
  strip.gap.assign(strip.gap.begin() + 12 * 24, strip.gap.begin() + 13 * 24);
  strip.problem.gap = strip.gap;
  strip.problem.normal_force = 5e6;
  EXPECT_THAT(judged(strip.problem), Not(Contains(RemarkKind::grid_cuts_contact)));
  EXPECT_THAT(judged(strip.problem), Not(Contains(RemarkKind::grid_touches_contact)));
}

TEST(Plausibility, RowOfShortElementsIsNoStrip) {
  OwnedProblem row = plain_patch();
  row.problem.grid.ny = 1;
  row.gap.assign(row.gap.begin() + 12 * 24, row.gap.begin() + 13 * 24);
  row.problem.gap = row.gap;
  EXPECT_THAT(judged(row.problem), Contains(RemarkKind::grid_cuts_contact));
}

TEST(Plausibility, PressureAgainstTheStatedLimit) {
  const OwnedProblem patch = plain_patch();
  ContactSolution s = ContactSolver().solve(patch.problem);
  s.max_pressure = 0.999 * kLimit;
  EXPECT_THAT(judged(patch.problem, s), IsEmpty());
  s.max_pressure = 1.001 * kLimit;
  EXPECT_THAT(judged(patch.problem, s), Contains(RemarkKind::beyond_half_space));
  // 1 / E' = (1 - nu^2) / E of each body, E = 2 G (1 + nu): 82 GPa / 0.72.
  EXPECT_NEAR(contact_modulus(Material{}), 113.889e9, 1e6);
}

TEST(Plausibility, FewElements) {
  EXPECT_THAT(judged(plain_patch(1.2, 80e3, 5).problem), Contains(RemarkKind::few_elements));
  EXPECT_THAT(judged(plain_patch(1.2, 80e3, 8).problem), Not(Contains(RemarkKind::few_elements)));
}

TEST(Plausibility, LargeCreepage) {
  OwnedProblem patch = plain_patch();
  patch.problem.regime = Regime::steady;
  patch.problem.creepage = {0.11, 0.0, 0.0};
  EXPECT_THAT(judged(patch.problem), Contains(RemarkKind::large_creepage));
  patch.problem.creepage = {0.0, 0.0, 30.0};  // times sqrt(6 mm 4 mm)
  EXPECT_THAT(judged(patch.problem), Contains(RemarkKind::large_creepage));
}

TEST(Plausibility, UnusualFriction) {
  OwnedProblem patch = plain_patch();
  patch.problem.friction.kinetic = 1.0;
  EXPECT_THAT(judged(patch.problem), Not(Contains(RemarkKind::unusual_friction)));
  patch.problem.friction.kinetic = 3.0;
  EXPECT_THAT(judged(patch.problem), Contains(RemarkKind::unusual_friction));
}

TEST(Plausibility, FrictionThatAddsEnergy) {
  OwnedProblem patch = plain_patch();
  patch.problem.regime = Regime::steady;
  patch.problem.creepage = {2e-3, 0.0, 0.0};
  ContactSolution s = ContactSolver().solve(patch.problem);
  EXPECT_THAT(judged(patch.problem, s), IsEmpty());
  for (double& t : s.traction_x) t = -t;
  EXPECT_THAT(judged(patch.problem, s), Contains(RemarkKind::friction_adds_energy));
}

TEST(Plausibility, ForceThatWasNotReached) {
  std::vector<Remark> remarks;
  judge_force("normal force", 1000.0, 1001.0, remarks);
  EXPECT_THAT(remarks, IsEmpty());
  judge_force("normal force", 1000.0, 1003.0, remarks);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks.front().kind, RemarkKind::force_not_reached);
  EXPECT_TRUE(any_grave(remarks));
  remarks.clear();
  judge_force("normal force", 1000.0, 1003.0, remarks, "as it is meant");
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks.front().kind, RemarkKind::force_differs);
  EXPECT_FALSE(any_grave(remarks));
}

TEST(Remarks, RowsLieInTheOrderOfTheirKindsAndHaveNamesOfTheirOwn) {
  for (std::size_t i = 0; i < std::size(kRemarkRows); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(kRemarkRows[i].kind), i);
    EXPECT_EQ(remark_named(kRemarkRows[i].name), kRemarkRows[i].kind);
  }
  EXPECT_FALSE(remark_named("none"));
}

}  // namespace
}  // namespace treadmark::kalker
