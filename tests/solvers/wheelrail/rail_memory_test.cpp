// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/rail_memory.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::wheelrail {
namespace {

Geometry remembered_bodies() {
  static const Geometry bodies{analytic::make_standard_surface({"60E1"}, Body::rail, 0.0),
                               analytic::make_standard_surface({"S1002"}, Body::wheel, 0.46), true, true};
  return bodies;
}

TEST(RailMemory, SaysWhatTheRailDoes) {
  const Surface& rail = *remembered_bodies().rail;
  RailMemory memory(rail);
  for (int round = 0; round < 2; ++round)
    for (const double roll : {-0.025, -0.05, 0.0, 0.01, -0.024, -0.026})
      for (const double y : {0.7165, 0.0, -0.3}) {
        const Pose X_TS{{12.5 * y, y, 1e-3}, rotation_x(roll)};
        const LateralRange kept = memory.visible(X_TS, 3.0), seen = visible_range(rail, X_TS.inverse(), 3.0);
        constexpr double kLastBits = 1e-11;  // ends are looked for to 1e-13 m
        EXPECT_NEAR(kept.y_min, seen.y_min, kLastBits);
        EXPECT_NEAR(kept.y_max, seen.y_max, kLastBits);
        Track track;
        track.gauge_height = 14e-3 + 1e-3 * round;
        const GaugePoint there = memory.gauge(-roll, track, 0.0), here = gauge_point(rail, -roll, track);
        EXPECT_EQ(there.y, here.y);
        EXPECT_EQ(there.z_top, here.z_top);
      }
}

// Places, cants, gauges and sides in turns: the same bits as from pairs that were asked nothing before.
TEST(RailMemory, AnswersDoNotDependOnWhatWasAskedBefore) {
  std::vector<Problem> asked;
  for (const double cant : {1.0 / 40.0, 1.0 / 20.0, 0.0})
    for (const double z : {0.1e-3, -2e-3, 0.2e-3})
      for (const Side side : {Side::right, Side::left}) {
        Problem p;
        p.side = side;
        p.track.cant = cant;
        p.track.gauge_height = cant > 0.03 ? 16e-3 : 14e-3;
        p.track.roll = z < 0.0 ? 1e-3 : 0.0;
        p.wheelset.nominal_radius = 0.46;
        p.regime = kalker::Regime::frictionless;
        p.discretisation.dx = p.discretisation.ds = 1e-3;
        p.state.position = {0.4, 1.7e-3, z, 0.0, 2e-3, 0.1};
        asked.push_back(p);
      }
  Pair pair(remembered_bodies());
  for (int round = 0; round < 2; ++round)
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const Problem& p = asked[(5 * i + static_cast<std::size_t>(round)) % asked.size()];
      const PairSolution found = pair.solve(p), alone = Pair(remembered_bodies()).solve(p);
      EXPECT_EQ(found.status, alone.status);
      EXPECT_EQ(found.least_gap, alone.least_gap);
      EXPECT_EQ(found.load.track.force, alone.load.track.force);
      EXPECT_EQ(found.placement.X_TR.origin, alone.placement.X_TR.origin);
    }
}

}  // namespace
}  // namespace treadmark::wheelrail
