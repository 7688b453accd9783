// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/curving.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kRounding = 1e-12;
const CurvingVehicle kCoach{44000.0, 1.6, 0.3, 0.6, 1.5};
const CurvingVehicle kStiff{44000.0, 1.6, 0.0, 0.0, 1.5};

CurvingState in_curve(double speed, double radius, double cant) {
  return {speed, 9.81, {1.0 / radius, 0.0, 0.0}, {cant, 0.0, 0.0}};
}

TEST(Curving, EquilibriumCantIsThatOfTheRule) {
  // 11.8 V^2 / R in mm, km/h and m (EN 13803), of 1500 mm.
  for (const auto& [kmh, radius] : {std::pair{160.0, 1200.0}, {80.0, 300.0}}) {
    const Curving c = curving(kStiff, in_curve(kmh / 3.6, radius, 0.1));
    EXPECT_NEAR(c.equilibrium_cant * 1e3, 11.8 * kmh * kmh / radius, 0.001 * 11.8 * kmh * kmh / radius);
    EXPECT_NEAR(c.cant_deficiency, c.equilibrium_cant - 0.1, kRounding);
  }
}

TEST(Curving, NothingIsFeltAtEquilibrium) {
  // The cant whose plane is perpendicular to the apparent weight: tan, where the rule says sin.
  const double speed = 30.0, radius = 700.0, angle = std::atan(speed * speed / radius / 9.81);
  for (const double side : {1.0, -1.0}) {
    const Curving c = curving(kCoach, in_curve(speed, side * radius, side * 1.5 * std::sin(angle)));
    EXPECT_NEAR(c.lateral_acceleration, 0.0, kRounding);
    EXPECT_NEAR(c.load_shift, 0.0, kRounding);
    EXPECT_NEAR(c.guiding_force, 0.0, 1e-7);
    EXPECT_NEAR(c.normal_acceleration, std::hypot(9.81, speed * speed / radius), kRounding);
  }
}

/// Loads from the equations of motion in space, not in the track plane: forces of two rails on a mass that moves on a
/// circle, three equations for what is normal on the left and right rail and what is lateral.
Vec3 loads_in_space(const CurvingVehicle& v, const CurvingState& state) {
  const double phi = std::asin(state.cant.value / v.base);
  const Eigen::Vector2d lateral(std::cos(phi), std::sin(phi)), up(std::sin(phi), -std::cos(phi));  // y, z of space
  const double centripetal = state.speed * state.speed * state.curvature.value;
  const Curving c = curving(v, state);
  const double lever = v.centre_height - v.roll_centre_height;
  const Eigen::Vector2d centre =
      (v.roll_centre_height + lever * std::cos(c.body_roll)) * up + lever * std::sin(c.body_roll) * lateral;
  const auto moment = [&](const Eigen::Vector2d& arm, const Eigen::Vector2d& f) {
    return arm.x() * f.y() - arm.y() * f.x();
  };
  const Eigen::Vector2d left = -0.5 * v.base * lateral - centre, right = 0.5 * v.base * lateral - centre;
  Mat3 A;
  A << up.x(), up.x(), lateral.x(), up.y(), up.y(), lateral.y(), moment(left, up), moment(right, up),
      moment(-centre, lateral);
  return A.lu().solve(Vec3(v.mass * centripetal, -v.mass * state.gravity, 0.0));
}

TEST(Curving, LoadsBalanceInSpace) {
  for (const CurvingVehicle& v : {kCoach, kStiff})
    for (const double radius : {250.0, -250.0, 2000.0})
      for (const double cant : {0.0, 0.15, -0.15}) {
        const CurvingState state = in_curve(25.0, radius, cant);
        const Curving c = curving(v, state);
        const Vec3 loads = loads_in_space(v, state);
        EXPECT_NEAR(c.left_load, loads[0], 1e-6);
        EXPECT_NEAR(c.right_load, loads[1], 1e-6);
        EXPECT_NEAR(c.guiding_force, loads[2], 1e-6);
      }
}

