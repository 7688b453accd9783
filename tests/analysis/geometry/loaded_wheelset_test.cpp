// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "treadmark/analysis/geometry/loaded_wheelset.hpp"
#include "treadmark/tests/analysis/geometry/made_sections.hpp"
#include "treadmark/tests/support/error_text.hpp"

namespace treadmark::geometry {
namespace {

using std::numbers::pi;
using ::testing::HasSubstr;

const AxleLoad kAxle{200e3, {}};
/// Young's modulus and the modulus of two equal bodies, by the textbook (Johnson 1985, eq. 4.8).
constexpr double kPoisson = 0.28, kYoung = 2.0 * 82e9 * (1.0 + kPoisson),
                 kPair = 0.5 * kYoung / (1.0 - kPoisson * kPoisson);
constexpr double kCurvatureOfSamples = 1e-5;  // slopes at steps of 0.05 mm, over three of them, relative

/// A tread bent like a circle of this radius, convex.
std::shared_ptr<const Section> crowned(double radius) {
  return section(
      Body::wheel, -40e-3, 40e-3, [=](double y) { return kRadius - radius + std::sqrt(radius * radius - y * y); },
      [=](double y) { return -y / std::sqrt(radius * radius - y * y); });
}

std::shared_ptr<const Section> flat_rail() {
  return section(
      Body::rail, -30e-3, 30e-3, [](double) { return 0.0; }, [](double) { return 0.0; });
}

TEST(LoadedWheelset, EqualConesCarryTheSame) {
  for (const double tan_gamma : {0.05, 0.4}) {
    const WheelsetOnTrack w = wheelset(cone(tan_gamma), round_rail(0.1, 0.05));
    const LoadedPosition at = loaded(w, w.at(0.0), kAxle);
    const double expected = 0.5 * kAxle.weight / std::cos(std::atan(tan_gamma));
    EXPECT_NEAR(at.right.normal_force, expected, 1e-9 * expected) << tan_gamma;
    EXPECT_NEAR(at.left.normal_force, expected, 1e-9 * expected) << tan_gamma;
    EXPECT_NEAR(at.holding_force, 0.0, 1e-6);
    EXPECT_NEAR(at.lowering, at.right.approach / std::cos(std::atan(tan_gamma)), 1e-12);
    EXPECT_TRUE(std::isnan(at.roll));  // it may not
  }
}

/// Forces and moments of all that acts, put together anew, about a point where nothing acts.
TEST(LoadedWheelset, NothingIsLeftOfForcesAndMoments) {
  const SideInput right{hollow(90e-3, 0.0), round_rail(80e-3, 60e-3), 0.75, 0.752, 0.0},
      left{cone(0.1), round_rail(90e-3), 0.75, 0.751, 0.0};
  for (const Roll roll : {Roll::none, Roll::free}) {
    const WheelsetOnTrack w(right, left, kRadius, roll);
    int steep = 0;
    for (int k = -20; k <= 40; ++k) {
      const Position p = w.at(2e-4 * k);
      ASSERT_TRUE(p.right.end == ProfileEnd::none && p.left.end == ProfileEnd::none) << k;
      steep += std::fabs(p.right.angle) > 0.5 ? 1 : 0;
      const LoadedPosition at = loaded(w, p, kAxle);
      struct Force {
        double y, z, f_y, f_z;
      };
      const double n_r = at.right.normal_force, n_l = at.left.normal_force;
      const std::array<Force, 4> forces{
          Force{p.right.track_y, p.right.track_z, -n_r * std::sin(p.right.angle), -n_r * std::cos(p.right.angle)},
          Force{-p.left.track_y, p.left.track_z, n_l * std::sin(p.left.angle), -n_l * std::cos(p.left.angle)},
          Force{p.y + kRadius * std::sin(p.roll), p.z - kRadius * std::cos(p.roll), 0.0, kAxle.weight},
          Force{p.y, p.z, at.holding_force, 0.0}};
      double f_y = 0.0, f_z = 0.0, moment = 0.0;
      for (const Force& f : forces) {
        f_y += f.f_y, f_z += f.f_z;
        moment += (f.y - 0.3) * f.f_z - (f.z + 0.2) * f.f_y;
      }
      const double rounding = 1e-12 * kAxle.weight;
      EXPECT_NEAR(f_y, 0.0, rounding) << k;
      EXPECT_NEAR(f_z, 0.0, rounding) << k;
      EXPECT_NEAR(moment, 0.0, rounding) << k;
      EXPECT_EQ(at.holding_force, kAxle.weight * w.holding_force(p)) << k;
    }
    EXPECT_GT(steep, 10);  // steep contacts are among them
  }
}

/// A ball on a plane: Johnson 1985, eqs. 4.22 to 4.24. The same holds for crossed cylinders of equal radius.
TEST(LoadedWheelset, RoundPatchesHaveTheClosedForm) {
  for (const auto& [wheel, rail] :
       {std::pair{crowned(kRadius), flat_rail()}, std::pair{cone(0.0), round_rail(kRadius)}}) {
    const WheelsetOnTrack w = wheelset(wheel, rail);
    const LoadedSide side = loaded(w, w.at(0.0), kAxle).right;
    ASSERT_EQ(side.reason, "");
    EXPECT_NEAR(side.normal_force, 100e3, 1e-6);
    const double a = std::cbrt(0.75 * 100e3 * kRadius / kPair);
    EXPECT_NEAR(side.semi_axis_x, a, kCurvatureOfSamples * a);
    EXPECT_NEAR(side.semi_axis_y, a, kCurvatureOfSamples * a);
    EXPECT_NEAR(side.pressure, 1.5 * 100e3 / (pi * a * a), kCurvatureOfSamples * 1e9);
    EXPECT_NEAR(side.approach, a * a / kRadius, kCurvatureOfSamples * a * a / kRadius);
  }
}

/// Displacement of a half-space of the pair under the ellipse's pressure, by Boussinesq: integrals along chords through
/// the point are known, the one over their directions is a sum that converges like no other.
double displacement(const LoadedSide& side, double x, double y) {
  constexpr int kDirections = 400;
  const double a2 = side.semi_axis_x * side.semi_axis_x, b2 = side.semi_axis_y * side.semi_axis_y;
  double sum = 0.0;
  for (int k = 0; k < kDirections; ++k) {
    const double c = std::cos(pi * k / kDirections), s = std::sin(pi * k / kDirections);
    // 1 - (x/a)^2 - (y/b)^2 along the chord: q0 + q1 r - q2 r^2
    const double q0 = 1.0 - x * x / a2 - y * y / b2, q1 = -2.0 * (x * c / a2 + y * s / b2),
                 q2 = c * c / a2 + s * s / b2;
    sum += pi / 8.0 * (q1 * q1 + 4.0 * q0 * q2) / std::pow(q2, 1.5);
  }
  return side.pressure * sum * pi / kDirections / (pi * kPair);
}

TEST(LoadedWheelset, EllipsesMakeTheBodiesFit) {
  const double rail_radius = 80e-3;
  for (const double wheel_radius : {0.3, 2.0, -0.1}) {  // convex, nearly straight, hollow
    const WheelsetOnTrack w =
        wheelset(wheel_radius > 0.0 ? crowned(wheel_radius) : hollow(-wheel_radius, 0.0), round_rail(rail_radius));
    const LoadedSide side = loaded(w, w.at(0.0), {60e3, {}}).right;
    ASSERT_EQ(side.reason, "") << wheel_radius;
    const double a = side.semi_axis_x, b = side.semi_axis_y;
    EXPECT_NEAR(2.0 / 3.0 * pi * a * b * side.pressure, side.normal_force, 1e-9 * side.normal_force);
    const double along = 0.5 / kRadius, across = 0.5 * (1.0 / wheel_radius + 1.0 / rail_radius);
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, std::pair{0.7, 0.0}, std::pair{0.0, 0.8}, std::pair{-0.5, 0.4}})
      EXPECT_NEAR(displacement(side, x * a, y * b) + along * x * x * a * a + across * y * y * b * b, side.approach,
                  10.0 * kCurvatureOfSamples * side.approach)
          << wheel_radius << ' ' << x << ' ' << y;
  }
}

