// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <string>

#include "tangential_cases.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::kalker::testing {
namespace {

/// Half a unit of the four digits that the reference prints, and our own accuracy.
constexpr double kForceTolerance = 6e-5;  ///< relative to the friction limit
constexpr double kPowerTolerance = 6e-4;  ///< relative

struct ReferencePoint {
  double xi = 0.0, force = 0.0, power = 0.0;
  int adhesion = 0;
};

/// Number after the next `"key":` in a text; the position moves behind it. Past the end: NaN.
double next_number(const std::string& text, const std::string& key, std::size_t& position) {
  const std::string pattern = '"' + key + "\":";
  position = text.find(pattern, position);
  if (position == std::string::npos) return std::nan("");
  position += pattern.size();
  return std::stod(text.substr(position, 30));
}

/// The values of the traction curve in the reference results, in the order of the cases.
std::vector<ReferencePoint> reference_points(const std::filesystem::path& shared) {
  const std::string text = treadmark::testing::content_of(shared / "reference" / "tractcurv.json");
  std::vector<ReferencePoint> points;
  for (std::size_t at = 0; at != std::string::npos;) {
    ReferencePoint p;
    p.xi = next_number(text, "xi", at);
    if (at == std::string::npos) break;
    p.power = next_number(text, "frictional_power_W", at);
    p.force = next_number(text, "fx_rel", at);
    p.adhesion = static_cast<int>(next_number(text, "nadh", at));
    points.push_back(p);
  }
  return points;
}

/// Locomotive wheel on a rail: a/b = 0.5, 106.7 kN, 10 m/s (Polach 2005, Vollebregt 2014).
Case locomotive() {
  const HertzShape shape = hertz_from_curvature_and_ratio(0.8, 0.5, {true, 106700.0}, combine(Material{}));
  Case c;
  c.problem.grid = hertz_grid(shape, 48, 44, 1.1);
  const std::vector<double> gap = hertz_gap(shape, c.problem.grid);
  c.problem.gap = gap;
  c.problem.hertz = shape;
  c.problem.force_prescribed = true;
  c.problem.normal_force = 106700.0;
  c.problem.settings.eps = 1e-6;
  NormalSolver().solve(c.problem, c.solution);
  c.problem.gap = {};
  c.problem.settings.eps = 1e-5;
  c.problem.regime = Regime::steady;
  c.problem.rolling.velocity = 10.0;
  return c;
}

TEST(TractionCurve, CoulombFrictionAgreesWithTheReference) {
  TREADMARK_REQUIRE_SHARED();
  const std::vector<ReferencePoint> reference = reference_points(*shared);
  ASSERT_GE(reference.size(), 60u);
  Case c = locomotive();
  c.problem.friction.kinetic = 0.33;
  TangentialSolver solver;
  for (std::size_t k = 0; k < 30; ++k) {
    c.problem.creepage.xi = reference[k].xi;
    ASSERT_EQ(c.solve(solver).tangential.status, Status::ok) << reference[k].xi;
    const Totals t = totals(c);
    EXPECT_EQ(t.contact, 1384);
    EXPECT_NEAR(relative(c, t.x), reference[k].force, kForceTolerance) << reference[k].xi;
    EXPECT_NEAR(relative(c, t.y), 0.0, 1e-9);
    EXPECT_NEAR(t.adhesion, reference[k].adhesion, 2) << reference[k].xi;
    EXPECT_NEAR(t.power, reference[k].power, kPowerTolerance * std::abs(reference[k].power) + 1e-3) << reference[k].xi;
  }
}

TEST(TractionCurve, FallingFrictionWithMemoryAndLayerAgreesWithTheReference) {
  TREADMARK_REQUIRE_SHARED();
  const std::vector<ReferencePoint> reference = reference_points(*shared);
  ASSERT_GE(reference.size(), 60u);
  Case c = locomotive();
  c.problem.material.layer_flexibility = 1.25e-3 / 8200e6;
  c.problem.friction = {FrictionLaw::Kind::exponential, 0.14, 0.19, 0.0, 1.25, 0.0, 3e-6, 1e-3};
  TangentialSolver solver;
  for (std::size_t k = 30; k < 60; ++k) {
    c.problem.creepage.xi = reference[k].xi;
    ASSERT_EQ(c.solve(solver).tangential.status, Status::ok) << reference[k].xi;
    const Totals t = totals(c);
    EXPECT_NEAR(relative(c, t.x), reference[k].force, kForceTolerance) << reference[k].xi;
    EXPECT_NEAR(t.adhesion, reference[k].adhesion, 2) << reference[k].xi;
  }
}

}  // namespace
}  // namespace treadmark::kalker::testing
