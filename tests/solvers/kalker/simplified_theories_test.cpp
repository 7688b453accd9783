// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using testing::hertzian;
using testing::OwnedProblem;

/// The reference program's example "fastsim": 8 x 4 mm, 82 kN, lateral creepage and spin; what it prints.
struct Reference {
  const char* name;
  int n;  ///< elements each way over 1.1 times the ellipse
  NormalModel normal;
  TangentialModel tangential;
  double force_y, moment_n, power;  ///< [N], [N m], [W]
  int adhesion;
  double tolerance = 6e-4;  ///< four digits
  int elements = 0;         ///< that adhesion may differ by
};

constexpr Reference kReferences[] = {
    {"full theory", 44, NormalModel::full, TangentialModel::full, -14940.0, -48.21, -540.4, 356},
    {"parabolic", 44, NormalModel::parabolic, TangentialModel::fastsim, -15050.0, -39.00, -509.3, 738},
    {"elliptic", 44, NormalModel::elliptic, TangentialModel::fastsim, -14800.0, -48.29, -694.4, 618},
    // Here tractions at the leading edge are bounded by friction, those of the reference are not; and the force is that
    // of the pressures at element centres.
    {"FaStrip", 44, NormalModel::elliptic, TangentialModel::fastrip, -15830.0, -48.16, -614.0, 626, 6e-3, 2},
    {"parabolic, fine", 220, NormalModel::parabolic, TangentialModel::fastsim, -15640.0, -37.98, -560.8, 18424},
    {"elliptic, fine", 220, NormalModel::elliptic, TangentialModel::fastsim, -14650.0, -45.30, -737.3, 16572},
    {"FaStrip, fine", 220, NormalModel::elliptic, TangentialModel::fastrip, -15850.0, -47.57, -668.1, 15866, 1.5e-3, 2},
};

OwnedProblem reference_problem(const Reference& reference) {
  const HertzShape shape = hertz_from_semi_axes(8e-3, 4e-3, {true, 82e3}, combine(Material{}));
  OwnedProblem owned = hertzian(shape, hertz_grid(shape, reference.n, reference.n, 1.1));
  owned.problem.hertz = shape;
  owned.problem.normal_model = reference.normal;
  owned.problem.tangential_model = reference.tangential;
  owned.problem.fastsim.first_step = FastsimSettings::FirstStep::whole;
  owned.problem.regime = Regime::steady;
  owned.problem.creepage = {0.0, -6.25e-4, 0.625};
  return owned;
}

void expect_reference(const ContactSolution& solution, const Reference& reference, double sign) {
  EXPECT_EQ(solution.status, Status::ok);
  EXPECT_NEAR(solution.force_y / reference.force_y, 1.0, reference.tolerance);
  EXPECT_NEAR(sign * solution.moment_n / reference.moment_n, 1.0, reference.tolerance);
  EXPECT_NEAR(solution.frictional_power / reference.power, 1.0, reference.tolerance);
  EXPECT_NEAR(solution.elements_adhesion, reference.adhesion, reference.elements);
}

TEST(SimplifiedTheories, ReproduceTheReferenceExample) {
  for (const Reference& reference : kReferences) {
    SCOPED_TRACE(reference.name);
    ContactSolver solver;
    expect_reference(solver.solve(reference_problem(reference).problem), reference, 1.0);
  }
}

TEST(SimplifiedTheories, ReversedRollingIsTheMirrorImage) {
  // The example's last case; rolling and spin reversed give the same lateral force and the opposite moment.
  for (const Reference& reference : kReferences) {
    SCOPED_TRACE(reference.name);
    OwnedProblem owned = reference_problem(reference);
    owned.problem.rolling.chi = std::numbers::pi;
    owned.problem.creepage.phi = -0.625;
    ContactSolver solver;
    expect_reference(solver.solve(owned.problem), reference, -1.0);
  }
}

