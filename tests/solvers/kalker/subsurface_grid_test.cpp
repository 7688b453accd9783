// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/subsurface/subsurface_stress.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"
#include "treadmark/tests/solvers/kalker/subsurface_load.hpp"

namespace treadmark::kalker {
namespace {

using testing::kDissimilar;
using testing::Load;
using testing::patch;

void expect_grid_agrees(const Load& load, const std::vector<double>& depths) {
  const auto fast = subsurface_stress_on_grid(load.view(), kDissimilar, depths);
  std::vector<double> x, y;
  for (int ix = 0; ix < load.grid.nx; ++ix) x.push_back(load.grid.x(ix));
  for (int iy = 0; iy < load.grid.ny; ++iy) y.push_back(load.grid.y(iy));
  const auto direct = subsurface_stress(load.view(), kDissimilar, block_of_points(x, y, depths));
  ASSERT_EQ(fast.size(), direct.size());
  double stress = 0, displacement = 0, gradient = 0, difference_s = 0, difference_u = 0, difference_g = 0;
  for (std::size_t i = 0; i < fast.size(); ++i) {
    ASSERT_EQ(fast[i].point, direct[i].point);
    stress = std::max(stress, direct[i].stress.norm());
    displacement = std::max(displacement, direct[i].displacement.norm());
    gradient = std::max(gradient, direct[i].gradient.norm());
    difference_s = std::max(difference_s, (fast[i].stress - direct[i].stress).norm());
    difference_u = std::max(difference_u, (fast[i].displacement - direct[i].displacement).norm());
    difference_g = std::max(difference_g, (fast[i].gradient - direct[i].gradient).norm());
  }
  EXPECT_LT(difference_s, 1e-10 * stress);
  EXPECT_LT(difference_u, 1e-10 * displacement);
  EXPECT_LT(difference_g, 1e-10 * gradient);
}

TEST(Subsurface, TransformsAgreeWithTheSum) {
  Load load = patch(14, 9);
  Random random(7);
  for (auto* field : {&load.pn, &load.px, &load.py})
    for (double& p : *field) p = 1e9 * random.uniform();
  expect_grid_agrees(load, {0.0, 0.3e-3, 5e-3, -0.8e-3});
  load = patch(11, 1);
  load.py.clear();
  expect_grid_agrees(load, {1e-3, -2e-3});
}

TEST(Subsurface, ASolvedPatchGivesTheStressesOfHertz) {
  const Material material{82e9, 82e9, 0.3, 0.3};
  const HertzShape shape = hertz_from_semi_axes(5e-3, 5e-3, {true, 1e5}, combine(material));
  testing::OwnedProblem owned = testing::hertzian(shape, hertz_grid(shape, 41, 41, 1.1));
  owned.problem.material = material;
  ContactSolver solver;
  const ContactSolution solution = solver.solve(owned.problem);
  const Grid2& grid = owned.problem.grid;
  const std::vector<double> depths{5e-3, -5e-3};
  const auto results = subsurface_stress_on_grid(surface_tractions(grid, solution), material, depths);
  for (const std::size_t layer : {0u, 1u}) {
    const SubsurfacePoint& point = results[layer * grid.size() + grid.index(20, 20)];
    // Johnson 1985, eq. (3.45) at the depth of one radius.
    const double radial = -1.3 * (1 - std::atan(1.0)) + 0.25;
    EXPECT_NEAR(point.stress(2, 2) / hertz_max_pressure(shape), -0.5, 2e-3);
    EXPECT_NEAR(point.stress(0, 0) / hertz_max_pressure(shape), radial, 2e-3);
  }
}

TEST(Subsurface, ResultsDoNotDependOnThreads) {
  const Load load = patch(12, 9);
  const std::vector<double> depths{0.4e-3, -1e-3};
  const std::vector<Vec3> points = block_of_points(depths, depths, depths);
  const auto solve = [&](int threads) {
    const ThreadLimit limit(threads);
    auto all = subsurface_stress_on_grid(load.view(), kDissimilar, depths);
    const auto more = subsurface_stress(load.view(), kDissimilar, points);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const auto one = solve(1), four = solve(4);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].stress, four[i].stress);
    EXPECT_EQ(one[i].displacement, four[i].displacement);
  }
}

TEST(Subsurface, RefusesWhatHasNoMeaning) {
  const Load good = patch(5, 4);
  const std::vector<Vec3> points{{0, 0, 1e-3}};
  Load bad = good;
  bad.px.pop_back();
  EXPECT_THROW(subsurface_stress(bad.view(), kDissimilar, points), Error);
  bad = good;
  bad.pn[3] = std::nan("");
  EXPECT_THROW(subsurface_stress(bad.view(), kDissimilar, points), Error);
  EXPECT_THROW(subsurface_stress_on_grid(bad.view(), kDissimilar, std::vector<double>{1e-3}), Error);
  EXPECT_THROW(subsurface_stress_on_grid(good.view(), kDissimilar, std::vector<double>{std::nan("")}), Error);
  EXPECT_THROW(subsurface_stress(good.view(), kDissimilar, std::vector<Vec3>{{0, std::nan(""), 0}}), Error);
  Material material = kDissimilar;
  material.poisson_1 = 0.6;
  EXPECT_THROW(subsurface_stress(good.view(), material, points), Error);
  EXPECT_NO_THROW(subsurface_stress(good.view(), material, std::vector<Vec3>{{0, 0, -1e-3}}));
  EXPECT_TRUE(subsurface_stress(good.view(), kDissimilar, {}).empty());
}

}  // namespace
}  // namespace treadmark::kalker
