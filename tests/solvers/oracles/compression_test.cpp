// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "spence_die.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/tests/support/documented_errors.hpp"

namespace treadmark::kalker {
namespace {

using testing::spence_compression;
using testing::SpenceCompression;

TEST(Compression, EigenvalueProblemGivesTheNumbersOfSpence) {
  const SpenceCompression coarse = spence_compression(0.5, 0.5, 60), fine = spence_compression(0.5, 0.5, 120);
  EXPECT_NEAR(fine.friction, 0.2986, 1.5e-4);  // Spence 1975, as quoted by Kalker 1990, section 5.2
  EXPECT_NEAR(fine.friction, 0.2987, 5e-5);    // as the document says
  EXPECT_NEAR(fine.force_ratio, 1.0317, 5e-5);
  EXPECT_NEAR(coarse.friction, fine.friction, 2e-5);
  EXPECT_NEAR(coarse.force_ratio, fine.force_ratio, 6e-5);
  // similar bodies: Hertz
  const SpenceCompression same = spence_compression(0.5, 1e-9, 60);
  EXPECT_NEAR(same.force_ratio, 1.0, 1e-4);
  EXPECT_NEAR(same.radius_ratio, 1.0, 1e-4);
}

/// A ball pressed in steps of growing radius, half an element each; `across` elements across the contact in the end.
ContactSolution compress(int across, double friction) {
  const double radius = 121.5, final_a = 3.5, d = 2.0 * final_a / across;
  const int m = across + 6 + across % 2;
  ContactProblem problem;
  problem.grid = {-0.5 * (m - 1) * d, -0.5 * (m - 1) * d, d, d, m, m};
  std::vector<double> gap;
  for (int iy = 0; iy < m; ++iy)
    for (int ix = 0; ix < m; ++ix)
      gap.push_back((std::pow(problem.grid.x(ix), 2) + std::pow(problem.grid.y(iy), 2)) / (2.0 * radius));
  problem.gap = gap;
  problem.material = {0.5, 5e8, 0.0, 0.0};  // G = 1, nu = 0, K = 1/2
  problem.friction.kinetic = friction;
  problem.force_prescribed = false;
  problem.regime = Regime::shift;
  problem.settings.eps = 1e-6;
  ContactSolver solver;
  ContactSolution s;
  for (int k = 2; k <= across; ++k) {  // not before the first centre of an element is reached
    problem.history = k == 2 ? HistoryUse::start : HistoryUse::keep_going;
    problem.approach = std::pow(0.5 * k * d, 2) / radius;
    s = solver.solve(problem);
    EXPECT_EQ(s.status, Status::ok) << k << s.tangential.message;
  }
  return s;
}

TEST(Compression, StepsTendToSpence) {
  const double radius = 121.5, approach = 3.5 * 3.5 / radius;
  const double hertz = 4.0 / 3.0 * std::sqrt(radius) * std::pow(approach, 1.5);
  for (const double k : {0.5, 0.8}) {
    const SpenceCompression exact = spence_compression(k, 0.5, 160);
    double before = std::numeric_limits<double>::infinity();
    for (const int n : {12, 24, 48}) {
      const ContactSolution s = compress(n, exact.friction);
      const double share = std::sqrt(static_cast<double>(s.elements_adhesion) / s.elements_contact);
      const double force_error = s.force_n / hertz / exact.force_ratio - 1.0;
      treadmark::testing::expect_documented(k == 0.5 ? "c/a=0.5" : "c/a=0.8", n, {share - k, force_error});
      EXPECT_LT(std::abs(share - k), 1.5 / n) << "the border to within three quarters of an element";
      EXPECT_GT(before / force_error, 3.0) << "second order";
      before = force_error;
    }
  }
}

}  // namespace
}  // namespace treadmark::kalker
