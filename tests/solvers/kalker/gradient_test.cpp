// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using testing::hertzian;
using testing::kSteel;
using testing::OwnedProblem;

/// Of solutions that are differenced.
constexpr double kExact = 1e-12;
/// Of derivatives against central differences, of the largest that an element has.
constexpr double kSameDerivative = 1e-5;

constexpr Quantity kOfPressures[] = {Quantity::force_n,  Quantity::approach, Quantity::max_pressure,
                                     Quantity::middle_x, Quantity::middle_y, Quantity::elastic_energy};

double value_of(const ContactSolution& s, Quantity quantity) {
  switch (quantity) {
    case Quantity::force_n:
      return s.force_n;
    case Quantity::approach:
      return s.approach;
    case Quantity::max_pressure:
      return s.max_pressure;
    case Quantity::middle_x:
      return -s.moment_y / s.force_n;
    case Quantity::middle_y:
      return s.moment_x / s.force_n;
    case Quantity::elastic_energy:
      return s.elastic_energy;
    case Quantity::force_x:
      return s.force_x;
    case Quantity::force_y:
      return s.force_y;
    case Quantity::moment_n:
      return s.moment_n;
    case Quantity::frictional_power:
      return s.frictional_power;
  }
  return std::nan("");
}

OwnedProblem at_approach(OwnedProblem owned) {
  owned.problem.approach = ContactSolver().solve(owned.problem).approach;
  owned.problem.force_prescribed = false;
  return owned;
}

/// A ball's contact that is not symmetric, so that one element has the largest pressure.
OwnedProblem ellipse() {
  const HertzShape shape = hertz_from_semi_axes(6e-3, 4e-3, {true, 8e4}, kSteel);
  Grid2 grid = hertz_grid(shape, 27, 21, 1.2);
  grid.x0 += 0.1 * grid.dx, grid.y0 += 0.2 * grid.dy;
  return hertzian(shape, grid);
}

/// A roller that leans a little.
OwnedProblem line() {
  const HertzShape shape = hertz_line_from_semi_axis(1e-3, 5e-3, {true, 2e4}, kSteel);
  Grid2 grid = hertz_grid(shape, 25, 9, 1.3);
  grid.x0 += 0.1 * grid.dx;
  OwnedProblem owned = hertzian(shape, grid);
  for (std::size_t i = 0; i < owned.gap.size(); ++i) owned.gap[i] += 2e-4 * grid.y(static_cast<int>(i) / grid.nx);
  return owned;
}

/// Several regions of irregular shape.
OwnedProblem rough() {
  const Grid2 grid{-6e-3, -4e-3, 0.5e-3, 0.45e-3, 25, 19};
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<double> gap;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix)
      gap.push_back(0.5 * (grid.x(ix) * grid.x(ix) + grid.y(iy) * grid.y(iy)) + 4e-6 * uniform(generator));
  OwnedProblem owned(grid, std::move(gap));
  owned.problem.normal_force = 5000.0;
  return owned;
}

/// By central differences of the solutions at lengths about 0, over the longest steps that leave the states of all
/// elements as they are; what is left of the square of the step cancels between two of them.
template <class Solved>
double difference(const Solved& solved, const ContactSolution& at, Quantity quantity, double longest) {
  const auto over = [&](double step) -> std::optional<double> {
    const ContactSolution more = solved(step), less = solved(-step);
    const auto highest = [](const ContactSolution& s) {
      return std::max_element(s.pressure.begin(), s.pressure.end()) - s.pressure.begin();
    };
    if (more.status != Status::ok || less.status != Status::ok || more.state != at.state || less.state != at.state ||
        highest(more) != highest(at) || highest(less) != highest(at))
      return std::nullopt;
    return (value_of(more, quantity) - value_of(less, quantity)) / (2.0 * step);
  };
  constexpr int kHalvings = 14;
  for (int k = 0; k < kHalvings; ++k, longest *= 0.5)
    if (const auto wide = over(longest))
      if (const auto narrow = over(0.5 * longest)) return (4.0 * *narrow - *wide) / 3.0;
  ADD_FAILURE() << "no step leaves the contact as it is";
  return std::nan("");
}

