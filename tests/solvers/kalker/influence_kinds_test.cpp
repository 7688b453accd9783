// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"

namespace treadmark::kalker {
namespace {

/// An ellipse-like contact in steady rolling, partly slipping.
struct Rolling8 {
  explicit Rolling8(int n = 20) {
    const double d = 14e-3 / n;
    grid = {-0.5 * (n - 1) * d, -0.5 * (n - 1) * d, d, d, n, n};
    for (int iy = 0; iy < n; ++iy)
      for (int ix = 0; ix < n; ++ix) gap.push_back(1.2 * grid.x(ix) * grid.x(ix) + 2.4 * grid.y(iy) * grid.y(iy));
    problem.grid = grid;
    problem.normal_force = 8e4;
    problem.regime = Regime::steady;
    problem.creepage = {-8e-4, 4e-4, 0.15};
    problem.settings.eps = 1e-7;
  }
  ContactSolution solve() {
    problem.gap = gap;
    return ContactSolver().solve(problem);
  }
  Grid2 grid;
  std::vector<double> gap;
  ContactProblem problem;
};

double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += (a[i] - b[i]) * (a[i] - b[i]);
    size += b[i] * b[i];
  }
  return std::sqrt(sum / size);
}

TEST(InfluenceKinds, BilinearElementsConvergeToTheSameContact) {
  for (const int n : {16, 32, 64}) {
    Rolling8 c(n);
    const ContactSolution constant = c.solve();
    c.problem.influence.kind = InfluenceSettings::Kind::bilinear;
    const ContactSolution bilinear = c.solve();
    ASSERT_EQ(bilinear.status, Status::ok) << bilinear.normal.message << bilinear.tangential.message;
    const double difference = std::max({std::fabs(bilinear.approach / constant.approach - 1.0),
                                        std::fabs(bilinear.force_x - constant.force_x) / constant.force_n / 0.3,
                                        std::fabs(bilinear.force_y - constant.force_y) / constant.force_n / 0.3});
    EXPECT_GT(difference, 1e-8) << "not other elements at all";
    EXPECT_LT(difference, 8e-3 * 16.0 / n) << n;
  }
}

TEST(InfluenceKinds, NoInclinationIsNoCorrection) {
  Rolling8 c;
  const ContactSolution plane = c.solve();
  c.problem.influence.kind = InfluenceSettings::Kind::angle_corrected;
  c.problem.influence.position = {-0.01, 0.01};
  c.problem.influence.inclination = {0.3, 0.3};  // inclined, but plane
  const ContactSolution same = c.solve();
  ASSERT_EQ(same.status, Status::ok) << same.tangential.message;
  EXPECT_LT(relative_difference(same.pressure, plane.pressure), 1e-5);
  EXPECT_LT(relative_difference(same.traction_x, plane.traction_x), 1e-5);
}

TEST(InfluenceKinds, CurvatureCouplesNormalAndTangentialProblem) {
  // a groove that turns by 0.8 rad over the contact: pressures push sideways
  Rolling8 c;
  c.problem.settings.max_coupling = 40;
  const ContactSolution plane = c.solve();
  c.problem.influence.kind = InfluenceSettings::Kind::angle_corrected;
  c.problem.influence.position = {-7e-3, 7e-3};
  c.problem.influence.inclination = {-0.4, 0.4};
  for (const int variant : {1, 2, 3, 4}) {
    c.problem.influence.variant = variant;
    const ContactSolution bent = c.solve();
    ASSERT_EQ(bent.status, Status::ok) << variant << bent.normal.message << bent.tangential.message;
    EXPECT_GT(relative_difference(bent.pressure, plane.pressure), 1e-3) << variant;
    EXPECT_LT(relative_difference(bent.pressure, plane.pressure), 0.2) << variant;
    // the mirror image: the other way round in y
    Rolling8 m;
    m.problem.influence = c.problem.influence;
    m.problem.settings.max_coupling = 40;
    m.problem.creepage.eta = -m.problem.creepage.eta;
    m.problem.creepage.phi = -m.problem.creepage.phi;
    const ContactSolution image = m.solve();
    EXPECT_NEAR(image.force_x, bent.force_x, 1e-4 * bent.force_n) << variant;
    EXPECT_NEAR(image.force_y, -bent.force_y, 1e-4 * bent.force_n) << variant;
  }
}

