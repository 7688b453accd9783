// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/line/rail_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "treadmark/core/parallel.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/scans/line/line_fit.hpp"
#include "treadmark/tests/scans/line/known_lines.hpp"
#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

using tests::circle;
using tests::Clothoid;
using tests::Frames;

/// A line through exact frames.
RailLine line_of(const Frames& frames, double from, double to, std::size_t intervals, const Pose& X_CL = {}) {
  std::vector<LineTarget> targets;
  constexpr int kTargets = 2000;
  double roll = 0.0;
  for (int k = 0; k <= kTargets; ++k) {
    const double s = from + (to - from) * k / kTargets;
    const Pose frame = X_CL * frames(s);
    LineTarget target{s, frame.origin, roll, frame.rotation, Mat3(Vec3(1e12, 1e12, 1e9).asDiagonal())};
    targets.push_back(target);
  }
  return fit_line(targets, {LineShape::Kind::splines, intervals}, from, to, 1.0, -(X_CL * frames(from)).rotation.col(2))
      .line;
}

TEST(RailLine, CircleInClosedForm) {
  constexpr double kRadius = 300.0, kLength = 60.0;
  const RailLine line = line_of(circle(1.0 / kRadius), 0.0, kLength, 16);
  // splines of h = 3.75 m miss a circle by some h^4 / (384 R^3) [m]; along itself little holds the line
  constexpr double kPlace = 0.1e-6, kAlong = 3e-6, kBend = 1e-7;
  for (double s = 0.0; s <= kLength; s += 0.37) {
    const Pose truth = circle(1.0 / kRadius)(s), found = line.at(s);
    const Vec3 off = truth.apply_inverse(found.origin);
    EXPECT_LT(std::hypot(off.y(), off.z()), kPlace) << s;
    EXPECT_LT(std::fabs(off.x()), kAlong) << s;
    EXPECT_LT((truth.rotation - found.rotation).norm(), 1e-5) << s;
    EXPECT_NEAR(line.turn(s).lateral, 1.0 / kRadius, 100 * kBend) << s;
    EXPECT_NEAR(line.turn(s).vertical, 0.0, kBend) << s;
    EXPECT_NEAR(line.turn(s).twist, 0.0, kBend) << s;
    EXPECT_NEAR(line.arc(s), s, kAlong) << s;
  }
}

TEST(RailLine, PlacesOfPoints) {
  const Pose X_CL = tests::some_frame(3);
  constexpr double kLength = 40.0;
  const RailLine line = line_of(circle(-1.0 / 300.0), 0.0, kLength, 16, X_CL);
  Random random(1);
  std::vector<Vec3> places, points;
  for (int k = 0; k < 10000; ++k) {
    const double x = -1.0 + (kLength + 2.0) * random.uniform(), y = 0.2 * random.uniform() - 0.1,
                 z = 0.2 * random.uniform() - 0.1;
    places.emplace_back(x, y, z);
    points.push_back(line.at(x).apply({0.0, y, z}));
  }
  std::vector<Vec3> straight = points;
  line.straighten(straight);
  constexpr double kExact = 1e-9;
  for (std::size_t k = 0; k < places.size(); ++k) EXPECT_LT((straight[k] - places[k]).norm(), kExact) << k;
  std::vector<Vec3> again = points;
  {
    const ThreadLimit one(1);
    line.straighten(again);
  }
  EXPECT_TRUE(straight == again);
}

TEST(RailLine, GoesOnAsItBendsAtItsEnds) {
  constexpr double kRadius = 500.0;
  const RailLine line = line_of(circle(1.0 / kRadius), 0.0, 20.0, 8);
  // a parabola for a circle: x^3 / (2 R^2)
  EXPECT_LT((line.position(22.0) - circle(1.0 / kRadius)(22.0).origin).norm(), 30e-6);
  EXPECT_LT((line.position(-2.0) - circle(1.0 / kRadius)(-2.0).origin).norm(), 30e-6);
}

TEST(RailLine, FarPointsHaveAPlaceToo) {
  const RailLine line = line_of(circle(1.0 / 50.0), 0.0, 20.0, 8);
  EXPECT_FALSE(line.locate(Vec3(0.0, 60.0, 0.0), 0.0).has_value()) << "behind the centre";
  std::vector<Vec3> far{Vec3(0.0, 60.0, 0.0)};
  line.straighten(far);
  EXPECT_TRUE(far.front().allFinite());
  EXPECT_GT(std::hypot(far.front().y(), far.front().z()), 1.0);
}

TEST(RailLine, RefusesWhatIsNoLine) {
  const std::vector<Vec3> three(3, Vec3::Zero());
  EXPECT_THROW(RailLine(0.0, 1.0, three, std::vector<double>(3, 0.0), Vec3::UnitZ()), Error);
  std::vector<Vec3> straight;
  for (int i = 0; i < 4; ++i) straight.emplace_back(i, 0.0, 0.0);
  EXPECT_THROW(RailLine(0.0, 1.0, straight, std::vector<double>(4, 0.0), Vec3::UnitX()), Error);
}

}  // namespace
}  // namespace treadmark::scans
