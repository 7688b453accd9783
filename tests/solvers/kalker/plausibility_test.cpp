// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/plausibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/fastsim/flexibilities.hpp"
#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"
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
         problem.regime == Regime::shift, kLimit, kInfinity, closed_border, problem.normal_model,
         problem.tangential_model, problem.fastsim.flexibility},
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

/// Creepages by what the linear theory needs for the friction bound, on an ellipse of a/b.
std::vector<RemarkKind> judged_by_theory(double ratio, TangentialModel model, const Creepage& scaled) {
  const double c = 5e-3, a = c * std::sqrt(ratio), b = c / std::sqrt(ratio);
  const CombinedMaterial material = combine(Material{});
  const HertzShape shape = hertz_from_semi_axes(a, b, {true, 80e3}, material);
  const KalkerCoefficients k = kalker_coefficients(a, b, material.poisson);
  OwnedProblem patch = testing::hertzian(shape, hertz_grid(shape, 36, 36, 1.125));
  const double unit = 0.3 * 80e3 / (material.shear_modulus * c * c);
  patch.problem.creepage = {scaled.xi * unit / k.c11, scaled.eta * unit / k.c22, scaled.phi * unit / (c * k.c23)};
  patch.problem.regime = Regime::steady;
  patch.problem.tangential_model = model;
  patch.problem.fastsim.flexibility = linear_flexibilities(k, material.shear_modulus, a, b).l1;
  return judged(patch.problem);
}

// The errors behind these are in docs/verification.md and its test, theory_errors_test.cpp.
TEST(Plausibility, TheoriesBeyondWhatTheyAreKnownFor) {
  using Model = TangentialModel;
  const auto doubted = [](double ratio, Model model, const Creepage& scaled) {
    const std::vector<RemarkKind> kinds = judged_by_theory(ratio, model, scaled);
    return ranges::find(kinds, RemarkKind::beyond_theory) != kinds.end();
  };
  const Creepage slipping{1.0, 1.0, 0.0}, turning{0.0, 1.0, 0.5}, spinning{0.5, -0.5, 1.0};
  for (const double ratio : {0.1, 0.5, 2.0, 10.0})
    for (const Model model : {Model::full, Model::fastsim, Model::fastrip})
      EXPECT_FALSE(doubted(ratio, model, slipping)) << ratio;
  for (const double ratio : {0.1, 10.0})
    for (const Model model : {Model::fastsim, Model::fastrip}) EXPECT_TRUE(doubted(ratio, model, spinning)) << ratio;
  EXPECT_TRUE(doubted(0.1, Model::fastsim, turning));
  for (const Model model : {Model::full, Model::fastsim, Model::fastrip}) EXPECT_FALSE(doubted(1.0, model, spinning));
  EXPECT_FALSE(doubted(4.0, Model::fastsim, spinning));
  EXPECT_TRUE(doubted(4.0, Model::fastrip, spinning));
  // One flexibility, that of longitudinal creepage.
  EXPECT_FALSE(doubted(0.2, Model::fastsim_one_flexibility, {1.0, 0.0, 0.0}));
  EXPECT_TRUE(doubted(0.2, Model::fastsim_one_flexibility, {0.0, 1.0, 0.0}));
  EXPECT_TRUE(doubted(1.0, Model::fastsim_one_flexibility, {0.0, 0.0, 0.5}));
  EXPECT_FALSE(doubted(1.0, Model::linear, {0.2, 0.1, 0.1}));
  EXPECT_TRUE(doubted(1.0, Model::linear, {0.6, 0.0, 0.0}));
  EXPECT_TRUE(doubted(1.0, Model::linear, {0.0, 0.5, -0.5})) << "though both give hardly any force together";
}

TEST(Plausibility, KpecOnLongPatches) {
  for (const double ratio : {0.2, 3.0, 8.0}) {
    const HertzShape shape =
        hertz_from_semi_axes(5e-3 * std::sqrt(ratio), 5e-3 / std::sqrt(ratio), {true, 80e3}, combine(Material{}));
    OwnedProblem patch = testing::hertzian(shape, hertz_grid(shape, 36, 36, 1.125));
    patch.problem.force_prescribed = false;
    patch.problem.approach = shape.approach;
    patch.problem.normal_model = NormalModel::kpec;
    EXPECT_EQ(ranges::count(judged(patch.problem), RemarkKind::beyond_theory), ratio > 5.0 ? 1 : 0) << ratio;
  }
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

TEST(Remarks, GraveOnesStandBehindAMessage) {
  const Remark grave{RemarkKind::force_not_reached, 0, "too little"}, minor{RemarkKind::few_elements, 1, "coarse"};
  EXPECT_EQ(with_grave("", {}), "");
  EXPECT_EQ(with_grave("no contact", std::vector{minor}), "no contact");
  EXPECT_EQ(with_grave("no contact", std::vector{grave, minor, grave}), "no contact; too little; too little");
  EXPECT_EQ(with_grave("", std::vector{minor, grave}), "too little");
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
