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
  if (d.method == kGrid || !constant_profiles) return Grid::reference_mesh;
  return d.prune ? Grid::reference_locus : Grid::refined;
}

detection::SearchMethod search_method(const io::DiscretisationInput& d) {
  using Method = detection::SearchMethod;
  if (!d.prune) return Method::full_grid;
  return d.method == kGrid || d.method == kSteepGrid ? Method::pruned_grid : Method::automatic;
}

wheelrail::ReferenceSurface reference_surface(io::ReferenceSurfaceInput input) {
  using From = io::ReferenceSurfaceInput;
  using To = wheelrail::ReferenceSurface;
  return input == From::curved ? To::curved : input == From::plane_surface_slip ? To::plane_surface_slip : To::plane;
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
  p.longitudinal_force = input.longitudinal_force;
  if (input.roller) p.roller = {input.roller->nominal_radius, input.roller->pitch_rate};
  if (const auto& k = input.rail_springs)
    p.rail_springs = {k->stiffness_y, k->stiffness_z, k->force_y, k->force_z, k->first_step_y};
  if (const auto& d = input.damping) p.damping = {d->normal, d->tangential, d->max_rate_normal, d->max_rate_tangential};
  p.regime = to_regime(input.regime);
  p.history = to_history(input.history);
  p.enforce_step_rule = !input.long_steps;
  p.reference_surface = reference_surface(input.reference_surface);

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
    p.friction = friction_of(input, 0.0);
  }
  p.normal_model = to_normal_model(input.normal_model);
  p.tangential_model = to_tangential_model(input.tangential_model);
  p.fastsim = {input.fastsim_k0, input.fastsim_alpha, input.fastsim_beta, input.fastsim_flexibility};
  p.influence = to_influence(input.influence);
  p.solver = to_solver_settings(input.solver);
  p.solver.reference_quirks = d.reference_search_mesh;
  p.max_force_iterations = input.solver.max_nr;
  p.thermal = input.thermal;
  p.sensitivities = input.sensitivities;
  return p;
}

double profile_radius(const io::WheelRailCase& input, Body body) {
  if (body == Body::wheel) return input.wheelset.nominal_radius;
  return input.roller ? input.roller->nominal_radius : 0.0;
}

FrictionLaw friction_of(const io::WheelRailCase& input, double contact_angle) {
  using Kind = io::FrictionVariation::Kind;
  const io::FrictionVariation& v = input.friction_variation;
  if (v.kind == Kind::none) return input.friction;
  // Inclinations are given as for the right-hand side.
  const double inclination = input.side == io::Side::left ? -contact_angle : contact_angle;
  return friction_at(v.positions, v.laws, v.kind == Kind::inclination ? inclination : input.wheelset.s, input.friction);
}

const io::WheelRailCase* first_wheelrail_case(const io::CaseFile& file) {
  for (const io::Case& c : file.cases)
    if (const auto* input = std::get_if<io::WheelRailCase>(&c.content)) return input;
  return nullptr;
}

}  // namespace treadmark::app
