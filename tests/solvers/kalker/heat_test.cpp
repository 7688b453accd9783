// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/heat/surface_temperature.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::kalker {
namespace {

using testing::OwnedProblem;

const ThermalProperties kSteelHeat{0.0, 450.0, 50.0, 7850.0};
const ThermalProperties kComposite{80.0, 900.0, 2.0, 2300.0};

double effusivity(const ThermalProperties& t) { return std::sqrt(t.heat_capacity * t.conductivity * t.density); }

/// A row of elements of which some slide, without a contact problem behind it.
struct HeatedRow {
  ContactProblem problem;
  ContactSolution solution;

  HeatedRow(int n, double dx, double chi, const ThermalProperties& rail, const ThermalProperties& wheel) {
    problem.grid = {0.0, 0.0, dx, 1e-3, n, 1};
    problem.regime = Regime::steady;
    problem.rolling = {chi, 20.0, 0.0, 0.0};
    problem.thermal = Thermal{rail, wheel, 1.0};
    const auto size = static_cast<std::size_t>(n);
    for (auto* field : {&solution.traction_x, &solution.traction_y, &solution.slip_x, &solution.slip_y})
      field->assign(size, 0.0);
    solution.state.assign(size, ElementState::exterior);
  }
  /// Elements [first, last] slide with a heat flux q [W/m^2].
  void slide(int first, int last, double q) {
    for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
      solution.state[i] = ElementState::slip;
      solution.traction_x[i] = -0.6e8;
      solution.traction_y[i] = 0.8e8;
      solution.slip_x[i] = 0.6 * q / (1e8 * problem.rolling.velocity);
      solution.slip_y[i] = -0.8 * q / (1e8 * problem.rolling.velocity);
    }
  }
};

TEST(SurfaceTemperature, UniformSlidingHeatsLikeABandSource) {
  const double dx = 0.1e-3, q = 3e8;
  for (const double chi : {0.0, kPi}) {
    HeatedRow row(100, dx, chi, kSteelHeat, kSteelHeat);
    row.slide(30, 59, q);
    const SurfaceTemperatures t = surface_temperatures(row.problem, row.solution);
    // Carslaw and Jaeger 1959, section 2.9: T = 2 q / b (sqrt(t) - sqrt(t - t0)) / sqrt(pi), half the heat to each
    // body.
    const double factor = 2 * q / (2 * effusivity(kSteelHeat) * std::sqrt(kPi * row.problem.rolling.velocity));
    for (int i = 0; i < 100; ++i) {
      const double passed = chi == 0.0 ? (59 - i + 0.5) * dx : (i - 30 + 0.5) * dx, length = 30 * dx;
      const double exact =
          passed < 0 ? 0.0 : factor * (std::sqrt(passed) - (passed > length ? std::sqrt(passed - length) : 0.0));
      EXPECT_NEAR(t.body_1[static_cast<std::size_t>(i)], exact, 1e-10 * factor) << i;
      EXPECT_NEAR(t.body_2[static_cast<std::size_t>(i)], exact, 1e-10 * factor) << i;
    }
    EXPECT_NEAR(t.max_1, factor * std::sqrt(29.5 * dx), 1e-10 * t.max_1);
  }
}

TEST(SurfaceTemperature, AnEllipticalSourceConvergesToTheExactMaximum) {
  const double a = 5e-3, q = 3e8;
  const auto error = [&](int n, Conventions conventions) {
    HeatedRow row(n, 2 * a / n, kPi, kSteelHeat, kSteelHeat);
    for (int i = 0; i < n; ++i) row.slide(i, i, q * std::sqrt(1.0 - std::pow((2.0 * i + 1.0) / n - 1.0, 2)));
    row.problem.thermal->conventions = conventions;
    const double exact =
        2.18830 * q * std::sqrt(a) / (2 * effusivity(kSteelHeat) * std::sqrt(kPi * row.problem.rolling.velocity));
    return std::abs(surface_temperatures(row.problem, row.solution).max_1 / exact - 1.0);
  };
  EXPECT_LT(error(50, Conventions::treadmark), 2e-3);
  EXPECT_LT(error(400, Conventions::treadmark), 1e-4);
  EXPECT_GT(error(400, Conventions::contact), 0.02);
}