/// Along the track an inclined wheel is bent like the cone that touches it there.
TEST(LoadedWheelset, InclinedWheelsAreFlatterAlongTheTrack) {
  constexpr double kRail = 0.1;
  const WheelsetOnTrack steep = wheelset(cone(0.4), round_rail(kRail, 0.05));
  const Position p = steep.at(0.0);
  const LoadedSide side = loaded(steep, p, kAxle).right;
  const double normal_radius = p.right.radius / std::cos(std::atan(0.4));
  const double along = 0.5 / normal_radius, across = 0.5 / kRail;
  const double u = displacement(side, 0.6 * side.semi_axis_x, 0.0), v = displacement(side, 0.0, 0.6 * side.semi_axis_y);
  EXPECT_NEAR((side.approach - u) / (along * std::pow(0.6 * side.semi_axis_x, 2)), 1.0, 1e-3);
  EXPECT_NEAR((side.approach - v) / (across * std::pow(0.6 * side.semi_axis_y, 2)), 1.0, 1e-3);
}

/// The wheelset lowered and rolled by what is reported goes as deep into both rails as the approaches say. Depths are
/// those of all points of both bodies, in a frame of their own.
TEST(LoadedWheelset, LoweringAndRollMakeTheApproaches) {
  const WheelsetOnTrack w = wheelset(flanged_wheel(), round_rail(40e-3, 36e-3), Roll::free);
  for (const double y : {1e-3, 4e-3, 5.2e-3}) {
    const Position p = w.at(y);
    ASSERT_TRUE(p.sound());
    const LoadedPosition at = loaded(w, p, {20e3, {}});
    ASSERT_EQ(at.right.reason + at.left.reason, "");
    const double roll = p.roll + at.roll;
    for (const double side : {1.0, -1.0}) {
      double least = 1.0;
      for (int k = -66000; k <= 60000; ++k) {
        const double s = 1e-6 * k, across = side * (0.75 + s), up = flanged(s) - kRadius;
        const double on_rail = y + across * std::cos(roll) - up * std::sin(roll) - side * 0.75;
        if (std::fabs(on_rail) > 36e-3) continue;
        least = std::min(
            least, 40e-3 - std::sqrt(1.6e-3 - on_rail * on_rail) - (across * std::sin(roll) + up * std::cos(roll)));
      }
      const Touch& touch = side > 0.0 ? p.right : p.left;
      const double approach = (side > 0.0 ? at.right : at.left).approach;
      constexpr double kSecondOrder = 2e-3;  // contact moves a little
      EXPECT_NEAR((p.z + at.lowering - least) * std::cos(touch.angle), approach, kSecondOrder * approach)
          << y << ' ' << side;
    }
  }
}