/// Hertzian contact of 6 x 4 mm on a grid that the grid's origin is not the middle of.
OwnedProblem rolling(TangentialModel model, const Creepage& creepage, double shift_x = 0.0, double shift_y = 0.0) {
  const HertzShape shape = hertz_from_semi_axes(6e-3, 4e-3, {true, 80e3}, combine(Material{}));
  const Grid2 grid = hertz_grid(shape, 40, 40, 1.1);
  OwnedProblem owned = hertzian(shape, grid);
  owned.problem.grid.x0 += shift_x;
  owned.problem.grid.y0 += shift_y;
  owned.problem.tangential_model = model;
  owned.problem.fastsim.flexibility = 3e-14;
  owned.problem.regime = Regime::steady;
  owned.problem.creepage = creepage;
  owned.problem.creepage.spin_x += shift_x;
  owned.problem.creepage.spin_y += shift_y;
  return owned;
}

constexpr TangentialModel kSimplified[] = {TangentialModel::fastsim, TangentialModel::fastsim_one_flexibility,
                                           TangentialModel::fastrip};

TEST(SimplifiedTheories, DoNotDependOnWhereTheOriginIs) {
  const Creepage creepage{4e-4, -3e-4, 0.3, 0.0, 0.0};
  for (const TangentialModel model : kSimplified) {
    ContactSolver solver;
    const ContactSolution at_origin = solver.solve(rolling(model, creepage).problem);
    const ContactSolution apart = solver.solve(rolling(model, creepage, 0.05, -0.02).problem);
    EXPECT_NEAR(at_origin.force_x, apart.force_x, 1e-6 * at_origin.force_n);
    EXPECT_NEAR(at_origin.force_y, apart.force_y, 1e-6 * at_origin.force_n);
    EXPECT_NEAR(at_origin.frictional_power, apart.frictional_power, 1e-5 * std::abs(apart.frictional_power));
  }
}

TEST(SimplifiedTheories, MirrorAcrossTheTrack) {
  for (const TangentialModel model : kSimplified) {
    ContactSolver solver;
    const ContactSolution one = solver.solve(rolling(model, {4e-4, -3e-4, 0.3}).problem);
    const ContactSolution other = solver.solve(rolling(model, {4e-4, 3e-4, -0.3}).problem);
    EXPECT_NEAR(one.force_x, other.force_x, 1e-6 * one.force_n);
    EXPECT_NEAR(one.force_y, -other.force_y, 1e-6 * one.force_n);
    EXPECT_NEAR(one.moment_n, -other.moment_n, 1e-6 * std::abs(one.moment_n));
    EXPECT_EQ(one.elements_slip, other.elements_slip);
  }
}

TEST(SimplifiedTheories, SlipOfEveryElementAddsToCreepage) {
  // With one flexibility nothing but slip itself depends on the creepage.
  const TangentialModel model = TangentialModel::fastsim_one_flexibility;
  OwnedProblem owned = rolling(model, {4e-4, -3e-4, 0.0});
  const ContactSolution whole = ContactSolver().solve(owned.problem);
  const std::vector<double> slip_x(owned.problem.grid.size(), 1e-4), slip_y(owned.problem.grid.size(), -2e-4);
  owned.problem.creepage.xi = 3e-4, owned.problem.creepage.eta = -1e-4;
  owned.problem.extra_slip_x = slip_x, owned.problem.extra_slip_y = slip_y;
  const ContactSolution split = ContactSolver().solve(owned.problem);
  for (std::size_t i = 0; i < whole.pressure.size(); ++i) {
    ASSERT_NEAR(split.traction_x[i], whole.traction_x[i], 1e-9 * whole.max_pressure);
    ASSERT_NEAR(split.traction_y[i], whole.traction_y[i], 1e-9 * whole.max_pressure);
  }
  owned.problem.tangential_model = TangentialModel::fastrip;
  EXPECT_THROW(ContactSolver().solve(owned.problem), Error);
}

/// Kalker's coefficients (1990, table E.3) for a Poisson ratio of 1/4.
struct LinearCoefficients {
  double ratio, c11, c22, c23, c33;
};

constexpr LinearCoefficients kLinear[] = {{0.1, 3.31, 2.52, 0.473, 8.28}, {0.2, 3.37, 2.63, 0.603, 4.27},
                                          {0.5, 3.62, 3.01, 0.929, 1.93}, {1.0, 4.12, 3.67, 1.47, 1.19},
                                          {2.0, 5.10, 4.90, 2.62, 0.819}, {5.0, 7.78, 8.14, 6.63, 0.601},
                                          {10.0, 11.7, 12.8, 14.6, 0.526}};

