// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/wheelrail_case.hpp"

#include "treadmark/app/patch_result.hpp"

namespace treadmark::app {
namespace {

constexpr int kGrid = 5, kSteepGrid = 6;  // of DiscretisationInput::method

wheelrail::Discretisation::SearchGrid search_grid(const io::DiscretisationInput& d, bool constant_profiles) {
  using Grid = wheelrail::Discretisation::SearchGrid;
  if (!d.reference_search_mesh) return Grid::refined;
  if (d.method == kSteepGrid) return Grid::reference_steep;
  return d.method == kGrid || !constant_profiles ? Grid::reference_mesh : Grid::refined;
}

detection::SearchMethod search_method(const io::DiscretisationInput& d) {
  using Method = detection::SearchMethod;
  if (!d.prune) return Method::full_grid;
  return d.method == kGrid || d.method == kSteepGrid ? Method::pruned_grid : Method::automatic;
}

}  // namespace

wheelrail::Problem to_problem(const io::WheelRailCase& input, bool constant_profiles) {
  wheelrail::Problem p;
  p.side = input.side == io::Side::left ? wheelrail::Side::left : wheelrail::Side::right;

  const io::TrackInput& t = input.track;
  p.track = {t.gauge_based, t.gauge_height, t.gauge_width, t.rail_y0, t.rail_z0, t.cant, t.curvature,
             t.dy,          t.dz,           t.roll,        t.vy,      t.vz,      t.vroll};

  const io::WheelsetInput& w = input.wheelset;
  p.wheelset = {w.flange_back_distance, w.flange_back_position, w.nominal_radius, w.tape_line};
  p.state.position = {w.s, w.y, w.z, w.roll, w.yaw, w.pitch};
  p.state.velocity = {w.vs, w.vy, w.vz, w.vroll, w.vyaw, w.vpitch};
  p.state.wheel_offset = {w.dx, w.dy, w.dz, w.droll, w.dyaw, w.dpitch};
  p.state.wheel_velocity = {w.dvx, w.dvy, w.dvz, w.dvroll, w.dvyaw, w.dvpitch};
  if (input.vertical_force_prescribed) p.vertical_force = input.vertical_force;
  p.regime = input.regime == io::RegimeInput::steady ? kalker::Regime::steady : kalker::Regime::frictionless;

  const io::DiscretisationInput& d = input.discretisation;
  constexpr int kInitialContactPoint = 7;
  p.discretisation.dx = d.dx;
  p.discretisation.ds = d.ds;
  p.discretisation.dq_relative = d.dq_relative;
  p.discretisation.angle_separation = d.angle_separation;
  p.discretisation.separation = d.separation;
  p.discretisation.combination = d.combination;
  p.discretisation.turning = d.turning;
  p.discretisation.near_miss = d.near_miss;
  p.discretisation.max_elements = d.max_elements;
  p.discretisation.linear_weight = d.linear_weight;
  p.discretisation.reference_at_deepest = d.method == kInitialContactPoint;
  p.discretisation.search = search_grid(d, constant_profiles);
  p.discretisation.search_method = search_method(d);
  p.discretisation.distance_on_mesh = d.reference_search_mesh;

  p.material = input.material;
  p.friction = input.friction;
  const io::FrictionVariation& variation = input.friction_variation;
  if (variation.kind == io::FrictionVariation::Kind::inclination) {
    p.friction_inclination = variation.positions;
    p.friction_laws = variation.laws;
  } else if (variation.kind == io::FrictionVariation::Kind::along_track) {
    p.friction = friction_at(variation.positions, variation.laws, input.wheelset.s, input.friction);
  }
  p.normal_model = to_normal_model(input.normal_model);
  p.tangential_model = to_tangential_model(input.tangential_model);
  p.fastsim = {input.fastsim_k0, input.fastsim_alpha, input.fastsim_beta, input.fastsim_flexibility};
  p.influence = to_influence(input.influence);
  p.solver = to_solver_settings(input.solver);
  p.solver.reference_quirks = d.reference_search_mesh;
  p.max_force_iterations = input.solver.max_nr;
  return p;
}

const io::WheelRailCase* first_wheelrail_case(const io::CaseFile& file) {
  for (const io::Case& c : file.cases)
    if (const auto* input = std::get_if<io::WheelRailCase>(&c.content)) return input;
  return nullptr;
}

io::CaseResult to_result(const io::WheelRailCase& input, const wheelrail::PairSolution& s) {
  io::CaseResult result;
  result.status = s.status;
  result.message = s.message;
  const io::WheelsetInput& w = input.wheelset;
  result.has_wheelset = true;
  result.s = w.s;
  result.y = w.y;
  result.z = s.z;
  result.roll = w.roll;
  result.yaw = w.yaw;
  result.pitch = w.pitch;
  result.vs = w.vs;
  result.vy = w.vy;
  result.vz = w.vz;
  result.vroll = w.vroll;
  result.vyaw = w.vyaw;
  result.vpitch = w.vpitch;
  result.force_tr = s.load.track.force;
  result.force_ws = s.load.wheelset.force;
  result.moment_rail = s.load.track.moment;
  result.moment_wheel = s.load.wheelset.moment;
  result.search_s = s.times.search_s;
  result.distance_s = s.times.distance_s;
  result.normal_s = s.times.normal_s;
  result.tangential_s = s.times.tangential_s;
  result.searches = s.times.searches;
  result.distances = s.times.distances;
  result.normal_solves = s.times.normal_solves;
  result.tangential_solves = s.times.tangential_solves;
  result.force_iterations = s.force_iterations;

  for (const wheelrail::PatchSolution& patch : s.patches) {
    io::PatchResult r = patch_result(patch.contact, patch.grid, patch.distance, input.material, input.friction);
    r.has_reference = true;
    r.x_tr = patch.frame.X_TC.origin.x();
    r.y_tr = patch.frame.X_TC.origin.y();
    r.z_tr = patch.frame.X_TC.origin.z();
    r.angle = patch.frame.angle;
    r.x_rail = patch.reference_rail.x();
    r.y_rail = patch.reference_rail.y();
    r.z_rail = patch.reference_rail.z();
    r.s_rail = patch.reference_s;
    r.x_wheel = patch.reference_wheel.x();
    r.y_wheel = patch.reference_wheel.y();
    r.z_wheel = patch.reference_wheel.z();
    r.has_rolling = input.regime == io::RegimeInput::steady;
    r.chi = patch.kinematics.chi;
    r.velocity = patch.kinematics.velocity;
    r.dq = patch.contact.rolling_step;
    r.xi = patch.kinematics.xi;
    r.eta = patch.kinematics.eta;
    r.phi = patch.kinematics.phi;
    r.fields.X_TC = patch.frame.X_TC;
    result.patches.push_back(std::move(r));
  }
  return result;
}

}  // namespace treadmark::app