TEST(LoadedWheelset, SidesExchangedAreTheMirrorImage) {
  const SideInput right{flanged_wheel(), round_rail(60e-3), 0.75, 0.752, 0.0},
      left{cone(0.1), round_rail(90e-3), 0.75, 0.751, 0.0};
  for (const Roll roll : {Roll::none, Roll::free}) {
    const WheelsetOnTrack a(right, left, kRadius, roll), b(left, right, kRadius, roll);
    const LoadedPosition p = loaded(a, a.at(2.3e-3), kAxle), q = loaded(b, b.at(-2.3e-3), kAxle);
    EXPECT_NEAR(p.holding_force, -q.holding_force, 1e-6);
    EXPECT_GT(std::fabs(p.holding_force), 100.0);
    EXPECT_NEAR(p.lowering, q.lowering, 1e-12);
    if (roll == Roll::free) {
      EXPECT_NEAR(p.roll, -q.roll, 1e-12);
      EXPECT_GT(std::fabs(p.roll), 1e-7);
    }
    for (const auto& [one, other] : {std::pair{p.right, q.left}, std::pair{p.left, q.right}}) {
      EXPECT_NEAR(one.normal_force, other.normal_force, 1e-6);
      EXPECT_NEAR(one.pressure, other.pressure, 1e-6 * one.pressure);
      EXPECT_NEAR(one.semi_axis_x, other.semi_axis_x, 1e-9);
      EXPECT_NEAR(one.semi_axis_y, other.semi_axis_y, 1e-9);
    }
  }
}

void expect_none(const LoadedSide& side, const char* why) {
  EXPECT_THAT(side.reason, HasSubstr(why));
  for (const double value : {side.pressure, side.semi_axis_x, side.semi_axis_y, side.approach})
    EXPECT_TRUE(std::isnan(value)) << why;
  EXPECT_FALSE(side.shared);
}