ContactSolution linear_theory(double ratio, int n, const Creepage& creepage) {
  const double c = 5e-3;
  Material material;
  material.poisson_1 = material.poisson_2 = 0.25;
  const HertzShape shape =
      hertz_from_semi_axes(c * std::sqrt(ratio), c / std::sqrt(ratio), {true, 82e3}, combine(material));
  OwnedProblem owned = hertzian(shape, hertz_grid(shape, n, n, 1.0));
  owned.problem.material = material;
  owned.problem.hertz = shape;
  owned.problem.normal_model = NormalModel::elliptic;
  owned.problem.tangential_model = TangentialModel::linear;
  owned.problem.regime = Regime::steady;
  owned.problem.creepage = creepage;
  ContactSolution solution = ContactSolver().solve(owned.problem);
  EXPECT_EQ(solution.elements_slip, 0);
  return solution;
}

/// C11, C22, C23 of the force by spin, C23 of the moment by lateral creepage, C33, referred to the area of the elements
/// in contact.
std::array<double, 5> linear_coefficients(double ratio, int n) {
  constexpr double kSmall = 1e-6, kSpin = 1e-4;
  const ContactSolution by_xi = linear_theory(ratio, n, {kSmall, 0.0, 0.0}),
                        by_eta = linear_theory(ratio, n, {0.0, kSmall, 0.0}),
                        by_phi = linear_theory(ratio, n, {0.0, 0.0, kSpin});
  const double element = 4.0 * 25e-6 / (n * n), c = std::sqrt(by_xi.elements_contact * element / std::numbers::pi),
               g = combine(Material{}).shear_modulus;
  return {-by_xi.force_x / (g * c * c * kSmall), -by_eta.force_y / (g * c * c * kSmall),
          -by_phi.force_y / (g * c * c * c * kSpin), by_eta.moment_n / (g * c * c * c * kSmall),
          -by_phi.moment_n / (g * c * c * c * c * kSpin)};
}

/// Two grids, extrapolated at first order.
std::array<double, 5> extrapolated_coefficients(double ratio) {
  const std::array<double, 5> coarse = linear_coefficients(ratio, 40), fine = linear_coefficients(ratio, 80);
  std::array<double, 5> out{};
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = 2.0 * fine[k] - coarse[k];
  return out;
}

TEST(SimplifiedTheories, LinearTheoryHasKalkersFiveCoefficients) {
  // Of the table, which is good to one per cent, and of the jagged edge.
  constexpr double kTable = 0.02;
  for (const LinearCoefficients& k : kLinear) {
    SCOPED_TRACE("a/b = " + std::to_string(k.ratio));
    const std::array<double, 5> found = extrapolated_coefficients(k.ratio), table{k.c11, k.c22, k.c23, k.c23, k.c33};
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i] / table[i], 1.0, kTable) << i;
    EXPECT_NEAR(found[2] / found[3], 1.0, 2e-3) << "reciprocity";
  }
}

TEST(SimplifiedTheories, LinearTheoryDoesNotJumpWhereKalkersTableEnds) {
  constexpr double kSmooth = 1e-3;  // second difference of a power of the ratio; the asymptotes are 2 to 6 % off
  for (const double ratio : {0.1, 10.0}) {
    const std::array<double, 5> below = linear_coefficients(0.99 * ratio, 40), at = linear_coefficients(ratio, 40),
                                above = linear_coefficients(1.01 * ratio, 40);
    for (std::size_t k = 0; k < at.size(); ++k)
      EXPECT_NEAR((below[k] + above[k]) / (2.0 * at[k]), 1.0, kSmooth) << ratio << " " << k;
  }
}

TEST(SimplifiedTheories, LinearTheoryIsLinearAndKnowsItsLimit) {
  const ContactSolution once = linear_theory(2.0, 40, {4e-4, 0.0, 0.0}),
                        twice = linear_theory(2.0, 40, {8e-4, 0.0, 0.0});
  EXPECT_EQ(once.status, Status::ok);
  EXPECT_NEAR(twice.force_x / once.force_x, 2.0, 1e-4);
  const ContactSolution beyond = linear_theory(2.0, 40, {5e-3, 0.0, 0.0});
  EXPECT_EQ(beyond.status, Status::not_converged);
  EXPECT_NE(beyond.tangential.message.find("beyond"), std::string::npos);
}

