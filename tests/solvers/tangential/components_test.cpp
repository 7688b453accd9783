// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <random>

#include "tangential_cases.hpp"
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"
#include "treadmark/solvers/kalker/halfspace/influence.hpp"
#include "treadmark/solvers/kalker/tangential/friction_solve.hpp"
#include "treadmark/solvers/kalker/tangential/friction_sweeps.hpp"
#include "treadmark/solvers/kalker/tangential/gmres.hpp"
#include "treadmark/solvers/kalker/tangential/rigid_slip.hpp"

namespace treadmark::kalker::testing {
namespace {

TEST(Gmres, SolvesANonsymmetricSystem) {
  const std::size_t n = 30;
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<double> a(n * n), exact(n), b(n), x(n);
  for (double& v : a) v = unit(generator);
  for (std::size_t i = 0; i < n; ++i) a[i * n + i] += 6.0;
  for (double& v : exact) v = unit(generator);
  const LinearMap multiply = [&](std::span<const double> in, std::span<double> out) {
    for (std::size_t i = 0; i < n; ++i) {
      out[i] = 0.0;
      for (std::size_t j = 0; j < n; ++j) out[i] += a[i * n + j] * in[j];
    }
  };
  const LinearMap scale = [&](std::span<const double> in, std::span<double> out) {
    for (std::size_t i = 0; i < n; ++i) out[i] = in[i] / a[i * n + i];
  };
  multiply(exact, b);
  Gmres gmres;
  constexpr double kExactly = 1e-6, kSinglePrecision = 1e-6;
  const GmresTarget exactly = [](double size) { return kExactly * size; };
  const GmresResult result = gmres.solve(multiply, scale, b, x, exactly, 40);
  EXPECT_LE(result.residual, kExactly);
  EXPECT_LE(result.iterations, 30);
  EXPECT_LE(distance(x, exact), 2.0 * kExactly);
  // Cut short, the reported residual is the true one, preconditioned.
  const GmresResult rough = gmres.solve(multiply, scale, b, x, exactly, 4);
  EXPECT_EQ(rough.iterations, 4);
  std::vector<double> image(n);
  multiply(x, image);
  double left = 0.0, right = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double d = a[i * n + i];
    left += (image[i] - b[i]) * (image[i] - b[i]) / (d * d);
    right += b[i] * b[i] / (d * d);
  }
  EXPECT_NEAR(rough.residual, std::sqrt(left / right), kSinglePrecision);
  // Nothing to do.
  EXPECT_EQ(gmres.solve(multiply, scale, std::vector<double>(n), x, exactly, 10).iterations, 0);
  EXPECT_EQ(largest(x), 0.0);
}

TEST(Compliance, ProductsAreSumsOverElements) {
  for (const Transport transport : {Transport::none, Transport::forward, Transport::backward})
    for (const int ny : {1, 5}) {
      const ComplianceKey key{8, ny, 1e-3, 0.7e-3, 0.3, 80e9, 2e-15, nullptr};
      Compliance compliance(key);
      std::mt19937 generator(5);
      std::uniform_real_distribution<double> unit(-1.0, 1.0);
      const auto n = static_cast<std::size_t>(8 * ny);
      std::vector<double> px(n), py(n), ux(n), uy(n);
      for (std::size_t i = 0; i < n; ++i)
        if (i % 8 != 7) {  // the last column is kept free
          px[i] = unit(generator);
          py[i] = unit(generator);
        }
      compliance.apply(transport, px, py, ux, uy);
      const int ahead = transport == Transport::none ? 0 : transport == Transport::forward ? 1 : -1;
      for (int i = 0; i < 8 * ny; ++i) {
        double x = 0.0, y = 0.0;
        if (i % 8 == 7) continue;
        for (int j = 0; j < 8 * ny; ++j) {
          const auto part = [&](Component c, int shift) {
            return influence(c, (i % 8 - j % 8 + shift) * 1e-3, (i / 8 - j / 8) * 0.7e-3, 1e-3, 0.7e-3, 0.3) / 80e9;
          };
          const auto of = [&](Component c) { return part(c, 0) - (ahead ? part(c, ahead) : 0.0); };
          double layer = i == j ? 2e-15 : 0.0;
          if (ahead && j == i + ahead && j / 8 == i / 8) layer -= 2e-15;
          const auto at = static_cast<std::size_t>(j);
          x += (of(Component::xx) + layer) * px[at] + of(Component::xy) * py[at];
          y += of(Component::xy) * px[at] + (of(Component::yy) + layer) * py[at];
        }
        EXPECT_NEAR(ux[static_cast<std::size_t>(i)], x, 1e-13 * largest(ux)) << i;
        EXPECT_NEAR(uy[static_cast<std::size_t>(i)], y, 1e-13 * largest(uy)) << i;
      }
    }
}

TEST(Compliance, CoefficientsThatOthersAskedForAreTheSame) {
  UncoupledTable known(1e-3, 0.7e-3, 0.3);
  for (const auto& [nx, ny] : {std::pair{8, 5}, {3, 20}, {12, 1}}) {  // the table grows in either direction, and both
    const ComplianceKey key{nx, ny, 1e-3, 0.7e-3, 0.3, 80e9, 2e-15, nullptr};
    const Compliance shared(key, &known), alone(key);
    for (int dix = -nx; dix <= nx; ++dix)
      for (int diy = 1 - ny; diy < ny; ++diy) {
        const Compliance::Entry a = shared.at(dix, diy), b = alone.at(dix, diy);
        EXPECT_TRUE(a.xx == b.xx && a.xy == b.xy && a.yx == b.yx && a.yy == b.yy) << dix << ' ' << diy;
      }
  }
}

TEST(ElementTraction, MinimisesWithinTheCircle) {
  std::mt19937 generator(9);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const std::array<double, 2> stiffness{1.1 + unit(generator), 1.1 + unit(generator)};
    const std::array<double, 2> c{3.0 * unit(generator), 3.0 * unit(generator)};
    const double bound = 1.0 + unit(generator);
    const std::array<double, 2> q = element_traction(stiffness, c, bound);
    const std::array<double, 2> slip{stiffness[0] * q[0] + c[0], stiffness[1] * q[1] + c[1]};
    const double size = std::hypot(q[0], q[1]);
    EXPECT_LE(size, bound * (1.0 + 1e-12));
    if (size < bound * (1.0 - 1e-9)) {
      EXPECT_NEAR(std::hypot(slip[0], slip[1]), 0.0, 1e-12);
    } else {
      EXPECT_NEAR(slip[0] * q[1] - slip[1] * q[0], 0.0, 1e-10);
      EXPECT_LE(slip[0] * q[0] + slip[1] * q[1], 1e-10);
    }
  }
  EXPECT_EQ(element_traction({1.0, 1.0}, {1.0, 2.0}, 0.0), (std::array<double, 2>{0.0, 0.0}));
}