TEST(LoadedWheelset, WhatHasNoEllipseSaysWhy) {
  constexpr double kRail = 80e-3;
  for (const double wheel_radius : {kRail, 1.001 * kRail}) {
    const WheelsetOnTrack w = wheelset(hollow(wheel_radius, 0.0), round_rail(kRail));
    expect_none(loaded(w, w.at(0.0), kAxle).right, "conformal");
  }
  const WheelsetOnTrack w = wheelset(crowned(0.3), round_rail(kRail));
  const Position sound = w.at(0.0);
  const auto with = [&](auto change) {
    Position p = sound;
    change(p.right);
    return loaded(w, p, kAxle);
  };
  expect_none(with([](Touch& t) { t.wheel_curvature = -t.rail_curvature; }).right, "conformal: ");
  expect_none(with([](Touch& t) { t.wheel_curvature = -1.5 * t.rail_curvature; }).right, "conformal: ");
  expect_none(with([](Touch& t) { t.wheel_curvature = NAN; }).right, "no curvature");
  expect_none(with([](Touch& t) { t.end = ProfileEnd::rail_field; }).right, "a profile ends there");
  EXPECT_GT(with([](Touch& t) { t.end = ProfileEnd::rail_field; }).left.pressure, 0.0);
  expect_none(with([](Touch& t) { t = Touch{NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN}; }).right, "nothing touches");
  // a kink of 6 degrees in the rail's head
  const WheelsetOnTrack kink =
      wheelset(cone(0.0), section(
                              Body::rail, -30e-3, 30e-3, [](double y) { return 0.05 * std::fabs(y); },
                              [](double y) { return y < 0.0 ? -0.05 : 0.05; }));
  for (const double y : {0.0, 1.23e-3}) expect_none(loaded(kink, kink.at(y), kAxle).right, "an edge of the rail");
  expect_none(loaded(w, sound, {1.0, {}}).right, "narrower than 0.15 mm");
}

TEST(LoadedWheelset, TipsOverByName) {
  const WheelsetOnTrack w = wheelset(crowned(0.3), round_rail(80e-3));
  Position p = w.at(0.0);
  // A face that is nearly upright, deep below the rail's top: its force turns the wheelset the wrong way.
  p.right.angle = 1.565;
  p.right.track_z = 14e-3;
  const LoadedPosition at = loaded(w, p, kAxle);
  EXPECT_LT(at.right.normal_force, 0.0);
  for (const LoadedSide& side : {at.right, at.left})
    expect_none(side, "the wheelset tips over: its right wheel lifts off");
  std::swap(p.right, p.left);
  expect_none(loaded(w, p, kAxle).right, "the wheelset tips over: its left wheel lifts off");
}

/// Two round bumps as a rail, a wheel nearly in the middle: the second one takes its share as soon as the approach is
/// larger than its gap.
TEST(LoadedWheelset, SecondContactsShareTheLoad) {
  const auto bump = [](double d) { return 0.05 - std::sqrt(2.5e-3 - d * d); };
  const auto rail = section(
      Body::rail, -30e-3, 30e-3, [&](double y) { return std::min(bump(y + 10e-3), bump(y - 10e-3)); },
      [](double y) {
        const double d = y < 0.0 ? y + 10e-3 : y - 10e-3;
        return d / std::sqrt(2.5e-3 - d * d);
      });
  const WheelsetOnTrack w = wheelset(crowned(1.0), rail);
  const Position p = w.at(0.2e-3);
  const std::vector<Touch> others = w.further_touches(p, true, 0.1e-3);
  ASSERT_EQ(others.size(), 1u);
  const auto at = [&](double weight) { return loaded(w, p, {weight, {}}).right; };
  // approaches grow with the power 2/3 of the load
  const double closes = 1e3 * std::pow(others[0].gap * std::cos(p.right.angle) / at(1e3).approach, 1.5);
  EXPECT_FALSE(at(0.99 * closes).shared);
  EXPECT_TRUE(at(1.01 * closes).shared);
}

