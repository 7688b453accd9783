// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/surface_loads.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "standard_pair.hpp"
#include "two_crowns.hpp"

namespace treadmark::wheelrail {
namespace {

Vec3 reflected(const Vec3& force) { return {force.x(), -force.y(), force.z()}; }
Vec3 reflected_axial(const Vec3& moment) { return {-moment.x(), moment.y(), -moment.z()}; }

Problem asked(Problem p) {
  p.surface_loads = true;
  p.regime = kalker::Regime::steady;
  return p;
}

TEST(SurfaceLoads, LeftIsTheMirrorImageOfRight) {
  const Problem right = asked(standard_problem());
  Problem left = right;
  left.side = Side::left;
  WheelsetState& s = left.state;
  for (double* value :
       {&s.position.y, &s.position.roll, &s.position.yaw, &s.velocity.y, &s.velocity.roll, &s.velocity.yaw})
    *value = -*value;
  const PairSolution r = Pair(standard_geometry()).solve(right), l = Pair(standard_geometry()).solve(left);
  ASSERT_EQ(r.status, Status::ok) << r.message;
  ASSERT_EQ(r.patches.size(), l.patches.size());
  ASSERT_FALSE(r.patches.empty());
  for (std::size_t i = 0; i < r.patches.size(); ++i) {
    const SurfaceLoads &a = *r.patches[i].surface_loads, &b = *l.patches[i].surface_loads;
    for (Wrench SurfaceLoads::*load :
         {&SurfaceLoads::pressure, &SurfaceLoads::pressure_on_wheel, &SurfaceLoads::rail, &SurfaceLoads::wheel}) {
      EXPECT_EQ(reflected((a.*load).force), (b.*load).force);
      EXPECT_EQ(reflected_axial((a.*load).moment), (b.*load).moment);
    }
    EXPECT_EQ(a.slip_power, b.slip_power);
    EXPECT_GT(a.slip_power, 0.0);
  }
}

/// Both bodies take one force, whether patches are solved apart or as parts of one, and no moment about the axle comes
/// of pressures on a round wheel.
TEST(SurfaceLoads, PartsOfAPatchTakeWhatPatchesApartTake) {
  std::vector<Vec3> sums;
  for (const auto grouping : {testing::Grouping::apart, testing::Grouping::parts_of_one}) {
    Problem p = asked(testing::crowns_problem());
    p.material.layer_flexibility = 0.0;
    p.friction.kinetic = 0.3;
    p.state.velocity.x = 10.0;
    p.state.velocity.pitch = -10.0 / testing::kRadius * 0.999;
    p.state.velocity.yaw = 0.1;
    testing::group(p, grouping);
    const PairSolution s = Pair(testing::two_crowns()).solve(p);
    ASSERT_EQ(s.status, Status::ok) << s.message;
    Vec3 sum = Vec3::Zero();
    for (const PatchSolution& patch : s.patches) {
      const SurfaceLoads& at = *patch.surface_loads;
      EXPECT_EQ(at.rail.force, at.wheel.force);
      EXPECT_EQ(at.pressure.force, at.pressure_on_wheel.force);
      EXPECT_NEAR(at.pressure.force.z(), patch.contact.force_n, 1e-9 * patch.contact.force_n);
      constexpr double kLastStep = 0.03;  // in which material leaves the contact: sums over elements lack it
      EXPECT_NEAR(at.slip_power, -patch.contact.frictional_power, kLastStep * at.slip_power);
      const Vec3 axle_C = patch.frame.X_TC.apply_inverse(s.placement.X_TWs.origin);
      const Vec3 about_axle =
          patch.frame.X_TC.rotation * (at.pressure_on_wheel.moment - axle_C.cross(at.pressure.force));
      EXPECT_NEAR(about_axle.y(), 0.0, 1e-5 * testing::kRadius * at.pressure.force.z());
      sum += patch.load.track.force;
    }
    sums.push_back(sum);
  }
  EXPECT_NEAR((sums[0] - sums[1]).norm(), 0.0, 2e-3 * sums[0].norm());
}

}  // namespace
}  // namespace treadmark::wheelrail
