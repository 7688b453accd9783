// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/position_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/app/sample_input.hpp"

namespace treadmark::app {
namespace {

double height(const std::vector<Vec2>& points, double y) {
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].x() >= y && points[i - 1].x() <= y) {
      const double t = (y - points[i - 1].x()) / (points[i].x() - points[i - 1].x());
      return (1.0 - t) * points[i - 1].y() + t * points[i].y();
    }
  return std::numeric_limits<double>::quiet_NaN();
}

/// The least vertical distance in the picture itself.
double least_distance(const PositionSection& s) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& point : s.rail) {
    const double wheel = height(s.wheel, point.x());
    if (!std::isnan(wheel) && !std::isnan(point.y())) least = std::min(least, point.y() - wheel);
  }
  return least;
}

TEST(PositionPicture, ShowsTheGapThatIsGiven) {
  const treadmark::testing::SampleInput input;
  const io::CaseFile file = io::read_any_case(input.inp(), {});
  const std::vector<CaseGeometry> cases = check_geometry(file);
  ASSERT_FALSE(cases.empty());
  io::WheelRailCase c = std::get<io::WheelRailCase>(cases[0].given->content);
  // Points of the curves lie 0.2 mm apart on radii above 10 mm.
  constexpr double kPictured = 20e-6;
  for (const Side side : {Side::right, Side::left}) {
    c.side = side;
    c.track.rail_y0 = (side == Side::left ? -1.0 : 1.0) * std::abs(c.track.rail_y0);
    c.vertical_force_prescribed = true;
    c.vertical_force = 1e4;
    const PositionSection touching = position_section(c, cases[0].geometry);
    EXPECT_EQ(touching.least_gap, 0.0);
    EXPECT_NEAR(least_distance(touching), 0.0, kPictured);
    c.vertical_force_prescribed = false;
    c.state.position.z = -30e-3;
    const PositionSection lifted = position_section(c, cases[0].geometry);
    EXPECT_GT(lifted.least_gap, 1e-3);
    EXPECT_NEAR(least_distance(lifted), lifted.least_gap, kPictured);
    const double middle = 0.5 * (lifted.wheel.front().x() + lifted.wheel.back().x());
    EXPECT_EQ(middle > 0.0, side == Side::right) << "a left wheel lies at negative y";
  }
}

}  // namespace
}  // namespace treadmark::app