TEST(Curving, SmallAnglesGiveTheUsualFormulas) {
  // a_q = g I / b, body (1 + s) a_q, shift of the load 2 h I / b^2 (1 + s (h - h_r) / h).
  const Curving c = curving(kCoach, in_curve(20.0, 20000.0, 0.001));
  const double deficiency = c.cant_deficiency;
  constexpr double kSecondOrder = 1e-5;  // of angles of a thousandth
  EXPECT_NEAR(c.lateral_acceleration / (9.81 * deficiency / 1.5), 1.0, kSecondOrder);
  EXPECT_NEAR(c.body_lateral_acceleration / (1.3 * c.lateral_acceleration), 1.0, kSecondOrder);
  EXPECT_NEAR(c.load_shift / (2.0 * (1.6 + 0.3 * 1.0) * deficiency / (1.5 * 1.5)), 1.0, kSecondOrder);
}

TEST(Curving, ACurveToTheLeftIsTheMirrorImage) {
  const Curving r = curving(kCoach, in_curve(33.0, 600.0, 0.08)), l = curving(kCoach, in_curve(33.0, -600.0, -0.08));
  EXPECT_GT(r.left_load, r.right_load);
  EXPECT_GT(r.lateral_acceleration, 0.0);
  EXPECT_LT(r.body_roll, 0.0);  // outwards
  EXPECT_NEAR(l.right_load, r.left_load, 1e-9);
  EXPECT_NEAR(l.lateral_acceleration, -r.lateral_acceleration, kRounding);
  EXPECT_NEAR(l.cant_deficiency, -r.cant_deficiency, kRounding);
}

TEST(Curving, RatesAreThoseOfTheLine) {
  TrackLayout layout;
  layout.elements = {{80.0, {0.0, 1 / 500.0}, {0.0, 0.12}, {1.435, 1.435}, TransitionShape::bloss, {}}};
  const TrackPath path(layout);
  const double speed = 25.0, step = 1e-3;
  const auto at = [&](double s) { return curving(kCoach, path.at(s), speed); };
  const Curving middle = at(40.0);
  EXPECT_NEAR(middle.cant_rate, 1.5 * 0.12 / 80.0 * speed, kRounding);
  const double difference = (at(40.0 + step).cant_deficiency - at(40.0 - step).cant_deficiency) / (2.0 * step);
  EXPECT_NEAR(middle.deficiency_rate, speed * difference, 1e-8);
}

TEST(Curving, TheInnerRailIsFreeAtTheOverturningSpeed) {
  // Without lean: V^2 / R = g tan(phi + atan(b / 2h)).
  const double closed = std::sqrt(300.0 * 9.81 * std::tan(std::asin(0.1) + std::atan(1.5 / 3.2)));
  EXPECT_NEAR(overturning_speed(kStiff, 1 / 300.0, 0.15), closed, 1e-9);
  for (const double side : {1.0, -1.0}) {
    const double speed = overturning_speed(kCoach, side / 300.0, side * 0.1);
    const Curving c = curving(kCoach, in_curve(speed, side * 300.0, side * 0.1));
    EXPECT_NEAR(side > 0 ? c.right_load : c.left_load, 0.0, 1e-5);
    EXPECT_NEAR(std::abs(c.load_shift), 1.0, 1e-10);
  }
  EXPECT_EQ(overturning_speed(kCoach, 0.0, 0.1), kInfinity);
}

TEST(Curving, NumbersHaveNamesWithUnits) {
  const auto numbers = named_numbers(curving(kStiff, in_curve(30.0, 600.0, 0.1)));
  ASSERT_EQ(numbers.size(), 12u);
  EXPECT_EQ(numbers[1].name, "cant_deficiency_mm");
  EXPECT_NEAR(numbers[1].value, 1500.0 * 1.5 / 9.81 - 100.0, 1e-9);
  EXPECT_NEAR(numbers[7].value + numbers[8].value, 44.0 * numbers[3].value, 1e-9);
}

TEST(Curving, NonsenseIsRefused) {
  const auto refused = [](CurvingVehicle v, CurvingState s) { EXPECT_THROW(curving(v, s), Error); };
  refused({0.0, 1.6, 0.0, 0.0, 1.5}, in_curve(10, 300, 0));
  refused({1e4, -1.0, 0.0, 0.0, 1.5}, in_curve(10, 300, 0));
  refused({1e4, 1.6, -0.1, 0.0, 1.5}, in_curve(10, 300, 0));
  refused(kStiff, in_curve(-1, 300, 0));
  refused(kStiff, in_curve(10, 300, 1.6));
  refused(kStiff, in_curve(10, 0.0, 0));
}

}  // namespace
}  // namespace treadmark::vehicle
