// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "treadmark/app/compare/compare_cases.hpp"
#include "treadmark/tests/representation/example_cases.hpp"

// Any representation of the wheel rolls on any of the rail: spline, mesh and offset on spline, mesh and offset, for
// damaged and undamaged bodies, give the patches that the formulas give.

namespace treadmark::app {
namespace {

struct Errors {
  double pmax, area, force, position;
  void include(const Errors& e) {
    pmax = std::max(pmax, e.pmax);
    area = std::max(area, e.area);
    force = std::max(force, e.force);
    position = std::max(position, e.position);
  }
};

// Samples 0.5 mm apart; elements of 1 mm. The undamaged S1002 touches where its published zones join: the
// representations round that joint off over a spacing, each in its way.
constexpr Errors kAllowed{
    4e-3,   // greatest pressure, relative
    0.02,   // area: two whole elements of a hundred
    5e-4,   // every force on the rail against the normal force of the patch
    20e-6,  // contact reference [m]
};

double area_of(const io::PatchResult& p) { return p.ncon * p.fields.grid.cell_area(); }

Errors errors_of(const io::PatchResult& found, const io::PatchResult& truth) {
  const double force = std::hypot(found.fn - truth.fn, found.fx - truth.fx, found.fs - truth.fs);
  return {std::fabs(found.pmax / truth.pmax - 1.0), std::fabs(area_of(found) / area_of(truth) - 1.0), force / truth.fn,
          std::hypot(found.x_tr - truth.x_tr, found.y_tr - truth.y_tr, found.z_tr - truth.z_tr)};
}

/// One position of the example with this wheel and this rail, through all nine pairs.
void expect_nine_equal(bool flat, const Defects& of_rail) {
  io::CaseFile file = testing::wheel_flat_example({-4.0});
  io::WheelRailCase& input = testing::wheel_rail(file.cases.front());
  input.discretisation.dx = input.discretisation.ds = 1e-3;
  if (!flat) input.wheel.defects = {};
  input.rail.defects = of_rail;

  CompareSettings settings;
  settings.resolutions = {0.5e-3};
  settings.wheel_backends = settings.rail_backends = {"spline", "mesh", "offset"};
  const io::Comparison c = compare_cases(file, settings);
  ASSERT_EQ(c.truth, "analytic");
  ASSERT_EQ(c.candidates.size(), 10u);
  const io::CaseResult& truth = c.candidates.front().results.front();
  ASSERT_EQ(truth.status, Status::ok) << truth.message;
  ASSERT_GE(truth.patches.size(), 1u);
  Errors worst{};
  for (std::size_t k = 1; k < c.candidates.size(); ++k) {
    const io::ComparisonCandidate& candidate = c.candidates[k];
    SCOPED_TRACE(candidate.name);
    ASSERT_EQ(candidate.failure, "");
    EXPECT_EQ(candidate.wheel.backend + "+" + candidate.rail.backend, candidate.name);
    const io::CaseResult& found = candidate.results.front();
    ASSERT_EQ(found.status, Status::ok) << found.message;
    ASSERT_EQ(found.patches.size(), truth.patches.size());
    for (std::size_t i = 0; i < truth.patches.size(); ++i) {
      const Errors e = errors_of(found.patches[i], truth.patches[i]);
      EXPECT_LE(e.pmax, kAllowed.pmax) << "patch " << i;
      EXPECT_LE(e.area, kAllowed.area) << "patch " << i;
      EXPECT_LE(e.force, kAllowed.force) << "patch " << i;
      EXPECT_LE(e.position, kAllowed.position) << "patch " << i;
      worst.include(e);
    }
  }
  ::testing::Test::RecordProperty("pmax", std::to_string(worst.pmax));
  ::testing::Test::RecordProperty("area", std::to_string(worst.area));
  ::testing::Test::RecordProperty("force", std::to_string(worst.force));
  ::testing::Test::RecordProperty("position_mm", std::to_string(1e3 * worst.position));
  ::testing::Test::RecordProperty(
      "patches", std::to_string(truth.patches.size()) + ", elements " + std::to_string(truth.patches.front().ncon));
}

Defects corrugated() {
  Corrugation c;
  c.waves = {{0.05, 30e-6, 0.0}};
  c.x_start = -0.25;
  c.x_end = 0.25;
  c.ramp = 0.075;
  Defects defects;
  defects.corrugations = {c};
  return defects;
}

TEST(NinePairs, WheelWithAFlatOnAPlainRail) { expect_nine_equal(true, {}); }
TEST(NinePairs, WheelWithAFlatOnACorrugatedRail) { expect_nine_equal(true, corrugated()); }
TEST(NinePairs, RoundWheelOnAPlainRail) { expect_nine_equal(false, {}); }
TEST(NinePairs, RoundWheelOnACorrugatedRail) { expect_nine_equal(false, corrugated()); }

}  // namespace
}  // namespace treadmark::app