TEST(SimplifiedTheories, LinearTheoryIsFullTheoryWhereFrictionIsBoundless) {
  OwnedProblem owned = rolling(TangentialModel::linear, {4e-4, -3e-4, 0.3});
  owned.problem.normal_model = NormalModel::full;
  owned.problem.friction.kinetic = 1e3;
  const ContactSolution linear = ContactSolver().solve(owned.problem);
  owned.problem.tangential_model = TangentialModel::full;
  const ContactSolution full = ContactSolver().solve(owned.problem);
  EXPECT_NEAR(linear.force_x / full.force_x, 1.0, 1e-3);
  EXPECT_NEAR(linear.force_y / full.force_y, 1.0, 1e-3);
  EXPECT_NEAR(linear.moment_n / full.moment_n, 1.0, 1e-2);
}

TEST(SimplifiedTheories, LinearTheoryFindsTheCreepageOfAForce) {
  OwnedProblem owned = rolling(TangentialModel::linear, {0.0, 0.0, 0.1});
  owned.problem.fx_relative = -0.2;
  owned.problem.fy_relative = 0.3;
  const ContactSolution found = ContactSolver().solve(owned.problem);
  ASSERT_EQ(found.status, Status::ok) << found.tangential.message;
  const double bound = 0.3 * found.force_n;
  EXPECT_NEAR(found.force_x / bound, -0.2, 1e-4);
  EXPECT_NEAR(found.force_y / bound, 0.3, 1e-4);
  owned.problem.fx_relative = -0.9;
  owned.problem.fy_relative = 0.9;
  EXPECT_EQ(ContactSolver().solve(owned.problem).status, Status::not_converged);
}

TEST(SimplifiedTheories, HaveTheirTractionsBoundedByFriction) {
  for (const TangentialModel model : kSimplified)
    for (const Creepage& creepage : {Creepage{1e-3, -5e-4, 0.4}, Creepage{0.0, 0.0, 0.8}, Creepage{0.0, 2e-4, 0.9}}) {
      ContactSolver solver;
      const OwnedProblem owned = rolling(model, creepage);
      const ContactSolution solution = solver.solve(owned.problem);
      for (std::size_t i = 0; i < solution.pressure.size(); ++i) {
        const double bound = 0.3 * solution.pressure[i],
                     size = std::hypot(solution.traction_x[i], solution.traction_y[i]);
        ASSERT_LE(size, bound * (1.0 + 1e-12));
        if (solution.state[i] == ElementState::slip) {
          ASSERT_NEAR(size, bound, 1e-9 * bound);
        }
      }
      EXPECT_LT(solution.frictional_power, 0.0);
      const ContactSolution normal = ContactSolver().solve_normal(owned.problem);
      EXPECT_GT(solution.elastic_energy, normal.elastic_energy) << "the elastic layer takes up some";
      EXPECT_LT(solution.elastic_energy, 1.2 * normal.elastic_energy);
    }
}

TEST(SimplifiedTheories, SlideWithTheFrictionBound) {
  for (const TangentialModel model : kSimplified) {
    ContactSolver solver;
    const ContactSolution solution = solver.solve(rolling(model, {0.03, -0.04, 0.0}).problem);
    const double bound = 0.3 * solution.force_n;
    EXPECT_NEAR(solution.force_x, -0.6 * bound, 1e-2 * bound);
    EXPECT_NEAR(solution.force_y, 0.8 * bound, 1e-2 * bound);
    EXPECT_NEAR(std::hypot(solution.force_x, solution.force_y), bound, 1e-4 * bound);
  }
}

TEST(SimplifiedTheories, FindCreepageForPrescribedForces) {
  for (const TangentialModel model : kSimplified) {
    ContactSolver solver;
    OwnedProblem owned = rolling(model, {0.0, 0.0, 0.1});
    owned.problem.fx_relative = -0.4;
    owned.problem.fy_relative = 0.3;
    const ContactSolution solution = solver.solve(owned.problem);
    ASSERT_EQ(solution.status, Status::ok) << solution.tangential.message;
    EXPECT_NEAR(solution.force_x / (0.3 * solution.force_n), -0.4, 1e-4);
    EXPECT_NEAR(solution.force_y / (0.3 * solution.force_n), 0.3, 1e-4);
  }
}

}  // namespace
}  // namespace treadmark::kalker
