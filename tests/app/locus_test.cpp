// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// The contact locus against the grid on the Manchester benchmark (Shackleton and Iwnicki 2008), both wheels.
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::app {
namespace {

class ManchesterLocus : public ::testing::TestWithParam<const char*> {};

TEST_P(ManchesterLocus, EqualsTheGrid) {
  TREADMARK_REQUIRE_SHARED();
  const io::CaseFile file = io::read_any_case(*shared / "data/contact_examples" / GetParam(), {});
  SurfaceStore store;
  int cases = 0;
  for (const io::Case& c : file.cases) {
    const auto& input = std::get<io::WheelRailCase>(c.content);
    const auto& rail = store.get(input.rail, Body::rail, 0.0, {});
    const auto& wheel = store.get(input.wheel, Body::wheel, input.wheelset.nominal_radius, {});
    wheelrail::Pair pair({rail.represented.surface, wheel.represented.surface, true});
    wheelrail::Problem problem = to_problem(input, true);
    problem.regime = kalker::Regime::frictionless;
    problem.discretisation.search_method = detection::SearchMethod::locus;
    const auto locus = pair.solve(problem);
    problem.discretisation.search_method = detection::SearchMethod::pruned_grid;
    const auto grid = pair.solve(problem);
    const std::string where = "case " + std::to_string(c.number);
    ASSERT_EQ(locus.patches.size(), grid.patches.size()) << where;
    EXPECT_NEAR(locus.z, grid.z, 1e-7) << where;
    for (std::size_t i = 0; i < grid.patches.size(); ++i) {
      const auto &a = locus.patches[i], &b = grid.patches[i];
      EXPECT_LT((a.frame.X_TC.origin - b.frame.X_TC.origin).norm(), 5e-5) << where;
      EXPECT_NEAR(a.frame.angle, b.frame.angle, 5e-4) << where;
      EXPECT_NEAR(a.contact.force_n, b.contact.force_n, 2e-3 * b.contact.force_n) << where;
      EXPECT_NEAR(*ranges::max_element(a.contact.pressure), *ranges::max_element(b.contact.pressure),
                  5e-3 * *ranges::max_element(b.contact.pressure))
          << where;
    }
    ++cases;
  }
  EXPECT_EQ(cases, 21);
}

INSTANTIATE_TEST_SUITE_P(Sides, ManchesterLocus, ::testing::Values("mbench_a22_left.inp", "mbench_a22_right.inp"),
                         [](const auto& side) {
                           return std::string(side.param).find("left") != std::string::npos ? "left" : "right";
                         });

}  // namespace
}  // namespace treadmark::app
