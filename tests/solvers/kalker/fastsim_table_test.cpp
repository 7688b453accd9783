// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

/// One line of the table in solvers/kalker/fastsim/README.md. Creepages are scaled: 1 is what the linear theory needs
/// for the friction bound. Results: size of the tangential force over the friction bound.
struct FastsimLine {
  double ratio = 0.0, xi = 0.0, eta = 0.0, phi = 0.0;
  std::array<double, 5> forces{};  ///< full, fastsim, fastsim with parabolic bound, one flexibility, fastrip
};

FastsimLine compute(FastsimLine line) {
  const double c = 5e-3, a = c * std::sqrt(line.ratio), b = c / std::sqrt(line.ratio);
  const CombinedMaterial material = combine(Material{});
  const HertzShape shape = hertz_from_semi_axes(a, b, {true, 80e3}, material);
  const KalkerCoefficients k = kalker_coefficients(a, b, material.poisson);
  testing::OwnedProblem owned = testing::hertzian(shape, hertz_grid(shape, 42, 42, 1.05));
  ContactProblem& problem = owned.problem;
  problem.hertz = shape;
  problem.regime = Regime::steady;
  const double g = material.shear_modulus, unit = 0.3 * 80e3 / (g * c * c);
  problem.creepage = {line.xi * unit / k.c11, line.eta * unit / k.c22, line.phi * unit / (c * k.c23)};
  problem.fastsim.flexibility = 8.0 * a / (3.0 * k.c11 * g);

  ContactSolver solver;
  const auto force = [&](NormalModel normal, TangentialModel tangential) {
    problem.normal_model = normal;
    problem.tangential_model = tangential;
    const ContactSolution solution = solver.solve(problem);
    EXPECT_EQ(solution.status, Status::ok);
    return std::hypot(solution.force_x, solution.force_y) / (0.3 * solution.force_n);
  };
  line.forces = {force(NormalModel::full, TangentialModel::full), force(NormalModel::full, TangentialModel::fastsim),
                 force(NormalModel::parabolic, TangentialModel::fastsim),
                 force(NormalModel::full, TangentialModel::fastsim_one_flexibility),
                 force(NormalModel::full, TangentialModel::fastrip)};
  return line;
}

std::vector<FastsimLine> documented_fastsim() {
  std::ifstream file(std::string(TREADMARK_SOURCE_DIR) + "/solvers/kalker/fastsim/README.md");
  std::vector<FastsimLine> lines;
  for (std::string text; std::getline(file, text);) {
    FastsimLine line;
    char bar = 0;
    std::istringstream words(text);
    if (!(words >> bar >> line.ratio >> bar >> line.xi >> bar >> line.eta >> bar >> line.phi)) continue;
    bool complete = true;
    for (double& force : line.forces) complete = complete && (words >> bar >> force);
    if (complete) lines.push_back(line);
  }
  return lines;
}

std::string markdown(const FastsimLine& line) {
  char text[160];
  std::snprintf(text, sizeof text, "| %.1f | %.1f | %.1f | %.1f | %.3f | %.3f | %.3f | %.3f | %.3f |", line.ratio,
                line.xi, line.eta, line.phi, line.forces[0], line.forces[1], line.forces[2], line.forces[3],
                line.forces[4]);
  return text;
}

TEST(FastsimTable, ReadmeShowsWhatIsComputed) {
  const std::vector<FastsimLine> lines = documented_fastsim();
  ASSERT_EQ(lines.size(), 24u) << "3 contacts with 8 creepages";
  for (const FastsimLine& printed : lines) {
    const FastsimLine computed = compute(printed);
    for (std::size_t i = 0; i < computed.forces.size(); ++i)
      EXPECT_NEAR(computed.forces[i], printed.forces[i], 6e-4) << "the table should read\n" << markdown(computed);
  }
}

TEST(FastsimTable, SimplifiedTheoriesStayCloseToFullTheory) {
  // Of the friction bound. Parabolic under spin: on finer grids, with half and whole first steps and in a sum by hand,
  // forces go to 0.827, 0.667 and 0.473 (a/b = 2, 1, 1/2), those of the exact theory to 0.759, 0.605 and 0.436.
  for (const FastsimLine& line : documented_fastsim()) {
    SCOPED_TRACE(markdown(line));
    EXPECT_NEAR(line.forces[1], line.forces[0], 0.06);
    EXPECT_NEAR(line.forces[2], line.forces[0], line.phi == 0.0 ? 0.045 : 0.08);
    EXPECT_NEAR(line.forces[3], line.forces[0], 0.09);
    EXPECT_NEAR(line.forces[4], line.forces[0], line.phi == 0.0 ? 0.015 : 0.05);
  }
}

}  // namespace
}  // namespace treadmark::kalker
