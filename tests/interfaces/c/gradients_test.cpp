// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Derivatives of a pair's numbers: against differences of solutions and against what moves rigidly.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "treadmark/tests/interfaces/c/owned.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;

const std::string kExactText = kText + "[solver]\ntolerance = 1e-9\n";

/// pmax and the lateral force with a number of the case changed by an amount.
std::vector<double> solved_with(const char* name, double amount) {
  const CaseOf c = case_of(kExactText);
  double value = 0.0;
  EXPECT_EQ(tm_case_get_number(c.get(), name, &value), TM_OK) << tm_message();
  EXPECT_EQ(tm_case_set_number(c.get(), name, value + amount), TM_OK) << tm_message();
  const PairOf pair = pair_of(c.get());
  const SolutionOf s = solved(pair.get(), c.get());
  return {number(s.get(), 0, "pmax"), number(s.get(), "force_on_rail.fy_tr")};
}

TEST(CGradients, AreThoseOfSolutionsBesideIt) {
  const CaseOf given = case_of(kExactText);
  const PairOf pair = pair_of(given.get());
  const SolutionOf s = solved(pair.get(), given.get());
  const char* numbers[] = {"pmax", "force_on_rail.fy_tr"};
  const char* by[] = {"wheelset.vertical_force", "wheelset.yaw", "friction.coefficient"};
  const double steps[] = {20.0, 1e-6, 1e-5};
  double found[6] = {};
  ASSERT_EQ(tm_pair_gradient(pair.get(), s.get(), numbers, 2, by, 3, found), TM_OK) << tm_message();
  constexpr double kSame = 1e-3,
                   kNothing = 1e-9;  // elements come and go within the steps; of a number's size, by tolerance
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<double> more = solved_with(by[i], steps[i]), less = solved_with(by[i], -steps[i]);
    for (std::size_t k = 0; k < 2; ++k) {
      const double slope = (more[k] - less[k]) / (2.0 * steps[i]);
      EXPECT_NEAR(found[3 * k + i], slope, kSame * std::abs(slope) + kNothing * std::abs(more[k]) / steps[i])
          << numbers[k] << " by " << by[i];
    }
  }
}

/// The wheel comes down by a gap that is larger everywhere, and nothing else happens.
TEST(CGradients, ByTheGapKeepWhatMovesRigidly) {
  const CaseOf given = case_of(kExactText);
  const PairOf pair = pair_of(given.get());
  const SolutionOf s = solved(pair.get(), given.get());
  ASSERT_EQ(tm_solution_patches(s.get()), 1u);
  std::vector<double> by_gap(field(s.get(), 0, "pressure").size());
  const auto sum_of = [&](const char* name) {
    EXPECT_EQ(tm_pair_gradient_by_gap(pair.get(), s.get(), name, by_gap.data(), by_gap.size()), TM_OK) << tm_message();
    return std::accumulate(by_gap.begin(), by_gap.end(), 0.0);
  };
  EXPECT_NEAR(sum_of("wheelset.z"), 1.0 / std::cos(number(s.get(), 0, "reference.angle")), 1e-6);
  EXPECT_NEAR(sum_of("approach"), 1.0, 1e-6);
  const double pressure = sum_of("pmax");
  const double largest = std::accumulate(by_gap.begin(), by_gap.end(), 0.0,
                                         [](double most, double by) { return std::max(most, std::abs(by)); });
  EXPECT_NEAR(pressure, 0.0, 1e-5 * largest);
}

