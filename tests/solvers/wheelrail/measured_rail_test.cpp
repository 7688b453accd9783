// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What a rail of measured points tells of itself must not depend on damage far away.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "standard_pair.hpp"
#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/spline/make.hpp"

namespace treadmark::wheelrail {
namespace {

/// A 60E1 head as a device sees it: also its sides under the widest place, and no point at y = 0.
Profile measured_head() {
  Profile p = analytic::sample_profile(StandardProfile{"60E1"}, 0.7e-3);
  for (int k = 0; k < 6; ++k) {
    p.y.insert(p.y.begin(), p.y.front() + 0.2e-3), p.y.push_back(p.y.back() - 0.2e-3);
    p.z.insert(p.z.begin(), p.z.front() + 0.7e-3), p.z.push_back(p.z.back() + 0.7e-3);
  }
  for (double& y : p.y) y += 0.3e-3;
  return p;
}

/// Chords of the data from the datum nearest to the origin, which has arc length zero, to a point of the profile.
double chords_to(const Profile& p, double y, double z) {
  const auto nearest = [&](double at_y, double at_z) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < p.y.size(); ++i)
      if (std::hypot(p.y[i] - at_y, p.z[i] - at_z) < std::hypot(p.y[best] - at_y, p.z[best] - at_z)) best = i;
    return best;
  };
  const std::size_t from = nearest(0.0, 0.0), to = nearest(y, z);
  const double side = p.y[to] < p.y[from] ? -1.0 : 1.0;
  double length = 0.0;
  for (std::size_t i = std::min(from, to); i < std::max(from, to); ++i)
    length += std::hypot(p.y[i + 1] - p.y[i], p.z[i + 1] - p.z[i]);
  return side * length + std::copysign(std::hypot(y - p.y[to], z - p.z[to]), y - p.y[to]);
}

TEST(MeasuredRail, DamageTenMetresAwayChangesNeitherArcLengthNorContact) {
  const Profile profile = measured_head();
  const auto sound = spline::make_profile_surface(profile, 0.0);
  Squat squat;
  squat.length = squat.width = 20e-3, squat.depth = 0.2e-3, squat.x_center = 10.0;
  FlattenedHead head;
  head.x_start = 9.9, head.x_end = 10.1, head.ramp = 20e-3, head.depth = 0.3e-3;

  Problem p = standard_problem();
  p.discretisation.search_method = detection::SearchMethod::pruned_grid;
  const auto solve_on = [&](const std::shared_ptr<const Surface>& rail) {
    PairSolution s = Pair({rail, standard_geometry().wheel, false, true}).solve(p);
    EXPECT_EQ(s.status, Status::ok) << s.message;
    return s;
  };
  const PairSolution before = solve_on(sound);
  ASSERT_EQ(before.patches.size(), 1u);
  const PatchSolution& expected = before.patches[0];
  const Vec3& at = expected.reference_rail;
  EXPECT_NEAR(expected.reference_s, chords_to(profile, at.y(), at.z()), 5e-6);
  EXPECT_GT(std::abs(expected.reference_s - std::hypot(at.y(), at.z())), 0.1e-3) << "zero is where the data have it";

  Defects dip, cut, both;
  dip.squats = both.squats = {squat};
  cut.flattened_heads = both.flattened_heads = {head};
  for (const Defects* damage : {&dip, &cut, &both}) {
    const PairSolution after = solve_on(analytic::add_defects(sound, *damage, Body::rail, 0.0));
    ASSERT_EQ(after.patches.size(), 1u);
    const PatchSolution& found = after.patches[0];
    EXPECT_NEAR(found.reference_s, expected.reference_s, 1e-9);
    EXPECT_NEAR(found.angle_rail, expected.angle_rail, 1e-9);
    EXPECT_NEAR(after.z, before.z, 1e-10);
    EXPECT_EQ(found.grid.size(), expected.grid.size());
    EXPECT_NEAR(found.contact.max_pressure, expected.contact.max_pressure, 1e-6 * expected.contact.max_pressure);
  }
}

}  // namespace
}  // namespace treadmark::wheelrail
