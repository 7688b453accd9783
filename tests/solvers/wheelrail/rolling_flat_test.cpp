// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

#include "standard_pair.hpp"

namespace treadmark::wheelrail {
namespace {

using Places = std::set<std::pair<long, long>>;

/// Elements in contact on the raster of the sequence.
Places places_of(const PatchSolution& patch, double step) {
  Places out;
  for (int iy = 0; iy < patch.grid.ny; ++iy)
    for (int ix = 0; ix < patch.grid.nx; ++ix)
      if (patch.contact.pressure[patch.grid.index(ix, iy)] > 0.0)
        out.insert({std::lround(patch.grid.x(ix) / step), std::lround(patch.grid.y(iy) / step)});
  return out;
}

Places places(const PairSolution& s, double step) {
  Places out;
  for (const PatchSolution& patch : s.patches) out.merge(places_of(patch, step));
  return out;
}

// A flat of 50 mm rolls over the rail in 400 steps of one element of 1 mm under constant load.
TEST(RollingFlat, HistoryIsKeptThroughTheFlatAndSteadyRollingReturnsAfterIt) {
  constexpr double kStep = 1e-3, kSpeed = 2.0, kCentre = 0.15;  // [m], [m/s], [m] from the start to the flat's centre
  constexpr int kSteps = 400;
  const std::vector<WheelFlat> flat = {{.length = 0.05, .depth = 0.05 * 0.05 / (8.0 * kStandardRadius)}};
  Pair pair({analytic::make_standard_surface({"60E1"}, Body::rail, 0.0),
             analytic::make_standard_surface({"S1002"}, Body::wheel, kStandardRadius, flat), true, false});
  Problem p = standard_problem();
  p.state.velocity = {.x = kSpeed, .pitch = -kSpeed / kStandardRadius * 1.0005};
  p.discretisation.dx = p.discretisation.ds = kStep;
  p.regime = kalker::Regime::transient;
  double longest_patch_jump = 0.0, lowest = 1.0, highest = -1.0;
  PairSolution s;
  PatchSolution start;
  Places before;
  int begun = 0;
  for (int i = 0; i < kSteps; ++i) {
    p.history = i == 0 ? kalker::HistoryUse::start : kalker::HistoryUse::keep_going;
    p.state.position.x = i * kStep;
    p.state.position.pitch = (kCentre - p.state.position.x) / kStandardRadius;
    s = pair.solve(p);
    ASSERT_EQ(s.status, Status::ok) << "step " << i << ": " << s.message;
    ASSERT_GE(s.patches.size(), 1u);
    // The wheel tips over the flat, so that patches come and go; but where there was contact a step ago, it is gone on
    // from.
    const Places now = places(s, kStep);
    for (const PatchSolution& patch : s.patches)
      if (patch.came_from.empty() && i > 0) {
        ++begun;
        for (const auto& place : places_of(patch, kStep))
          EXPECT_FALSE(before.contains(place)) << "step " << i << " begins anew";
      }
    before = now;
    EXPECT_NEAR(s.load.track.force.z(), *p.vertical_force, 5e-5 * *p.vertical_force);
    lowest = std::min(lowest, s.z);
    highest = std::max(highest, s.z);
    longest_patch_jump = std::max(longest_patch_jump, std::abs(s.patches[0].frame.X_TC.origin.x()));
    if (i == 100) start = s.patches[0];
  }
  EXPECT_GT(highest - lowest, 0.5 * flat[0].depth) << "the flat went through the contact";
  EXPECT_GT(longest_patch_jump, 5e-3);
  EXPECT_LE(begun, 2);
  // Long after the flat the contact is what it was before, and rolls steadily.
  const PatchSolution& end = s.patches[0];
  EXPECT_NEAR(end.approach, start.approach, 1e-4 * start.approach);
  Problem steady = p;
  steady.regime = kalker::Regime::steady;
  steady.history = kalker::HistoryUse::start;
  const PairSolution other = pair.solve(steady);
  const kalker::ContactSolution same_elements = steady_on_the_same_elements(p, end);
  EXPECT_NEAR(end.contact.force_x, same_elements.force_x, 1e-3 * std::abs(same_elements.force_x));
  EXPECT_NEAR(end.contact.force_y, same_elements.force_y, 1e-3 * std::abs(same_elements.force_y));
  EXPECT_NEAR((s.load.track.force - other.load.track.force).norm(), 0.0, 5e-3 * *p.vertical_force);
}

}  // namespace
}  // namespace treadmark::wheelrail