TEST(LoadedWheelset, AllShiftsUnderLoad) {
  const WheelsetOnTrack w = wheelset(flanged_wheel(), round_rail(40e-3, 36e-3));
  const ContactFunctions f = contact_functions(w, {0.1e-3, 6e-3, 0.0});
  constexpr double kAmplitude = 3e-3;
  const LoadedFunctions l = loaded_functions(w, f, kAxle, 0.0, kAmplitude);
  ASSERT_EQ(l.rows.size(), f.rows.size());
  ASSERT_EQ(l.before.size(), f.jumps.size());
  ASSERT_EQ(l.after.size(), f.jumps.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < f.rows.size(); ++i) {
    const LoadedPosition &row = l.rows[i], &mirror = l.rows[f.rows.size() - 1 - i];
    EXPECT_NEAR(row.right.normal_force, mirror.left.normal_force, 1e-6);
    EXPECT_NEAR(row.right.normal_force * std::cos(f.rows[i].right.angle) +
                    row.left.normal_force * std::cos(f.rows[i].left.angle),
                kAxle.weight, 1e-9 * kAxle.weight);
    if (std::fabs(f.rows[i].y) < kAmplitude + 1e-9)
      largest = std::max({largest, row.right.pressure, row.left.pressure});
  }
  EXPECT_EQ(l.largest.pressure, largest);
  EXPECT_LE(std::fabs(l.largest_y), kAmplitude + 1e-9);
  EXPECT_NEAR(l.at_middle.right.normal_force, l.at_middle.left.normal_force, 1e-6);
}

/// A rail of two arcs that meet 2 mm beside the contact: there the gap at the ellipse's end has a closed form.
TEST(LoadedWheelset, MisfitIsThatOfTheGap) {
  constexpr double kTop = 0.3, kBeside = 0.08, kMeet = 2e-3;
  // parabolas as arcs
  const auto arc = [](double radius, double y) { return 0.5 * y * y / radius; };
  const auto z = [&](double y) {
    const double d = y - kMeet;
    return y < kMeet ? arc(kTop, y) : arc(kTop, kMeet) + kMeet / kTop * d + arc(kBeside, d);
  };
  const auto slope = [&](double y) { return y < kMeet ? y / kTop : kMeet / kTop + (y - kMeet) / kBeside; };
  const WheelsetOnTrack w = wheelset(cone(0.0), section(Body::rail, -30e-3, 30e-3, z, slope));
  const auto at = [&](double weight) { return loaded(w, w.at(0.0), {weight, {}}).right; };
  EXPECT_LT(at(1e3).semi_axis_y, kMeet);
  EXPECT_NEAR(at(1e3).misfit, 0.0, 1e-6);
  const LoadedSide side = at(200e3);
  ASSERT_GT(side.semi_axis_y, kMeet);
  const double b = side.semi_axis_y;
  EXPECT_NEAR(side.misfit, z(b) / arc(kTop, b) - 1.0, 1e-6);
  // of circles, also where they are inclined, it is what a circle leaves its parabola
  const double wheel = 0.1, rail = 0.08;
  const WheelsetOnTrack circles = wheelset(hollow(wheel, 0.0), round_rail(rail, 60e-3));
  const auto bulge = [](double radius, double half) { return radius - std::sqrt(radius * radius - half * half); };
  for (const double y : {0.0, 8e-3}) {
    const LoadedSide round = loaded(circles, circles.at(y), kAxle).right;
    const double c = round.semi_axis_y, parabola = 0.5 * (1.0 / rail - 1.0 / wheel) * c * c;
    const double expected = (bulge(rail, c) - bulge(wheel, c)) / parabola - 1.0;
    EXPECT_GT(expected, 3e-3);
    // Curvatures come from samples, off the point by half a step at most: where the profiles are inclined that is
    // 3e-4 of each, five times that of their difference. Not seen along the tangent it would be 8e-2.
    EXPECT_NEAR(round.misfit, expected, y == 0.0 ? 1e-4 : 1.5e-3) << y;
  }
  const WheelsetOnTrack narrow = wheelset(cone(0.0), section(Body::rail, -3e-3, 3e-3, z, slope));
  expect_none(loaded(narrow, narrow.at(0.0), kAxle).right, "a profile ends within the ellipse");
}

TEST(LoadedWheelset, RefusesWhatIsNoLoad) {
  const WheelsetOnTrack w = wheelset(crowned(0.3), round_rail(80e-3));
  const auto error = [&](const AxleLoad& load) { return testing::error_of([&] { loaded(w, w.at(0.0), load); }); };
  EXPECT_EQ(error(kAxle), "");
  EXPECT_THAT(error({0.0, {}}), HasSubstr("an axle load of 0 N"));
  EXPECT_THAT(error({NAN, {}}), HasSubstr("an axle load of nan N"));
  AxleLoad soft = kAxle;
  soft.material.shear_modulus_1 = 0.0;
  EXPECT_THAT(error(soft), HasSubstr("elastic constants"));
}

}  // namespace
}  // namespace treadmark::geometry
