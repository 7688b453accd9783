// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// On the edge of a fresh flat the largest pressure has a limit where the edge is round, and none where it is sharp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

struct Contact {
  double pmax = 0.0, force = 0.0, area = 0.0;
};

/// The wheel stands on an end of its flat.
Contact on_the_edge(double edge_radius_mm, double dx_mm) {
  constexpr double kLength = 60.0, kEnd = 3.7393;  // [mm], [deg]: asin(30/460)
  const treadmark::testing::TemporaryFolder folder;
  const auto file = folder.write("edge.toml", fmt::format(R"(
rail.shape.standard = "60E1"
wheel.shape.standard = "S1002"
wheelset.vertical_force_N = 80e3
wheelset.pitch_deg = {}
discretisation.dx_mm = {}
discretisation.ds_mm = 0.5
discretisation.max_elements = 200000
[[wheel.flats]]
shape = "fresh"
length_mm = {}
edge_radius_mm = {}
)",
                                                          kEnd, dx_mm, kLength, edge_radius_mm));
  const io::RunResult run = run_cases(io::read_any_case(file, {}));
  Contact c;
  for (const io::PatchResult& patch : run.cases.at(0).patches) {
    const Grid2& g = patch.fields.grid;
    for (const double p : patch.fields.pressure) {
      c.pmax = std::max(c.pmax, p);
      c.force += p * g.dx * g.dy;
      c.area += p > 0.0 ? g.dx * g.dy : 0.0;
    }
  }
  return c;
}

TEST(EdgeRadius, MakesTheLargestPressureAPropertyOfTheContact) {
  const Contact coarse = on_the_edge(0.0, 0.2), fine = on_the_edge(0.0, 0.05);
  EXPECT_GT(fine.pmax, 1.1 * coarse.pmax) << "grows as elements become smaller";
  const Contact round_coarse = on_the_edge(50.0, 0.2), round_fine = on_the_edge(50.0, 0.05);
  EXPECT_NEAR(round_fine.pmax, round_coarse.pmax, 0.005 * round_fine.pmax);
  // what a user compares of either
  EXPECT_NEAR(fine.force, coarse.force, 0.01 * fine.force);
  EXPECT_NEAR(fine.force, round_fine.force, 0.01 * fine.force);
}

}  // namespace
}  // namespace treadmark::app