TEST(InfluenceKinds, ATableOfTheSameCoefficientsIsTheSame) {
  Rolling8 c;
  const ContactSolution own = c.solve();
  const auto kernel = make_influence_kernel(c.problem.material, {}, c.grid.dx, c.grid.dy, 1.0, 0.0);
  auto table = std::make_shared<NumericalInfluence>();
  table->nx = table->ny = 2 * 24 + 1;
  table->dx = c.grid.dx;
  table->dy = c.grid.dy;
  for (int iy = -24; iy <= 24; ++iy)
    for (int ix = -24; ix <= 24; ++ix) {
      const InfluenceBlock b = kernel->at(ix * c.grid.dx, iy * c.grid.dy);
      table->values.push_back({b.nn, b.nx, b.ny, b.xn, b.xx, b.xy, b.yn, b.yx, b.yy});
    }
  c.problem.influence.kind = InfluenceSettings::Kind::table;
  c.problem.influence.table = table;
  const ContactSolution read = c.solve();
  ASSERT_EQ(read.status, Status::ok) << read.tangential.message;
  EXPECT_LT(relative_difference(read.pressure, own.pressure), 1e-6);
  EXPECT_LT(relative_difference(read.traction_x, own.traction_x), 1e-5);
  EXPECT_LT(relative_difference(read.traction_y, own.traction_y), 1e-5);
}

TEST(InfluenceKinds, AVerySoftSheetIsABedOfSprings) {
  Rolling8 c;
  c.problem.regime = Regime::frictionless;
  c.problem.force_prescribed = false;
  c.problem.approach = 3e-5;
  const double soft = 1e-11;  // [m/Pa], hundreds of times the half-spaces'
  c.problem.material.sheet_flexibility = soft;
  const ContactSolution s = c.solve();
  ASSERT_EQ(s.status, Status::ok);
  for (std::size_t i = 0; i < c.gap.size(); ++i) {
    const double expected = std::max(0.0, 3e-5 - c.gap[i]) / soft;
    EXPECT_NEAR(s.pressure[i], expected, 0.02 * 3e-5 / soft);
  }
  c.problem.material.sheet_flexibility = 1e-18;
  const ContactSolution thin = c.solve();
  c.problem.material.sheet_flexibility = 0.0;
  EXPECT_LT(relative_difference(thin.pressure, c.solve().pressure), 1e-3);
}

TEST(InfluenceKinds, ApproximatePressuresKnowTheSheetToo) {
  Rolling8 c;
  c.problem.regime = Regime::frictionless;
  c.problem.force_prescribed = false;
  c.problem.approach = 3e-5;
  c.problem.normal_model = NormalModel::kpec;
  const double bare = c.solve().force_n;
  c.problem.material.sheet_flexibility = 1e-14;
  EXPECT_LT(c.solve().force_n, 0.9 * bare);
}

/// A viscoelastic body is between its two elastic limits, and drags: pressures lean forwards.
TEST(InfluenceKinds, ViscoelasticBodiesLieBetweenTheirLimits) {
  Rolling8 c;
  c.problem.creepage = {};
  const ContactSolution hard = c.solve();
  const auto with = [&](double time) {
    Material& m = c.problem.material;
    m.creep_ratio_1 = m.creep_ratio_2 = 1.0;
    m.relaxation_time_1 = m.relaxation_time_2 = time;
    c.problem.rolling.velocity = 10.0;
    return c.solve();
  };
  const ContactSolution soft = with(0.0), middle = with(5e-4), fast = with(10.0);
  for (const ContactSolution* s : {&soft, &middle, &fast}) ASSERT_EQ(s->status, Status::ok) << s->normal.message;
  EXPECT_NEAR(fast.approach, hard.approach, 0.02 * hard.approach);
  EXPECT_GT(soft.approach, 1.4 * hard.approach);
  EXPECT_GT(middle.approach, 1.02 * hard.approach);
  EXPECT_LT(middle.approach, 0.98 * soft.approach);
  EXPECT_NEAR(soft.moment_y, 0.0, 1e-6 * soft.force_n * 7e-3);
  EXPECT_LT(middle.moment_y, -1e-3 * middle.force_n * 7e-3) << "the resultant lies ahead";
}

}  // namespace
}  // namespace treadmark::kalker