void expect_differences(OwnedProblem owned, std::span<const Quantity> quantities, const std::string& name) {
  owned.problem.settings.eps = kExact;
  ContactSolver solver;
  const ContactSolution at = solver.solve(owned.problem);
  ASSERT_EQ(at.status, Status::ok) << name << ": " << at.normal.message << at.tangential.message;
  const bool rolls = owned.problem.regime != Regime::frictionless;
  ASSERT_TRUE(!rolls || (at.elements_slip > 30 && at.elements_adhesion > 30)) << name;
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < at.pressure.size(); ++i)
    if (at.pressure[i] > 0.0) inside.push_back(i);
  std::mt19937 generator(11);
  std::shuffle(inside.begin(), inside.end(), generator);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  constexpr double kLongest = 1e-7;  // [m]
  const auto moved = [&](const std::vector<double>& direction) {
    return [&owned, direction](double length) {
      OwnedProblem other(owned);
      for (std::size_t i = 0; i < other.gap.size(); ++i) other.gap[i] += length * direction[i];
      return ContactSolver().solve(other.problem);
    };
  };
  // of a number that is given with the problem
  const auto varied = [&](const auto& member) {
    return [&owned, member](double change) {
      OwnedProblem other(owned);
      member(other.problem) += change;
      return ContactSolver().solve(other.problem);
    };
  };
  for (const Quantity quantity : quantities) {
    const Gradient gradient = solver.gradient(owned.problem, at, quantity);
    ASSERT_EQ(gradient.report.status, Status::ok) << gradient.report.residual;
    const std::string what = name + (owned.problem.force_prescribed ? ", force, " : ", approach, ") +
                             std::to_string(static_cast<int>(quantity));
    double largest = 0.0;
    for (const double d : gradient.by_gap) largest = std::max(largest, std::abs(d));
    // what is prescribed does not change, but for rounding of sums
    if (quantity == (owned.problem.force_prescribed ? Quantity::force_n : Quantity::approach)) {
      EXPECT_LE(largest, 1e-6) << what;
      EXPECT_NEAR(gradient.by_load, 1.0, 1e-12) << what;
      continue;
    }
    for (std::size_t k = 0; k < 10; ++k) {
      std::vector<double> direction(at.pressure.size());
      direction[inside[k]] = 1.0;
      EXPECT_NEAR(gradient.by_gap[inside[k]], difference(moved(direction), at, quantity, kLongest),
                  kSameDerivative * largest)
          << what << ", element " << inside[k];
    }
    std::vector<double> direction(at.pressure.size());
    for (double& d : direction) d = uniform(generator);
    double expected = 0.0, size = 0.0;
    for (std::size_t i = 0; i < direction.size(); ++i) {
      expected += gradient.by_gap[i] * direction[i];
      size += std::abs(gradient.by_gap[i] * direction[i]);
    }
    EXPECT_NEAR(expected, difference(moved(direction), at, quantity, kLongest), kSameDerivative * size) << what;

    const auto expect_number = [&](double derivative, double before, const auto& member) {
      const double by = difference(varied(member), at, quantity, 1e-3 * before);
      const double scale = std::max(std::abs(by), std::abs(value_of(at, quantity) / before));
      EXPECT_NEAR(derivative, by, kSameDerivative * scale) << what;
    };
    expect_number(gradient.by_load, owned.problem.force_prescribed ? owned.problem.normal_force : at.approach,
                  [](ContactProblem& p) -> double& { return p.force_prescribed ? p.normal_force : p.approach; });
    const Creepage& c = owned.problem.creepage;
    if (rolls) expect_number(gradient.by_creepage[0], c.xi, [](ContactProblem& p) -> double& { return p.creepage.xi; });
    if (rolls)
      expect_number(gradient.by_creepage[1], c.eta, [](ContactProblem& p) -> double& { return p.creepage.eta; });
    if (rolls)
      expect_number(gradient.by_creepage[2], c.phi, [](ContactProblem& p) -> double& { return p.creepage.phi; });
    if (rolls)
      expect_number(gradient.by_friction, owned.problem.friction.kinetic,
                    [](ContactProblem& p) -> double& { return p.friction.kinetic; });
  }
}