/// The wheel is formulas: what is told of each is what is told of all.
TEST(CGradients, ByAllThatAShapeFollowsFrom) {
  const CaseOf given = case_of(kExactText);
  const PairOf pair = pair_of(given.get());
  const SolutionOf s = solved(pair.get(), given.get());
  tm_surface* wheel = nullptr;
  ASSERT_EQ(tm_surface_of_case(given.get(), TM_WHEEL, &wheel), TM_OK) << tm_message();
  const std::size_t n = tm_surface_parameters(wheel);
  ASSERT_GT(n, 3u);
  std::vector<double> by(n), places(3 * n);
  int exact = -1;
  ASSERT_EQ(tm_pair_gradient_by_shape(pair.get(), s.get(), "pmax", TM_WHEEL, by.data(), n, &exact), TM_OK)
      << tm_message();
  EXPECT_EQ(exact, 1);
  EXPECT_EQ(tm_surface_parameter_places(wheel, places.data(), n), TM_OK) << tm_message();
  EXPECT_LT(places[1], places[3 * n - 2]) << "from the flange on";
  double largest = 0.0;
  for (const double one : by) largest = std::max(largest, std::abs(one));
  for (std::size_t k = 0; k < n; ++k) {
    const std::string name = "wheel.piece_" + std::to_string(k) + "_bend";
    const char *number = "pmax", *piece = name.c_str();
    double alone = 0.0;
    ASSERT_EQ(tm_pair_gradient(pair.get(), s.get(), &number, 1, &piece, 1, &alone), TM_OK) << tm_message();
    EXPECT_NEAR(by[k], alone, 1e-3 * largest) << name;
  }
  std::vector<double> heights(field(s.get(), 0, "pressure").size());
  EXPECT_EQ(tm_pair_gradient_by_height(pair.get(), s.get(), "pmax", TM_RAIL, heights.data(), heights.size()), TM_OK)
      << tm_message();
  EXPECT_EQ(tm_pair_gradient_by_height(pair.get(), s.get(), "pmax", TM_RAIL, heights.data(), 1), TM_BAD_ARGUMENT);
  EXPECT_EQ(tm_pair_gradient_by_shape(pair.get(), s.get(), "pmax", TM_WHEEL, by.data(), n + 1, nullptr),
            TM_BAD_ARGUMENT);
  EXPECT_EQ(tm_pair_gradient_by_shape(pair.get(), s.get(), "elements.ncon", TM_WHEEL, by.data(), n, nullptr),
            TM_BAD_REQUEST);
  EXPECT_EQ(tm_surface_parameter_places(wheel, places.data(), n - 1), TM_BAD_ARGUMENT);
  tm_surface_free(wheel);
}

TEST(CGradients, SayWhatHasNone) {
  const CaseOf given = case_of(kExactText);
  const PairOf pair = pair_of(given.get()), other = pair_of(given.get());
  const SolutionOf s = solved(pair.get(), given.get());
  const auto gradient = [&](tm_pair* p, const char* number, const char* by) {
    double found = 7.0;
    const tm_status status = tm_pair_gradient(p, s.get(), &number, 1, &by, 1, &found);
    EXPECT_EQ(found, 7.0);
    return status;
  };
  EXPECT_EQ(gradient(other.get(), "pmax", "wheelset.y"), TM_BAD_ARGUMENT) << "another pair's solution";
  EXPECT_EQ(gradient(pair.get(), "elements.ncon", "wheelset.y"), TM_BAD_REQUEST);
  EXPECT_EQ(gradient(pair.get(), "patch_2.pmax", "wheelset.y"), TM_BAD_ARGUMENT);
  EXPECT_EQ(gradient(pair.get(), "pmax", "wheelset.why"), TM_BAD_ARGUMENT);
  EXPECT_EQ(gradient(pair.get(), "pmax", "rail.point_7"), TM_BAD_ARGUMENT) << "arcs tell of no points";
  EXPECT_EQ(gradient(pair.get(), "pmax", "wheelset.nominal_radius"), TM_BAD_REQUEST) << "the surface keeps its own";
  EXPECT_EQ(gradient(pair.get(), "pmax", "track.rail_z"), TM_BAD_REQUEST) << "the gauge places the rail";
  EXPECT_EQ(gradient(pair.get(), "pmax", "discretisation.dx"), TM_NUMERICAL);
  EXPECT_THAT(tm_message(), HasSubstr("discretisation.dx"));
  double one = 7.0;
  EXPECT_EQ(tm_pair_gradient_by_gap(pair.get(), s.get(), "pmax", &one, 1), TM_BAD_ARGUMENT);
  EXPECT_EQ(tm_pair_gradient_by_gap(pair.get(), s.get(), "pmax", nullptr, 0), TM_BAD_ARGUMENT);
  std::vector<double> by_gap(field(s.get(), 0, "pressure").size(), 7.0);
  EXPECT_EQ(tm_pair_gradient_by_gap(pair.get(), s.get(), "reference.y_tr", by_gap.data(), by_gap.size()),
            TM_BAD_REQUEST);
  EXPECT_THAT(tm_message(), HasSubstr("pmax"));
  EXPECT_EQ(by_gap.front(), 7.0);

  const CaseOf coarse = case_of(kText + "[solver]\ntangential_model = \"fastsim\"\n");
  const SolutionOf fast = solved(pair.get(), coarse.get());
  const char *number = "pmax", *by = "wheelset.y";
  EXPECT_EQ(tm_pair_gradient(pair.get(), fast.get(), &number, 1, &by, 1, &one), TM_BAD_REQUEST);
  EXPECT_THAT(tm_message(), HasSubstr("full theory"));
}

}  // namespace
}  // namespace treadmark::testing