/// The fall-back alone arrives where Newton's method does; inclination: amplitude by which rows are turned [rad].
void expect_agreement_of_sweeps(double inclination) {
  for (const Transport transport : {Transport::none, Transport::forward, Transport::backward}) {
    Case c = wheel_case(12);
    const Patch patch = make_patch(c.problem.grid, transport, c.solution.state);
    std::shared_ptr<const InfluenceKernel> kernel;
    if (inclination > 0.0) kernel = std::make_shared<ConstantElements>(c.problem.grid.dx, c.problem.grid.dy, 0.28, 0.1);
    Compliance compliance({patch.box_nx, patch.box_ny, c.problem.grid.dx, c.problem.grid.dy, 0.28, 82e9, 0.0, kernel});
    std::optional<RowInclination> rows;
    if (inclination > 0.0) {
      std::vector<double> angle;
      for (int iy = 0; iy < patch.box_ny; ++iy) angle.push_back(inclination * std::sin(0.9 * iy));
      rows.emplace(angle, AngleCorrection::half_and_half);
    }
    PatchOperator matrix(patch, compliance, rows);
    FrictionProblem problem;
    problem.matrix = &matrix;
    const double length = transport == Transport::none ? 5e-3 : 1.0;
    RollingStep step;
    step.transport = transport;
    if (transport != Transport::none) {
      step.distance = c.problem.grid.dx;
      step.shift_x = transport == Transport::forward ? step.distance : -step.distance;
    }
    problem.rigid_slip = rigid_slip(patch, step, {-6e-4 * length, 3e-4 * length, 0.2 * length, 0.0, 0.0}, 1.0 / 6.0);
    for (int i = 0; i < patch.size(); ++i) problem.bound.push_back(0.3 * c.solution.pressure[patch.grid_index(i)]);
    FrictionState newton;
    newton.traction.assign(2 * problem.bound.size(), 0.0);
    ASSERT_TRUE(FrictionNewton().solve(problem, newton, {1e-10, 40, 60}).converged);
    std::vector<double> swept(2 * problem.bound.size());
    FrictionSweeps sweeps(matrix);
    const int count = sweeps.run(problem, swept, 1e-11, 3000);
    EXPECT_LT(count, 3000);
    EXPECT_LE(distance(swept, newton.traction), 1e-7 * largest(problem.bound));
  }
}

TEST(Sweeps, ReachTheSolutionOfNewtonsMethod) { expect_agreement_of_sweeps(0.0); }
TEST(Sweeps, ReachTheSolutionWithTurnedRows) { expect_agreement_of_sweeps(0.4); }

TEST(FrictionSolve, NoFrictionNoTractions) {
  Case c = wheel_case(12);
  c.problem.friction.kinetic = 0.0;
  c.problem.creepage.xi = 1e-3;
  ASSERT_EQ(c.solve().tangential.status, Status::ok);
  EXPECT_EQ(largest(c.solution.traction_x), 0.0);
  EXPECT_EQ(totals(c).adhesion, 0);
}

}  // namespace
}  // namespace treadmark::kalker::testing
