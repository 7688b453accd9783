// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// On the edge of a fresh flat or a flattened head the largest pressure has a limit where the edge is round, and none
// where it is sharp. The table in docs/convergence.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/support/documented_errors.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

struct Contact {
  double pmax = 0.0, force = 0.0, area = 0.0;
};

/// A wheel on an edge. across: the key of the element's side across the edge; defect: its table, without a radius.
struct OnEdge {
  const char *name, *across, *along, *wheelset, *defect;
  double edge_radius_mm;

  Contact contact(int size_um) const {
    const treadmark::testing::TemporaryFolder folder;
    const auto file = folder.write("edge.toml", fmt::format(R"(
rail.shape.standard = "60E1"
wheel.shape.standard = "S1002"
track.cant = "1:40"
wheelset.vertical_force_N = 80e3
{}
discretisation.{} = {}
discretisation.{} = 0.5
discretisation.max_elements = 200000
{}
)",
                                                            wheelset, across, 1e-3 * size_um, along, defect));
    const std::vector<std::string> set{fmt::format(
        "{}.edge_radius_mm={}", std::string(defect).starts_with("[[wheel") ? "wheel.flats.0" : "rail.flattened_heads.0",
        edge_radius_mm)};
    const io::RunResult run = run_cases(io::read_any_case(file, set));
    Contact c;
    for (const io::PatchResult& patch : run.cases.at(0).patches) {
      const double element = patch.fields.grid.cell_area();
      for (const double p : patch.fields.pressure) {
        c.pmax = std::max(c.pmax, p);
        c.force += p * element;
        c.area += p > 0.0 ? element : 0.0;
      }
    }
    EXPECT_NO_FATAL_FAILURE(treadmark::testing::expect_documented(name, size_um, {1e-6 * c.pmax}));
    return c;
  }
};

void expect_limit_of_round_edges(OnEdge edge, const char* round_name, double radius_mm) {
  constexpr int kCoarse = 200, kMiddle = 100, kFine = 50;  // [um]
  const Contact coarse = edge.contact(kCoarse), fine = edge.contact(kFine);
  // where elements lie beside the edge counts as well
  EXPECT_GT(fine.pmax, 1.3 * coarse.pmax) << "grows as elements become smaller";
  edge.name = round_name;
  edge.edge_radius_mm = radius_mm;
  const Contact round_coarse = edge.contact(kCoarse), round_middle = edge.contact(kMiddle),
                round_fine = edge.contact(kFine);
  EXPECT_NEAR(round_middle.pmax, round_fine.pmax, 0.005 * round_fine.pmax);
  EXPECT_NEAR(round_coarse.pmax, round_fine.pmax, 0.005 * round_fine.pmax);
  // what a user compares of either
  EXPECT_NEAR(fine.force, coarse.force, 0.01 * fine.force);
  EXPECT_NEAR(fine.force, round_fine.force, 0.01 * fine.force);
}

TEST(EdgeRadius, OfAFlatMakesTheLargestPressureAPropertyOfTheContact) {
  expect_limit_of_round_edges({"flat,sharp", "dx_mm", "ds_mm", "wheelset.pitch_deg = 3.7393  # asin(30 / 460)",
                               "[[wheel.flats]]\nshape = \"fresh\"\nlength_mm = 60", 0.0},
                              "flat,round", 50.0);
}

TEST(EdgeRadius, OfAFlattenedHeadMakesTheLargestPressureAPropertyOfTheContact) {
  expect_limit_of_round_edges(
      {"head,sharp", "ds_mm", "dx_mm", "",
       "[[rail.flattened_heads]]\nx_start_mm = -250\nx_end_mm = 250\nramp_mm = 100\ndepth_mm = 0.15\nroll_deg = 1",
       0.0},
      "head,round", 25.0);
}

}  // namespace
}  // namespace treadmark::app
