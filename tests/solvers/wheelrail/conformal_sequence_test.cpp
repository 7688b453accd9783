// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Conformal contact in time: elements lie on a raster that stays, as far as the instant before reached.
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/tests/solvers/wheelrail/round_groove.hpp"
#include "two_crowns.hpp"

namespace treadmark::wheelrail {
namespace {

using kalker::HistoryUse;
using kalker::Regime;
using namespace testing;

/// Crowns under a round tread, which rolls on another radius at either edge of each contact.
Geometry round_tread_on_crowns() {
  Geometry pair = two_crowns();
  pair.wheel = analytic::make_revolved_surface(round_chain(0.3, 0.1), kRadius);
  return pair;
}

Problem crowns_in_time() {
  Problem p = crowns_problem();
  p.reference_surface = ReferenceSurface::curved;
  p.material.layer_flexibility = 0.0;
  p.friction.kinetic = 0.3;
  p.regime = Regime::transient;
  p.state.velocity.x = 10.0;
  p.state.velocity.pitch = -10.01 / kRadius;
  return p;
}

TEST(ConformalSequence, CreepagesHaveNoHistory) {
  Pair pair(round_tread_on_crowns()), fresh(round_tread_on_crowns());
  Problem p = crowns_in_time();
  group(p, Grouping::together);
  const PairSolution one = pair.solve(p);
  ASSERT_EQ(one.patches.size(), 1u) << one.message;
  p.vertical_force.reset();
  p.state.position.z = one.z;
  group(p, Grouping::apart);
  const PairSolution right = fresh.solve(p);
  p.history = HistoryUse::keep_going;
  // Less and less of the patch that was one is left over.
  for (int step = 0; step < 3; ++step) {
    p.state.position.x += kStep;
    const PairSolution parted = pair.solve(p);
    ASSERT_EQ(parted.patches.size(), 2u) << parted.message;
    for (std::size_t i = 0; i < 2; ++i) {
      const ContactKinematics &found = parted.patches[i].kinematics, &expected = right.patches[i].kinematics;
      EXPECT_NEAR(found.phi, expected.phi, 1e-3 * std::abs(expected.phi));
      EXPECT_NEAR(found.xi, expected.xi, 1e-3 * std::abs(expected.xi));
      EXPECT_GT(std::abs(expected.phi), 2.0 * std::abs(one.patches[0].kinematics.phi))
          << "the fit over both is another";
    }
  }
}

TEST(ConformalSequence, SpinMomentIsAboutTheContactReference) {
  Problem p = groove_problem(30e-6);
  p.regime = Regime::shift;
  p.state.velocity = {5e-6, 3e-6, 0.0, 0.0, 5e-3, 0.0};
  const Geometry groove = round_groove(10.5e-3);
  p.state.position.y = 0.1e-3;
  const PairSolution here = Pair(groove).solve(p);
  p.state.position.x = 400.0 * p.discretisation.dx;
  const PairSolution there = Pair(groove).solve(p);
  ASSERT_EQ(here.patches.size(), 1u) << here.message;
  ASSERT_EQ(there.patches.size(), 1u) << there.message;
  const PatchSolution &a = here.patches[0], &b = there.patches[0];
  EXPECT_NEAR(b.reference_C.x() - a.reference_C.x(), p.state.position.x, 1e-12) << "the raster stays";
  const double size = a.force_C.norm() * 1e-3;
  EXPECT_LT((b.moment_C - a.moment_C).norm(), 1e-6 * size);

  // From the inclinations of the rows alone, the way along the curve from the reference.
  const Grid2& g = b.grid;
  const auto cos_at = [&](int iy) { return std::cos(b.row_angle[static_cast<std::size_t>(iy)]); };
  double moment = 0.0, y = 0.0;
  int start = 0;
  while (g.y(start) < b.reference_C.y()) ++start;
  const auto add_row = [&](int iy) {
    for (int ix = 0; ix < g.nx; ++ix) {
      const std::size_t i = g.index(ix, iy);
      if (!(b.contact.pressure[i] > 0.0)) continue;
      const double s = std::sin(b.row_angle[static_cast<std::size_t>(iy)]);
      const double fy = (cos_at(iy) * b.contact.traction_y[i] - s * b.contact.pressure[i]) * g.cell_area(),
                   fx = b.contact.traction_x[i] * g.cell_area();
      moment += (g.x(ix) - b.reference_C.x()) * fy - y * fx;
    }
  };
  for (int iy = start; iy < g.ny; ++iy) {
    y += iy == start ? (g.y(start) - b.reference_C.y()) * cos_at(start) : 0.5 * (cos_at(iy - 1) + cos_at(iy)) * g.dy;
    add_row(iy);
  }
  y = (g.y(start) - b.reference_C.y()) * cos_at(start);
  for (int iy = start - 1; iy >= 0; --iy) {
    y -= 0.5 * (cos_at(iy) + cos_at(iy + 1)) * g.dy;
    add_row(iy);
  }
  EXPECT_NEAR(moment, b.moment_C.z(), 1e-3 * size);
  EXPECT_GT(std::abs(b.moment_C.z()), 0.05 * size);
}

}  // namespace
}  // namespace treadmark::wheelrail