/// Heat that has flowed into both bodies per area of surface, from what is left of it far behind the contact.
double heat_far_behind(const HeatedRow& row, const SurfaceTemperatures& t, double centre) {
  const std::size_t i = row.problem.grid.size() - 1;
  const double root =
      std::sqrt(kPi * row.problem.rolling.velocity * (row.problem.grid.x(static_cast<int>(i)) - centre));
  const Thermal& thermal = *row.problem.thermal;
  return root * (effusivity(thermal.body_1) * (t.body_1[i] - thermal.body_1.bulk_temperature) +
                 effusivity(thermal.body_2) * (t.body_2[i] - thermal.body_2.bulk_temperature));
}

TEST(SurfaceTemperature, HeatIsConserved) {
  const double dx = 0.1e-3;
  for (const bool sliding : {true, false}) {
    HeatedRow row(4000, dx, kPi, kSteelHeat, kComposite);
    row.slide(10, 39, sliding ? 3e8 : 0.0);
    const SurfaceTemperatures t = surface_temperatures(row.problem, row.solution);
    const double heat = sliding ? 3e8 * 30 * dx : 0.0;
    EXPECT_NEAR(heat_far_behind(row, t, 24.5 * dx), heat, 1e-4 * 3e8 * 30 * dx);
    row.problem.thermal->conventions = Conventions::contact;
    const SurfaceTemperatures other = surface_temperatures(row.problem, row.solution);
    if (sliding) {
      EXPECT_GT(std::abs(heat_far_behind(row, other, 24.5 * dx) - heat), 0.1 * heat);
    }
  }
}

TEST(SurfaceTemperature, BothSurfacesAreEquallyWarmInContact) {
  HeatedRow row(60, 0.1e-3, kPi, kSteelHeat, kComposite);
  row.slide(5, 40, 1e8);
  const SurfaceTemperatures t = surface_temperatures(row.problem, row.solution);
  for (std::size_t i = 5; i <= 40; ++i) EXPECT_NEAR(t.body_1[i], t.body_2[i], 1e-10 * t.body_2[i]);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(t.body_1[i], 0.0);
    EXPECT_EQ(t.body_2[i], 80.0);
  }
}

TEST(SurfaceTemperature, ConductionRelaxesAsTheExchangedHeatDemands) {
  const double dx = 0.1e-3, velocity = 20.0, length = 20 * dx;
  for (const double chi : {0.0, kPi}) {
    HeatedRow row(80, dx, chi, kSteelHeat, kComposite);
    for (int i = 30; i < 50; ++i) row.solution.state[static_cast<std::size_t>(i)] = ElementState::adhesion;
    const SurfaceTemperatures t = surface_temperatures(row.problem, row.solution);
    const double b1 = effusivity(kSteelHeat), b2 = effusivity(kComposite), difference = 80.0;
    const double common = (b1 * 0.0 + b2 * 80.0) / (b1 + b2);
    EXPECT_NEAR(t.body_1[40], common, 1e-9);
    EXPECT_NEAR(t.max_2, common, 1e-9);
    // In contact body 1 takes the flux q = b1 b2 / (b1 + b2) dT / sqrt(pi t); what it leaves behind, by quadrature.
    for (const int behind : {1, 5, 25}) {
      const double passed = length + (behind - 0.5) * dx,
                   flux = b1 * b2 / (b1 + b2) * difference * std::sqrt(velocity / kPi);
      double integral = 0.0;
      const int n = 20000;
      for (int k = 0; k < n; ++k) {  // s = length u^2 takes the singularity at the leading edge away
        const double u = (k + 0.5) / n;
        integral += 2 * std::sqrt(length) / std::sqrt(passed - length * u * u) / n;
      }
      const double rise = flux * integral / (b1 * std::sqrt(kPi * velocity));
      const auto i = static_cast<std::size_t>(chi == 0.0 ? 30 - behind : 49 + behind);
      EXPECT_NEAR(t.body_1[i], rise, 2e-6 * rise) << behind;
      EXPECT_NEAR(t.body_2[i], 80.0 - rise * b1 / b2, 2e-6 * 80.0) << behind;
    }
  }
}

TEST(SurfaceTemperature, PlasticShearOfTheLayerHeatsByItsShare) {
  HeatedRow row(10, 0.1e-3, kPi, kSteelHeat, kSteelHeat);
  row.problem.thermal->plastic_fraction = 0.4;
  for (std::size_t i = 3; i < 7; ++i) {
    row.solution.state[i] = ElementState::plastic;
    row.solution.traction_x[i] = 1e8;
  }
  row.solution.plastic_x = {0, 0, 0, 1e-6, 3e-6, 6e-6, 6e-6, 6e-6, 6e-6, 6e-6};
  row.solution.plastic_y.assign(10, 0.0);
  const std::vector<double> q = frictional_heat(row.problem, row.solution, 0.4);
  const double unit = 1e8 * 0.4 * 1e-6 * 20.0 / 0.1e-3;  // traction, share, shear in the time of one element
  const std::vector<double> expected{0, 0, 0, 1, 2, 3, 0, 0, 0, 0};
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(q[i], unit * expected[i], 1e-9 * unit);
  EXPECT_GT(surface_temperatures(row.problem, row.solution).max_1, 1.0);
}

