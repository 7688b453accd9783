// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "treadmark/analysis/geometry/analysis.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/tests/analysis/geometry/made_sections.hpp"
#include "treadmark/tests/support/error_text.hpp"

namespace treadmark::geometry {
namespace {

using ::testing::HasSubstr;

TEST(Wheelset, ConesOnRoundRailsDifferInProportion) {
  const double tan_gamma = 0.05;
  const WheelsetOnTrack w = wheelset(cone(tan_gamma), round_rail(0.3));
  for (const double y : {-7e-3, 0.0, 1.234e-3, 6e-3}) {
    const Position p = w.at(y);
    EXPECT_TRUE(p.sound());
    EXPECT_NEAR(p.radius_difference(), 2.0 * tan_gamma * y, 1e-13) << y;
    EXPECT_NEAR(p.right.angle, std::atan(tan_gamma), 1e-9);
    EXPECT_NEAR(p.right.rail_y, -0.3 * std::sin(std::atan(tan_gamma)), 1e-9);
    EXPECT_NEAR(p.right.rail_curvature, 1.0 / 0.3, 1e-4);
    EXPECT_NEAR(p.right.wheel_curvature, 0.0, 1e-9);
  }
}

/// Circle in circle: the line through both centres is the normal. Centres are apart by y across and R_w - R_r along.
TEST(Wheelset, CirclesInCirclesAgreeWithTheClosedForm) {
  constexpr double kRail = 0.08, kWheel = 0.1, kCentre = 2e-3;
  const WheelsetOnTrack w = wheelset(hollow(kWheel, kCentre), round_rail(kRail));
  for (const double y : {-4e-3, 0.5e-3, 3e-3}) {
    const Position p = w.at(y);
    const auto angle = [&](double shift) { return std::asin((kCentre + shift) / (kWheel - kRail)); };
    const auto radius = [&](double shift) { return kRadius + kWheel * (1.0 - std::cos(angle(shift))); };
    EXPECT_NEAR(p.right.angle, angle(y), 1e-6) << y;
    EXPECT_NEAR(p.left.angle, angle(-y), 1e-6) << y;
    EXPECT_NEAR(p.radius_difference(), radius(y) - radius(-y), 1e-9) << y;
    EXPECT_NEAR(p.right.wheel_curvature, -1.0 / kWheel, 0.01);
  }
}

/// Gaps of all pairs of samples, in a frame of their own.
TEST(Wheelset, AgreesWithBruteForceWithAndWithoutRoll) {
  const auto wheel = flanged_wheel();
  const auto rail = round_rail(40e-3, 36e-3);
  for (const Roll roll : {Roll::none, Roll::free}) {
    const WheelsetOnTrack w = wheelset(wheel, rail, roll);
    for (const double y : {0.0, 2.5e-3, 5.2e-3}) {
      const Position p = w.at(y);
      ASSERT_TRUE(p.sound());
      if (roll == Roll::free) {
        EXPECT_NEAR(p.right.gap, p.left.gap, 1e-12);
      }
      for (const double side : {1.0, -1.0}) {
        double least = 1.0;
        for (int k = -66000; k <= 60000; ++k) {
          const double s = 1e-6 * k, across = side * (0.75 + s), up = flanged(s) - kRadius;
          const double y_track = y + across * std::cos(p.roll) - up * std::sin(p.roll),
                       z_track = across * std::sin(p.roll) + up * std::cos(p.roll), on_rail = y_track - side * 0.75;
          if (std::fabs(on_rail) > 36e-3) continue;
          least = std::min(least, 40e-3 - std::sqrt(1.6e-3 - on_rail * on_rail) - z_track);
        }
        EXPECT_NEAR((side > 0.0 ? p.right : p.left).gap, least, 1e-9) << y << ' ' << side;
      }
    }
  }
}

/// The yawed wheel as circles in space, each turned and looked at along the track.
TEST(Wheelset, YawAgreesWithBruteForce) {
  const double yaw = 20e-3, y = 5e-3;
  const WheelsetOnTrack w = wheelset(flanged_wheel(), round_rail(40e-3, 36e-3), Roll::none, yaw);
  const Position p = w.at(y);
  double least = 1.0, at = 0.0;
  for (int k = -5000; k <= 0; ++k) {
    const double s = 1e-5 * k, r = flanged(s);
    for (int j = -400; j <= 400; ++j) {
      const double theta = 2.5e-4 * j, x = r * std::sin(theta), across = 0.75 + s;
      const double on_rail = x * std::sin(yaw) + across * std::cos(yaw) + y - 0.75;
      if (std::fabs(on_rail) > 36e-3) continue;
      const double gap = 40e-3 - std::sqrt(1.6e-3 - on_rail * on_rail) - (r * std::cos(theta) - kRadius);
      if (gap < least) least = gap, at = s;
    }
  }
  EXPECT_NEAR(p.right.gap, least, 2e-8);
  EXPECT_NEAR(p.right.wheel_y, at, 5e-4);
  EXPECT_GT(std::fabs(p.right.gap - wheelset(flanged_wheel(), round_rail(40e-3, 36e-3)).at(y).right.gap), 1e-6);
}

/// Statics and virtual work: the force that holds the wheelset is the slope of its height.
TEST(Wheelset, HoldingForceIsTheSlopeOfTheHeight) {
  const WheelsetOnTrack w = wheelset(flanged_wheel(), round_rail(40e-3, 36e-3), Roll::free);
  const double step = 1e-5;
  for (const double y : {1e-3, 4e-3, 5.2e-3}) {
    ASSERT_TRUE(w.at(y).sound());
    const auto height = [&](double at) {  // of the middle of the axle, upwards
      const Position p = w.at(at);
      return -p.z + kRadius * std::cos(p.roll);
    };
    const double slope = (height(y + step) - height(y - step)) / (2.0 * step);
    EXPECT_NEAR(w.holding_force(w.at(y)), slope, 1e-4 * std::fabs(slope) + 1e-7) << y;
  }
}

TEST(Wheelset, SidesExchangedAreTheMirrorImage) {
  const SideInput right{flanged_wheel(), round_rail(60e-3), 0.75, 0.752, 0.0},
      left{cone(0.1), round_rail(90e-3), 0.75, 0.751, 0.0};
  for (const Roll roll : {Roll::none, Roll::free}) {
    const WheelsetOnTrack a(right, left, kRadius, roll), b(left, right, kRadius, roll);
    const Position p = a.at(2.3e-3), q = b.at(-2.3e-3);
    EXPECT_NEAR(p.radius_difference(), -q.radius_difference(), 1e-12);
    EXPECT_NEAR(p.roll, -q.roll, 1e-13);
    EXPECT_NEAR(p.z, q.z, 1e-13);
  }
}

/// Wiggles finer than the samples hide no minimum.
TEST(Wheelset, TouchesThroughNoise) {
  const auto rail = round_rail(150e-3, 36e-3);
  const auto wheel = section(
      Body::wheel, -40e-3, 40e-3,
      [](double y) { return kRadius - 0.05 * y + y * y + 1e-8 * std::sin(y / 21e-6) + 1e-7 * std::sin(y / 97e-6); },
      [](double y) {
        return -0.05 + 2.0 * y + 1e-8 / 21e-6 * std::cos(y / 21e-6) + 1e-7 / 97e-6 * std::cos(y / 97e-6);
      });
  const WheelsetOnTrack w = wheelset(wheel, rail);
  for (int k = -60; k <= 60; ++k) {
    const Position p = w.at(1e-4 * k);
    ASSERT_TRUE(p.sound()) << k;
    double least = 1.0;
    for (int j = -350; j <= 350; ++j) {
      const double s = 1e-4 * j, on_rail = s + p.y;
      least = std::min(least, 150e-3 - std::sqrt(0.0225 - on_rail * on_rail) - (wheel->at(s).z - kRadius));
    }
    constexpr double kFineWiggles = 3e-8;  // those of 1e-8 lie between the samples
    EXPECT_LE(p.right.gap, least + kFineWiggles) << k;
  }
}

/// Two round bumps on a cylinder: contact jumps where the lower one changes.
TEST(ContactFunctions, JumpsAreFoundWhereTheClosedFormHasThem) {
  // rail: two circles of 50 mm, tops at -10 and +10 mm
  const auto z = [](double y) {
    const auto bump = [](double d) { return 0.05 - std::sqrt(2.5e-3 - d * d); };
    return std::min(bump(y + 10e-3), bump(y - 10e-3));
  };
  const auto slope = [](double y) {
    const double d = y < 0.0 ? y + 10e-3 : y - 10e-3;
    return d / std::sqrt(2.5e-3 - d * d);
  };
  const auto rail = section(Body::rail, -30e-3, 30e-3, z, slope);
  constexpr double kQuadratic = 0.5;  // of the wheel about 1 mm: both tops are equally far where that lies between them
  const auto wheel = section(
      Body::wheel, -60e-3, 60e-3, [](double y) { return kRadius - kQuadratic * (y - 1e-3) * (y - 1e-3); },
      [](double y) { return -2.0 * kQuadratic * (y - 1e-3); });
  const SideInput side{wheel, rail, 0.75, 0.75, 0.0};
  const WheelsetOnTrack w(side, side, kRadius, Roll::none);
  const ContactFunctions f = contact_functions(w, {0.1e-3, 3.05e-3, 0.0});
  ASSERT_EQ(f.jumps.size(), 2u);
  EXPECT_FALSE(f.jumps[0].right == f.jumps[1].right);
  const Jump& jump = f.jumps[0].right ? f.jumps[0] : f.jumps[1];
  EXPECT_NEAR(jump.before.y, -1e-3, 2.0 * kJumpWidth);  // the vertex over the middle
  EXPECT_NEAR(std::fabs(jump.after.right.rail_y - jump.before.right.rail_y), 20e-3, 2e-3);
  // with the second contact's gap falling to nothing there
  const std::vector<Touch> others = w.further_touches(w.at(-0.9e-3), true, 0.05e-3);
  ASSERT_EQ(others.size(), 1u);
  EXPECT_GT(others[0].gap, 0.0);
  EXPECT_LT(others[0].gap, 5e-6);
}

TEST(ContactFunctions, RefusesByName) {
  const auto analysis = [](std::shared_ptr<const Section> wheel, std::shared_ptr<const Section> rail, double rail_y,
                           double amplitude) {
    const SideBodies side{std::move(wheel), kRadius, std::move(rail), 0.0};
    PairPlacement placement;
    placement.rail_origins = 2.0 * rail_y;
    AnalysisSettings settings;
    settings.amplitudes = {amplitude};
    return testing::error_of([&] { analyse(side, side, placement, settings); });
  };
  const auto rail = round_rail(50e-3, 36e-3);
  EXPECT_EQ(analysis(flanged_wheel(), rail, 0.75, 2e-3), "");
  EXPECT_THAT(analysis(flanged_wheel(), rail, 0.82, 2e-3), HasSubstr("falls through the gauge"));
  EXPECT_THAT(analysis(flanged_wheel(), rail, 0.85, 2e-3), HasSubstr("nowhere over its rail"));
  EXPECT_THAT(analysis(flanged_wheel(), round_rail(40e-3, 36e-3), 0.735, 2e-3), HasSubstr("jam between the rails"));
  EXPECT_THAT(analysis(flanged_wheel(), rail, 0.75, 40e-3), HasSubstr("lies beyond the flanges: the greatest one is"));
  const auto cut_wheel = section(Body::wheel, -66e-3, -10e-3, flanged, flanged_slope);
  EXPECT_THAT(analysis(cut_wheel, rail, 0.75, 2e-3),
              HasSubstr("wheel's profile is too short: it ends at y = -10.0 mm"));
  const auto cut_rail = section(
      Body::rail, 5e-3, 36e-3, [](double y) { return 50e-3 - std::sqrt(2.5e-3 - y * y); },
      [](double y) { return y / std::sqrt(2.5e-3 - y * y); });
  EXPECT_THAT(analysis(flanged_wheel(), cut_rail, 0.75, 2e-3), HasSubstr("rail's profile is too short"));
}

TEST(Section, GaugePointAndMarks) {
  const auto rail = round_rail(50e-3, 40e-3);
  const RailTop top = rail_top(*rail, 14e-3);
  EXPECT_NEAR(top.z_top, 0.0, 1e-12);
  EXPECT_NEAR(top.y_gauge, -std::sqrt(2.5e-3 - 36e-3 * 36e-3), 1e-8);
  EXPECT_TRUE(std::isnan(rail_top(*round_rail(50e-3, 20e-3), 14e-3).y_gauge));
  const WheelMarks marks = wheel_marks(*flanged_wheel());
  EXPECT_NEAR(flanged(marks.face_y), kRadius + 10e-3, 1e-9);
  EXPECT_NEAR(marks.tip_y, -48e-3, 0.3e-3);
  EXPECT_TRUE(std::isnan(wheel_marks(*cone(0.05)).tip_y));
}

TEST(Section, CurvesBetweenItsSamples) {
  const auto rail = round_rail(13e-3, 12e-3);
  for (const double y : {-9.4123e-3, 0.0101e-3, 6.7e-3}) {
    const SectionPoint p = rail->at(y);
    EXPECT_NEAR(p.z, 13e-3 - std::sqrt(1.69e-4 - y * y), 2e-10) << y;
    EXPECT_NEAR(p.curvature, 1.0 / 13e-3, 0.5) << y;
  }
  EXPECT_TRUE(std::isnan(rail->at(12.1e-3).z));
}

TEST(Section, KnowsTheOtherBody) {
  EXPECT_EQ(wrong_body(*flanged_wheel()), "");
  EXPECT_EQ(wrong_body(*round_rail(50e-3, 36e-3)), "");
  std::vector<double> z = flanged_wheel()->z(), slope = flanged_wheel()->slope();
  EXPECT_THAT(wrong_body(Section(Body::rail, -66e-3, kSectionStep, z, slope)), HasSubstr("as wheels are"));
  ranges::reverse(z);
  for (double& value : slope) value = -value;
  ranges::reverse(slope);
  EXPECT_THAT(wrong_body(Section(Body::wheel, -60e-3, kSectionStep, z, slope)), HasSubstr("its flange lies at y > 0"));
  z = round_rail(50e-3, 36e-3)->z();
  for (double& value : z) value = kRadius - value;
  slope = round_rail(50e-3, 36e-3)->slope();
  EXPECT_THAT(wrong_body(Section(Body::wheel, -36e-3, kSectionStep, z, slope)), HasSubstr("as heads of rails do"));
}

}  // namespace
}  // namespace treadmark::geometry
