// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::kalker {
namespace {

using testing::hertzian;
using testing::OwnedProblem;

/// The reference prints four significant digits: half a unit of the last one is 5e-4 at most, plus its own accuracy.
constexpr double kPrinted = 6e-4;

void expect_printed(double ours, double printed, const char* what) {
  EXPECT_NEAR(ours, printed, kPrinted * std::abs(printed)) << what;
}

void expect_normal(const ContactSolution& solution, const nlohmann::json& patch, double force_tolerance = kPrinted) {
  EXPECT_NEAR(solution.force_n / patch.at("fn_N").get<double>(), 1.0, force_tolerance);
  expect_printed(solution.approach * 1e3, patch.at("approach_mm"), "approach");
  expect_printed(solution.max_pressure * 1e-6, patch.at("pmax_MPa"), "greatest pressure");
  EXPECT_EQ(solution.elements_contact, patch.at("elements").at("ncon").get<int>());
}

/// The reference prints the prescribed force; ours is the sum of the assumed pressures at element centres.
constexpr double kAssumedForce = 1e-3;

nlohmann::json first_patches(const std::filesystem::path& shared, const std::string& name) {
  nlohmann::json patches;
  for (const auto& entry : nlohmann::json::parse(std::ifstream(shared / "reference" / (name + ".json"))))
    patches.push_back(entry.at("patches").at(0));
  return patches;
}

TEST(ReferenceCases, CattaneoNormalProblem) {
  TREADMARK_REQUIRE_SHARED();
  const auto patch = first_patches(*shared, "cattaneo").at(0);
  const Material polyethylene{200e6, 200e6, 0.42, 0.42};
  const HertzShape shape = hertz_from_semi_axes(1e-3, 1e-3, {true, 9.1954}, combine(polyethylene));
  expect_printed(shape.curvature_x, 10.0, "curvature A [1/m]");
  OwnedProblem owned = hertzian(shape, hertz_grid(shape, 19, 19, 1.26667));
  owned.problem.material = polyethylene;
  ContactSolver solver;
  const ContactSolution solution = solver.solve(owned.problem);
  expect_normal(solution, patch);
  expect_printed(solution.elastic_energy, patch.at("elastic_energy_J"), "energy");
  EXPECT_EQ(solution.elements_adhesion, patch.at("elements").at("nadh").get<int>());
  EXPECT_EQ(solution.elements_slip, 0);
}

TEST(ReferenceCases, CarterNormalProblem) {
  TREADMARK_REQUIRE_SHARED();
  const auto patch = first_patches(*shared, "carter2d").at(0);
  const Grid2 grid{-1.05e-3, 0.0, 0.04e-3, 0.2, 55, 1};
  std::vector<double> gap;
  for (int ix = 0; ix < grid.nx; ++ix) gap.push_back(grid.x(ix) * grid.x(ix));
  OwnedProblem owned(grid, std::move(gap));
  owned.problem.normal_force = 35780.0;
  ContactSolver solver;
  expect_normal(solver.solve(owned.problem), patch);
}

/// Locomotive wheel of the reference program's traction curves.
OwnedProblem locomotive() {
  const HertzShape shape = hertz_from_curvature_and_ratio(0.8, 0.5, {true, 106700.0}, combine(Material{}));
  OwnedProblem owned = hertzian(shape, hertz_grid(shape, 48, 44, 1.1));
  owned.problem.hertz = shape;
  owned.problem.rolling.velocity = 10.0;
  owned.problem.friction.kinetic = 0.33;
  return owned;
}

TEST(ReferenceCases, TractionCurveNormalProblem) {
  TREADMARK_REQUIRE_SHARED();
  const auto patches = first_patches(*shared, "tractcurv");
  OwnedProblem owned = locomotive();
  ContactSolver solver;
  const ContactSolution solution = solver.solve(owned.problem);
  expect_normal(solution, patches.at(0));
  expect_printed(owned.problem.grid.dx * 1e3, patches.at(0).at("kinematics").at("dq_mm"), "dx");
}

TEST(ReferenceCases, FastsimTractionCurves) {
  TREADMARK_REQUIRE_SHARED();
  const auto patches = first_patches(*shared, "tractcurv");
  ASSERT_EQ(patches.size(), 120u);
  OwnedProblem owned = locomotive();
  ContactProblem& problem = owned.problem;
  problem.normal_model = NormalModel::parabolic;
  problem.tangential_model = TangentialModel::fastsim;
  problem.fastsim.first_step = FastsimSettings::FirstStep::whole;
  problem.regime = Regime::steady;
  ContactSolver solver;
  for (std::size_t k = 60; k < 120; ++k) {
    SCOPED_TRACE("case " + std::to_string(k + 1));
    const auto& patch = patches.at(k);
    if (k == 90) {  // slope reduction and falling friction
      problem.friction = {FrictionLaw::Kind::exponential, 0.1368, 0.2232, 0.0, 0.990, 0.0};
      problem.fastsim = {0.54, 0.02, 0.62, 0.0, FastsimSettings::FirstStep::whole};
    }
    problem.creepage.xi = patch.at("kinematics").at("xi");
    const ContactSolution solution = solver.solve(problem);
    expect_normal(solution, patch, kAssumedForce);
    expect_printed(solution.force_x, patch.at("fx_N"), "F_x");
    expect_printed(solution.frictional_power, patch.at("frictional_power_W"), "power");
    EXPECT_EQ(solution.elements_adhesion, patch.at("elements").at("nadh").get<int>());
    EXPECT_EQ(solution.elements_slip, patch.at("elements").at("nslip").get<int>());
    EXPECT_EQ(solution.elastic_energy, 0.0);
    EXPECT_EQ(solution.moment_n, 0.0) << "symmetric";
  }
}

TEST(ReferenceCases, FastsimWithSpin) {
  TREADMARK_REQUIRE_SHARED();
  const auto patches = first_patches(*shared, "fastsim");
  const HertzShape shape = hertz_from_semi_axes(8e-3, 4e-3, {true, 82e3}, combine(Material{}));
  // Cases of the example file: (index, elements each way, pressure).
  struct Case {
    std::size_t index;
    int n;
    NormalModel model;
  };
  for (const Case& c :
       {Case{1, 44, NormalModel::parabolic}, Case{2, 44, NormalModel::elliptic}, Case{4, 220, NormalModel::parabolic},
        Case{5, 220, NormalModel::elliptic}, Case{7, 220, NormalModel::parabolic}}) {
    SCOPED_TRACE("case " + std::to_string(c.index + 1));
    const auto& patch = patches.at(c.index);
    OwnedProblem owned = hertzian(shape, hertz_grid(shape, c.n, c.n, 1.1));
    ContactProblem& problem = owned.problem;
    problem.hertz = shape;
    problem.normal_model = c.model;
    problem.tangential_model = TangentialModel::fastsim;
    problem.fastsim.first_step = FastsimSettings::FirstStep::whole;
    problem.regime = Regime::steady;
    problem.rolling.chi = patch.at("kinematics").at("chi_rad").get<double>() > 1.0 ? std::acos(-1.0) : 0.0;
    problem.creepage.eta = patch.at("kinematics").at("eta");
    problem.creepage.phi = patch.at("kinematics").at("phi").get<double>() * 1e3;
    ContactSolver solver;
    const ContactSolution solution = solver.solve(problem);
    expect_normal(solution, patch, kAssumedForce);
    expect_printed(solution.force_y, patch.at("fs_N"), "F_y");
    expect_printed(solution.moment_n * 1e3, patch.at("mn_Nmm"), "M_n");
    expect_printed(solution.frictional_power, patch.at("frictional_power_W"), "power");
    EXPECT_EQ(solution.elements_adhesion, patch.at("elements").at("nadh").get<int>());
    EXPECT_EQ(solution.elements_slip, patch.at("elements").at("nslip").get<int>());
  }
}

}  // namespace
}  // namespace treadmark::kalker
