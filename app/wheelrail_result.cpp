// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/wheelrail_result.hpp"

#include "treadmark/app/derived_results.hpp"
#include "treadmark/app/patch_result.hpp"
#include "treadmark/app/wheelrail_case.hpp"

namespace treadmark::app {
namespace {

io::Load to_load(const wheelrail::Wrench& load) { return {load.force, load.moment}; }

io::Loads to_loads(const wheelrail::Wrenches& load) {
  return {to_load(load.track), to_load(load.rail), to_load(load.wheelset), to_load(load.wheel)};
}

void put_reference(const wheelrail::PatchSolution& patch, io::PatchResult& r) {
  r.has_reference = true;
  const Vec3 &track = patch.frame.X_TC.origin, &rail = patch.reference_rail;
  const Vec3 &wheel = patch.reference_wheel, &set = patch.reference_wheelset;
  r.x_tr = track.x();
  r.y_tr = track.y();
  r.z_tr = track.z();
  r.angle = patch.frame.angle;
  r.x_rail = rail.x();
  r.y_rail = rail.y();
  r.z_rail = rail.z();
  r.s_rail = patch.reference_s;
  r.x_wheel = wheel.x();
  r.y_wheel = wheel.y();
  r.z_wheel = wheel.z();
  r.x_wheelset = set.x();
  r.y_wheelset = set.y();
  r.z_wheelset = set.z();
  r.angle_rail = patch.angle_rail;
  r.angle_wheelset = patch.angle_wheelset;
  r.angle_wheel = patch.angle_wheel;
  // Elements of grids that stay aligned in time have another origin than the contact reference.
  r.reference_x = patch.reference_C.x();
  r.reference_s = patch.reference_C.y();
  r.fields.X_TC = patch.frame.X_TC;
  r.fields.X_TC.origin = patch.frame.X_TC.apply({-patch.reference_C.x(), -patch.reference_C.y(), 0.0});
}

/// What the patch feels as a whole; of a plane without damping these are the sums of the elements.
void put_resultant(const io::WheelRailCase& input, const wheelrail::PatchSolution& patch, io::PatchResult& r) {
  const bool curved = !patch.row_angle.empty();
  if (curved) r.local = {r.fn, r.fx, r.fs};
  if (curved || input.damping) {
    r.fx = patch.force_C.x();
    r.fs = patch.force_C.y();
    r.fn = patch.force_C.z();
  }
  const bool aligned = patch.reference_C != Vec2::Zero();
  if (curved || (aligned && !input.moments_about_grid_origin)) r.mn = patch.moment_C.z();
}

void put_kinematics(const io::WheelRailCase& input, const wheelrail::PatchSolution& patch, io::PatchResult& r) {
  r.has_rolling = input.regime == Regime::steady || input.regime == Regime::transient;
  r.shift = input.regime == Regime::shift;
  r.chi = patch.kinematics.chi;
  r.velocity = patch.kinematics.velocity;
  r.dq = patch.contact.rolling_step;
  r.xi = patch.kinematics.xi;
  r.eta = patch.kinematics.eta;
  r.phi = patch.kinematics.phi;
}

io::PatchResult to_patch(const io::WheelRailCase& input, const wheelrail::PatchSolution& patch) {
  io::PatchResult r =
      patch_result(patch.contact, patch.grid, patch.distance, input.material, friction_of(input, patch.frame.angle));
  r.id = patch.id;
  r.came_from = patch.came_from;
  put_reference(patch, r);
  put_resultant(input, patch, r);
  put_kinematics(input, patch, r);
  r.loads = to_loads(patch.load);
  r.fields.row_angle = patch.row_angle;
  r.fields.extra_slip_x = patch.extra_slip_x;
  r.fields.extra_slip_s = patch.extra_slip_y;
  add_dissipation(r);
  add_subsurface(input.subsurface, input.material, patch.grid, patch.contact, r, patch.reference_C);
  return r;
}

}  // namespace

io::CaseResult to_result(const io::WheelRailCase& input, const wheelrail::PairSolution& s) {
  io::CaseResult result;
  result.status = s.status;
  result.message = s.message;
  const WheelsetState& w = input.state;
  result.has_wheelset = true;
  result.s = w.position.x;
  result.y = w.position.y;
  result.z = s.z;
  result.roll = w.position.roll;
  result.yaw = w.position.yaw;
  result.pitch = w.position.pitch;
  result.vs = w.velocity.x;
  result.vy = w.velocity.y;
  result.vz = w.velocity.z;
  result.vroll = w.velocity.roll;
  result.vyaw = w.velocity.yaw;
  result.vpitch = input.longitudinal_force ? s.pitch_rate : w.velocity.pitch;
  result.force_tr = s.load.track.force;
  result.force_ws = s.load.wheelset.force;
  result.moment_rail = s.load.track.moment;
  result.moment_wheel = s.load.wheelset.moment;
  result.loads = to_loads(s.load);
  if (input.rail_springs) result.rail_deflection = Vec2(s.rail_deflection_y, s.rail_deflection_z);
  if (input.roller) result.roller = {input.roller->nominal_radius, input.roller->pitch_rate};
  result.bodies = io::CaseResult::Bodies{s.placement.X_TA, s.placement.X_TS};
  result.search_s = s.times.search_s;
  result.distance_s = s.times.distance_s;
  result.normal_s = s.times.normal_s;
  result.tangential_s = s.times.tangential_s;
  result.searches = s.times.searches;
  result.distances = s.times.distances;
  result.normal_solves = s.times.normal_solves;
  result.tangential_solves = s.times.tangential_solves;
  result.force_iterations = s.force_iterations;

  for (const wheelrail::PatchSolution& patch : s.patches) result.patches.push_back(to_patch(input, patch));
  return result;
}

}  // namespace treadmark::app
