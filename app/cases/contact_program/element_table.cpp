// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/contact_program/element_table.hpp"

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/io/cases/contact_program/contact_case.hpp"

namespace treadmark::app {
namespace {

template <class Content>
int material_digit(const Content& input) {
  if (input.material.creep_ratio_1 != 0.0 || input.material.creep_ratio_2 != 0.0) return 1;
  if (const int digit = theory(input.tangential_model).digit.value; digit >= 0) return digit;
  return input.material.layer_flexibility > 0.0 ? 4 : 0;
}

template <class Content>
io::MatFileHead common_head(const Content& input, int case_number) {
  io::MatFileHead head;
  head.tangential = theory(input.regime).digit.value;
  head.heat = input.thermal ? 1 : 0;
  head.case_number = case_number;
  head.material = input.material;
  head.friction = input.friction;
  head.material_model = material_digit(input);
  head.friction_law = io::kLawDigits[static_cast<int>(input.friction.kind)];
  return head;
}

}  // namespace

io::MatFileHead mat_head(const io::BasicCase& input, int case_number) {
  io::MatFileHead head = common_head(input, case_number);
  head.spin_x = input.spin_x;
  head.spin_y = input.spin_y;
  return head;
}

io::MatFileHead mat_head(const io::WheelRailCase& input, const wheelrail::PairSolution& solution, std::size_t patch,
                         int case_number) {
  io::MatFileHead head = common_head(input, case_number);
  head.friction = friction_of(input, solution.patches[patch].frame.angle);
  head.s_ws = input.roller ? 0.0 : input.state.position.x;
  head.pitch_ws = input.state.position.pitch;
  const Pose &rail = solution.placement.X_TR, &wheel = solution.placement.X_TW;
  head.rail_y = rail.origin.y();
  head.rail_z = rail.origin.z();
  head.rail_roll = roll_yaw_pitch(rail.rotation).roll;
  head.roller_radius = input.roller ? input.roller->nominal_radius : 0.0;
  head.wheel_x = wheel.origin.x();
  head.wheel_y = wheel.origin.y();
  head.wheel_z = wheel.origin.z();
  const RollYawPitch turned = roll_yaw_pitch(wheel.rotation);
  head.wheel_roll = turned.roll;
  head.wheel_yaw = turned.yaw;
  head.wheel_radius = input.wheelset.nominal_radius;
  const Vec2& reference = solution.patches[patch].reference_C;
  head.spin_x = reference.x();
  head.spin_y = reference.y();
  constexpr int kOnRoller = 4;
  head.configuration = (input.side == Side::right ? 1 : 0) + (input.roller ? kOnRoller : 0);
  head.discretisation = io::discretisation_digit(input);
  head.patches = static_cast<int>(solution.patches.size());
  head.patch = static_cast<int>(patch) + 1;
  return head;
}

}  // namespace treadmark::app