TEST(Gradient, IsThatOfCentralDifferences) {
  expect_differences(ellipse(), kOfPressures, "ellipse");
  expect_differences(at_approach(ellipse()), kOfPressures, "ellipse");
  expect_differences(line(), kOfPressures, "line");
  expect_differences(at_approach(line()), kOfPressures, "line");
  expect_differences(rough(), kOfPressures, "rough");
  expect_differences(at_approach(rough()), kOfPressures, "rough");
}

OwnedProblem rolling(OwnedProblem owned, Regime regime, double chi) {
  ContactProblem& p = owned.problem;
  p.regime = regime;
  p.rolling.chi = chi;
  p.rolling.step = p.grid.dx;
  const double length = regime == Regime::steady ? 1.0 : 4e-3;
  p.creepage = {-6e-4 * length, 4e-4 * length, 0.2 * length, 1e-4, -2e-4};
  return owned;
}

TEST(Gradient, OfTractionsIsThatOfCentralDifferences) {
  constexpr Quantity kOfTractions[] = {Quantity::force_x, Quantity::force_y, Quantity::moment_n,
                                       Quantity::frictional_power, Quantity::elastic_energy};
  expect_differences(rolling(ellipse(), Regime::steady, 0.0), kOfTractions, "forward");
  expect_differences(rolling(at_approach(ellipse()), Regime::steady, std::numbers::pi), kOfTractions, "backward");
  expect_differences(rolling(ellipse(), Regime::shift, 0.0), kOfTractions, "shift");
  OwnedProblem layered = rolling(ellipse(), Regime::steady, 0.0);
  layered.problem.material.layer_flexibility = 1e-15;
  expect_differences(layered, kOfTractions, "layer");
}

/// Two balls of radius R, Hertz 1882: F = 4/3 e* sqrt(R) d^1.5, p = 2/pi e* sqrt(d/R), U = 2/5 F d.
TEST(Gradient, OfHertzIsThatOfHisFormulas) {
  constexpr double kCurvature = 1.0, kRadius = 0.5 / kCurvature, kForce = 8e4, kGrid = 1e-3;
  const HertzShape shape = hertz_from_curvatures(kCurvature, kCurvature, {true, kForce}, kSteel);
  OwnedProblem owned = hertzian(shape, hertz_grid(shape, 201, 201, 1.1));
  const auto by_radius = [&](const Gradient& gradient) {
    double sum = 0.0;
    for (std::size_t i = 0; i < owned.gap.size(); ++i) sum -= gradient.by_gap[i] * owned.gap[i] / kRadius;
    return sum;
  };
  const auto expect = [&](const Gradient& g, double value, double radius, double load) {
    const double before = owned.problem.force_prescribed ? kForce : owned.problem.approach;
    EXPECT_NEAR(g.by_load * before / value, load, kGrid);
    EXPECT_NEAR(by_radius(g) * kRadius / value, radius, kGrid);
  };
  ContactSolver solver;
  const ContactSolution at = solver.solve(owned.problem);
  const auto of = [&](Quantity quantity) { return solver.gradient(owned.problem, at, quantity); };
  expect(of(Quantity::approach), at.approach, -1.0 / 3.0, 2.0 / 3.0);
  expect(of(Quantity::max_pressure), at.max_pressure, -2.0 / 3.0, 1.0 / 3.0);
  expect(of(Quantity::elastic_energy), at.elastic_energy, -1.0 / 3.0, 5.0 / 3.0);
  owned.problem.force_prescribed = false;
  owned.problem.approach = at.approach;
  expect(of(Quantity::force_n), at.force_n, 0.5, 1.5);
  expect(of(Quantity::max_pressure), at.max_pressure, -0.5, 0.5);
  expect(of(Quantity::elastic_energy), at.elastic_energy, 0.5, 2.5);
}

/// The energy is the least one: at a given approach its derivative by the gap is the force on the element.
TEST(Gradient, OfTheEnergyIsTheForceOnTheElement) {
  const OwnedProblem owned = at_approach(rough());
  ContactSolver solver;
  const ContactSolution at = solver.solve(owned.problem);
  const Gradient gradient = solver.gradient(owned.problem, at, Quantity::elastic_energy);
  for (std::size_t i = 0; i < at.pressure.size(); ++i)
    EXPECT_NEAR(gradient.by_gap[i], -at.pressure[i] * owned.problem.grid.cell_area(),
                1e-5 * at.max_pressure * owned.problem.grid.cell_area());
}

