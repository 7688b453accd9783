// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/geometry/analysis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/tests/analysis/geometry/made_sections.hpp"

namespace treadmark::geometry {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kRailRound = 0.08, kWheelRound = 0.1, kApart = kWheelRound - kRailRound;
constexpr double kSampled = 1e-9;  // [m] of places and radii of sections sampled at 0.05 mm

/// Contact of a circle in a circle, the wheel's about y_c, at a shift towards the flange: sin of its angle.
double sine_at(double y_c, double shift) { return (y_c + shift) / kApart; }
double radius_at(double y_c, double shift) {
  return kRadius + kWheelRound * (1.0 - std::sqrt(1.0 - sine_at(y_c, shift) * sine_at(y_c, shift)));
}

double height(double y) { return std::sqrt(kWheelRound * kWheelRound - y * y); }
SideBodies round_side(double y_c) {
  const auto wheel = section(
      Body::wheel, y_c - 78e-3, y_c + 78e-3, [=](double y) { return kRadius + kWheelRound - height(y - y_c); },
      [=](double y) { return (y - y_c) / height(y - y_c); });
  return {wheel, kRadius, round_rail(kRailRound, 50e-3), 0.0};
}

/// Circle in circle: contact moves by the radius of each over the distance of the centres.
TEST(Analysis, ContactSpreadOfCirclesIsTheWayOfTheirContact) {
  const SideBodies side = round_side(2e-3);
  AnalysisSettings settings;
  for (const double farthest : {3e-3, 6e-3}) {  // rows that end where the spread does, too
    settings.farthest = farthest;
    const ContactSpread spread = analyse(side, side, {}, settings).spread;
    EXPECT_EQ(spread.amplitude, 3e-3);
    EXPECT_NEAR(spread.rail, kRailRound * 6e-3 / kApart, 1e-6) << farthest;
    EXPECT_NEAR(spread.wheel, kWheelRound * 6e-3 / kApart, 1e-6) << farthest;
  }
  // from the equilibrium, which is 0.2 mm to the right of the middle, rows end too soon
  settings.farthest = 3.1e-3;
  EXPECT_TRUE(std::isnan(analyse(side, round_side(2.4e-3), {}, settings).spread.rail));
  EXPECT_TRUE(std::isnan(analyse(round_side(2.4e-3), side, {}, settings).spread.wheel));
}

/// A wheel like a parabola over two round bumps: what is jumped over counts neither on the rail nor, where the ways of
/// both contacts overlap, twice on the wheel.
TEST(Analysis, ContactSpreadLeavesOutJumpsAndCountsWhatOverlapsOnce) {
  constexpr double kBump = 0.05, kVertex = 1.05e-3;  // contact jumps between two rows
  for (const double half : {10e-3, 2e-3}) {
    const auto rail = section(
        Body::rail, -30e-3, 30e-3,
        [=](double y) { return kBump - std::sqrt(kBump * kBump - std::pow(std::fabs(y) - half, 2)); },
        [=](double y) {
          const double d = y < 0.0 ? y + half : y - half;
          return d / std::sqrt(kBump * kBump - d * d);
        });
    const auto wheel = section(
        Body::wheel, -60e-3, 60e-3, [=](double y) { return kRadius - 0.5 * (y - kVertex) * (y - kVertex); },
        [=](double y) { return kVertex - y; });
    const SideBodies side{wheel, kRadius, rail, 0.0};
    AnalysisSettings settings;
    settings.farthest = 3e-3;
    const ContactSpread spread = analyse(side, side, {}, settings).spread;
    // where slopes are alike on the bump at +-half, by bisection
    const auto place = [&](double shift, double bump) {
      double low = -5e-3, high = 5e-3;
      for (int k = 0; k < 80; ++k) {
        const double d = 0.5 * (low + high);
        (d / std::sqrt(kBump * kBump - d * d) - (kVertex - (bump + d - shift)) < 0.0 ? low : high) = d;
      }
      return bump + 0.5 * (low + high);
    };
    const double left_from = place(-3e-3, -half), left_to = place(-1.1e-3, -half), right_from = place(-1e-3, half),
                 right_to = place(3e-3, half);
    EXPECT_NEAR(spread.rail, left_to - left_from + right_to - right_from, 1e-7) << half;
    // on the wheel, back by the shift: contact runs from + to -
    const double a_high = left_from + 3e-3, a_low = left_to + 1.1e-3, b_high = right_from + 1e-3,
                 b_low = right_to - 3e-3;
    ASSERT_EQ(a_high > b_low, half < 5e-3);
    const double together = a_high > b_low ? b_high - std::min(a_low, b_low) : a_high - a_low + b_high - b_low;
    EXPECT_NEAR(spread.wheel, together, 1e-7) << half;
  }
}

/// Differences of radii have a closed form, and 30 degrees are reached between two rows.
TEST(Analysis, SteeringIsByTheLessOfBothSides) {
  const SideBodies right = round_side(2.05e-3), left = round_side(2.41e-3);
  PairPlacement placement;
  placement.wheel_origins = placement.rail_origins = 1.52;
  const auto expect = [&](const SideBodies& r, const SideBodies& l, double difference) {
    const Steering steering = analyse(r, l, placement, {}).steering;
    EXPECT_NEAR(steering.largest_difference, difference, kSampled);
    EXPECT_NEAR(steering.smallest_radius, 1.52 * kRadius / difference, 1e-4 * steering.smallest_radius);
  };
  // to the right up to 7.9 mm, to the left up to 7.5 mm
  const double to_right = radius_at(2.05e-3, 7.9e-3) - radius_at(2.41e-3, -7.9e-3),
               to_left = radius_at(2.41e-3, 7.5e-3) - radius_at(2.05e-3, -7.5e-3);
  ASSERT_GT(std::fabs(to_right - to_left), 1e-5);
  expect(right, left, std::min(to_right, to_left));
  expect(left, right, std::min(to_right, to_left));
  // equal cylinders steer nowhere
  const SideBodies cylinder{cone(0.0), kRadius, round_rail(0.3), 0.0};
  EXPECT_TRUE(std::isnan(analyse(cylinder, cylinder, placement, {}).steering.smallest_radius));
}

TEST(Analysis, NumbersOfCircles) {
  PairPlacement placement;
  placement.rail_origins = placement.wheel_origins = 1.5;
  AnalysisSettings settings;
  settings.roll = Roll::free;
  settings.amplitudes = {2e-3, 4e-3};
  const SideBodies right = round_side(2e-3), left = round_side(2.4e-3);
  const Analysis a = analyse(right, left, placement, settings);
  ASSERT_TRUE(a.equilibrium.has_value());
  // gauge 14 mm below the top
  const double half_head = std::sqrt(kRailRound * kRailRound - std::pow(kRailRound - 14e-3, 2));
  EXPECT_NEAR(a.gauge, 1.5 - 2.0 * half_head, 1e-7);
  EXPECT_EQ(a.rail_y_right, 0.75);
  EXPECT_EQ(a.rail_y_left, 0.75);
  settings.roll = Roll::none;
  const Analysis without = analyse(right, left, placement, settings);
  EXPECT_NEAR(*without.equilibrium, 0.2e-3, 1e-8);  // half the difference of the wheels' centres
  // Klingel's motion over the closed form instead of over contacts of sections
  RadiusDifference d;
  for (int k = -80; k <= 80; ++k) {
    const double y = 1e-4 * k;
    d.y.push_back(y);
    d.dr.push_back(radius_at(2e-3, y) - radius_at(2.4e-3, -y));
  }
  const KinematicMotion motion(d);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(without.conicity[i].tan_gamma, motion.conicity(settings.amplitudes[i]).tan_gamma, 1e-6) << i;
  EXPECT_NEAR(without.at_3mm.tan_gamma, motion.conicity(3e-3).tan_gamma, 1e-6);
  EXPECT_NEAR(without.nonlinearity, (motion.conicity(4e-3).tan_gamma - motion.conicity(2e-3).tan_gamma) / 2e-3, 1e-3);
  // virtual work: the force that holds the wheelset is the slope of the height of its middle
  const WheelsetOnTrack w = place(right, left, placement, Roll::free);
  const auto slope = [&](double y) {
    const auto height = [&](double at) { return kRadius * std::cos(w.at(at).roll) - w.at(at).z; };
    return (height(y + 1e-5) - height(y - 1e-5)) / 2e-5;
  };
  const double expected = (slope(*a.equilibrium + 3e-3) - slope(*a.equilibrium - 3e-3)) / 6e-3;
  EXPECT_NEAR(a.gravitational_stiffness, expected, 1e-3 * std::fabs(expected));
}

/// A tread of 1:20 and a flange that begins so far behind the tape line, its wheel so much larger.
SideBodies flanged_side(double behind, double larger = 0.0) {
  const auto z = [=](double y) {
    const double t = -y - behind;
    return kRadius + larger - 0.05 * y +
           (t > 0.0 && t < 36e-3 ? 14e-3 * (1.0 - std::cos(2.0 * std::numbers::pi * t / 36e-3)) : 0.0);
  };
  const auto slope = [=](double y) {
    const double t = -y - behind, w = 2.0 * std::numbers::pi / 36e-3;
    return -0.05 - (t > 0.0 && t < 36e-3 ? 14e-3 * w * std::sin(w * t) : 0.0);
  };
  return {section(Body::wheel, -behind - 36e-3, 60e-3, z, slope), kRadius, round_rail(40e-3, 36e-3),
          0.0};  // its sides end where the flange is steepest
}

TEST(Analysis, TheFlangeNearerToTheEquilibriumStopsTheMotion) {
  AnalysisSettings settings;
  settings.amplitudes = {1e-3, 12e-3};
  const auto reason = [&](const SideBodies& right, const SideBodies& left) {
    const Analysis a = analyse(right, left, {}, settings);
    EXPECT_TRUE(std::isnan(a.conicity.back().tan_gamma));
    return a.conicity.back().reason;
  };
  const SideBodies near = flanged_side(28e-3), far = flanged_side(30e-3);
  EXPECT_THAT(reason(near, far), HasSubstr("the right rail"));
  EXPECT_THAT(reason(far, near), HasSubstr("the left rail"));
  // the same flanges: a larger right wheel has its equilibrium further to the left, and the other way round
  const SideBodies large = flanged_side(30e-3, 0.1e-3);
  EXPECT_THAT(reason(large, far), HasSubstr("the left rail"));
  EXPECT_THAT(reason(far, large), HasSubstr("the right rail"));
  // and only what was looked at can stop it: one flange alone, whichever side
  settings.amplitudes = {0.5e-3};
  settings.farthest = 4e-3;
  const SideBodies close = flanged_side(26.5e-3);
  for (const bool right : {true, false}) {
    const Analysis a = right ? analyse(close, far, {}, settings) : analyse(far, close, {}, settings);
    ASSERT_NE(a.functions.to_right.limited, a.functions.to_left.limited);
    ASSERT_LT(a.greatest_amplitude, 4e-3);
    EXPECT_THAT(a.nonlinearity, ::testing::IsNan());
    settings.wanted_amplitude = 4.5e-3;
    const Conicity beyond = (right ? analyse(close, far, {}, settings) : analyse(far, close, {}, settings)).single;
    EXPECT_THAT(beyond.reason, HasSubstr(right ? "the right rail" : "the left rail"));
    settings.wanted_amplitude.reset();
  }
}

/// EN 14363: the amplitude follows from the clearance.
TEST(Analysis, AmplitudeByClearance) {
  const SideBodies side = flanged_side(30e-3);
  const Analysis any = analyse(side, side, {}, {});
  ASSERT_TRUE(std::isfinite(any.active_faces));
  for (const auto& [clearance, amplitude] :
       {std::pair{9.0, 3.0}, {7.001, 3.0}, {6.999, 2.9995}, {6.0, 2.5}, {5.001, 2.0005}, {4.999, 2.0}, {4.0, 2.0}}) {
    PairPlacement placement;
    placement.gauge = any.active_faces + 1e-3 * clearance;
    const Analysis a = analyse(side, side, placement, {});
    EXPECT_NEAR(a.gauge, *placement.gauge, 1e-9);
    EXPECT_NEAR(a.single.amplitude, 1e-3 * amplitude, 1e-9) << clearance << " mm";
  }
}

}  // namespace
}  // namespace treadmark::geometry