TEST(SurfaceTemperature, RefusesWhatHasNoMeaning) {
  const HeatedRow good(10, 0.1e-3, 0.0, kSteelHeat, kSteelHeat);
  const auto refuses = [&](auto change) {
    HeatedRow row = good;
    change(row);
    EXPECT_THROW(surface_temperatures(row.problem, row.solution), Error);
  };
  EXPECT_NO_THROW(surface_temperatures(good.problem, good.solution));
  refuses([](HeatedRow& r) { r.problem.thermal.reset(); });
  refuses([](HeatedRow& r) { r.problem.thermal->body_2.conductivity = 0.0; });
  refuses([](HeatedRow& r) { r.problem.regime = Regime::shift; });
  refuses([](HeatedRow& r) { r.problem.rolling.velocity = 0.0; });
  refuses([](HeatedRow& r) { r.problem.rolling.chi = 1.0; });
  refuses([](HeatedRow& r) { r.solution.slip_y.pop_back(); });
  refuses([](HeatedRow& r) { r.solution.plastic_x.assign(10, 0.0); });
}

/// The reference program's example after Ertz and Knothe 2002: four cases of sliding and of wheel temperature.
TEST(SurfaceTemperature, ReferenceCases) {
  TREADMARK_REQUIRE_SHARED();
  const auto cases = nlohmann::json::parse(std::ifstream(*shared / "reference" / "ertz_temperature.json"));
  const Grid2 grid{-7.8e-3, -11.0e-3, 0.2e-3, 0.5e-3, 216, 45};
  std::vector<double> gap;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix)
      gap.push_back(1.015 * grid.x(ix) * grid.x(ix) + 0.4215 * grid.y(iy) * grid.y(iy));
  OwnedProblem owned(grid, std::move(gap));
  ContactProblem& problem = owned.problem;
  problem.normal_force = 100000.0;
  problem.friction.kinetic = 0.3;
  problem.regime = Regime::steady;
  problem.rolling = {kPi, 30.0, 0.2e-3};
  ContactSolver solver;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    SCOPED_TRACE(k + 1);
    const auto& patch = cases.at(k).at("patches").at(0);
    const auto& motion = patch.at("kinematics");
    problem.creepage = {motion.at("xi"), motion.at("eta"), motion.at("phi").get<double>() * 1e3};
    problem.thermal = Thermal{kSteelHeat, kSteelHeat, 1.0};
    problem.thermal->body_2.bulk_temperature = k == 0 ? 0.0 : 150.0;
    ContactSolution solution = solver.solve(problem);
    ASSERT_EQ(solution.status, Status::ok);
    EXPECT_NEAR(solution.force_x, patch.at("fx_N").get<double>(), 6e-4 * 1e5);
    const double printed = patch.at("max(t1,t2)");
    problem.thermal->conventions = Conventions::contact;
    add_surface_temperatures(problem, solution);
    EXPECT_NEAR(std::max(solution.max_temperature_1, solution.max_temperature_2), printed, 6e-4 * printed);
    const double of_contact = solution.max_temperature_1;
    problem.thermal->conventions = Conventions::treadmark;
    add_surface_temperatures(problem, solution);
    EXPECT_EQ(solution.temperature_1.size(), grid.size());
    if (k == 1) {
      EXPECT_NEAR(solution.max_temperature_1, printed, 1e-9 * printed) << "no sliding";
    } else {
      // The reference counts an element's own heat twice, which vanishes with the root of the element's size only.
      EXPECT_LT(solution.max_temperature_1, of_contact - 1.0);
    }
    if (k == 0) {
      // Sliding at 1 m/s under the Hertzian pressure, row y = 0: 2.1883 is the greatest value of the integral of
      // sqrt(1 - s^2) / sqrt(x - s) over -1 < s < x.
      const double flux = 0.3 * 770.6e6 * 1.0, a = 5.88e-3;
      const double exact = 2.1883 * flux * std::sqrt(a) / (2 * effusivity(kSteelHeat) * std::sqrt(kPi * 30.0));
      EXPECT_NEAR(solution.max_temperature_1, exact, 0.02 * exact);
    }
  }
}

}  // namespace
}  // namespace treadmark::kalker