TEST(Gradient, OfAMirroredContactIsTheMirrorImage) {
  const OwnedProblem owned = rough();
  OwnedProblem mirrored(owned);
  std::reverse(mirrored.gap.begin(), mirrored.gap.end());
  ContactSolver solver;
  const ContactSolution at = solver.solve(owned.problem), other = ContactSolver().solve(mirrored.problem);
  std::vector<double> a = solver.gradient(owned.problem, at, Quantity::max_pressure).by_gap,
                      b = ContactSolver().gradient(mirrored.problem, other, Quantity::max_pressure).by_gap;
  std::reverse(b.begin(), b.end());
  const double largest =
      *std::max_element(a.begin(), a.end(), [](double x, double y) { return std::abs(x) < std::abs(y); });
  EXPECT_LE(testing::largest_difference(a, b), 1e-6 * std::abs(largest));
}

TEST(Gradient, DoesNotDependOnThreads) {
  const HertzShape shape = hertz_from_semi_axes(8e-3, 4e-3, {true, 82e3}, kSteel);
  const OwnedProblem owned = hertzian(shape, hertz_grid(shape, 201, 201, 1.1));
  const auto on = [&](int threads) {
    const ThreadLimit limit(threads);
    ContactSolver solver;
    return solver.gradient(owned.problem, solver.solve(owned.problem), Quantity::max_pressure).by_gap;
  };
  const std::vector<double> one = on(1);
  EXPECT_EQ(on(2), one);
  EXPECT_EQ(on(3), one);
}

/// Solutions count iterations of two products, too.
TEST(Gradient, CostsAtMostThreeSolutions) {
  for (const OwnedProblem& owned : {ellipse(), at_approach(ellipse()), line(), rough(), at_approach(rough())}) {
    ContactSolver solver;
    const ContactSolution at = solver.solve(owned.problem);
    for (const Quantity quantity : kOfPressures) {
      const Gradient gradient = solver.gradient(owned.problem, at, quantity);
      EXPECT_LE(gradient.report.iterations, 3 * at.normal.iterations) << static_cast<int>(quantity);
    }
  }
}

TEST(Gradient, RefusesWhatItDoesNotHold) {
  const OwnedProblem owned = at_approach(ellipse());
  ContactSolver solver;
  const ContactSolution at = solver.solve(owned.problem);
  const auto refused = [&](const std::function<void(ContactProblem&)>& change) {
    ContactProblem other = owned.problem;
    change(other);
    EXPECT_THROW(solver.gradient(other, at, Quantity::force_n), Error);
  };
  refused([](ContactProblem& p) { p.normal_model = NormalModel::kpec; });
  refused([](ContactProblem& p) { p.sub_patches.count = 2; });
  refused([](ContactProblem& p) { ++p.grid.nx; });
  refused([](ContactProblem& p) { p.material.creep_ratio_1 = 0.5, p.material.relaxation_time_1 = 0.01; });
  refused([](ContactProblem& p) { p.regime = Regime::steady, p.material.shear_modulus_2 *= 0.1; });

  const OwnedProblem rolls = rolling(owned, Regime::steady, 0.0);
  const ContactSolution tractions = solver.solve(rolls.problem);
  const auto refused_of_tractions = [&](const std::function<void(ContactProblem&)>& change) {
    ContactProblem other = rolls.problem;
    change(other);
    EXPECT_THROW(solver.gradient(other, tractions, Quantity::force_x), Error);
  };
  refused_of_tractions([](ContactProblem& p) { p.tangential_model = TangentialModel::fastsim; });
  refused_of_tractions([](ContactProblem& p) { p.material.layer_yield = 1e8; });
  refused_of_tractions([](ContactProblem& p) { p.fx_relative = 0.3; });
  refused_of_tractions([](ContactProblem& p) { p.friction.kind = FrictionLaw::Kind::temperature; });
}

}  // namespace
}  // namespace treadmark::kalker
