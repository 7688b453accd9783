// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/wheelrail_case.hpp"

#include <variant>

#include "treadmark/app/cases/wheelrail_result.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/detection/detector.hpp"
#include "treadmark/io/cases/read_case.hpp"

namespace treadmark::app {
namespace {

constexpr int kGrid = 5, kSteepGrid = 6;  // of DiscretisationInput::method

Discretisation::SearchGrid search_grid(const io::DiscretisationInput& d, bool round_wheel) {
  using Grid = Discretisation::SearchGrid;
  if (d.conventions != Conventions::contact) return Grid::refined;
  if (d.method == kSteepGrid) return Grid::reference_steep;
  if (d.method == kGrid || !round_wheel) return Grid::reference_mesh;
  return d.prune ? Grid::reference_locus : Grid::refined;
}

SearchMethod search_method(const io::DiscretisationInput& d) {
  if (!d.prune) return SearchMethod::full_grid;
  return d.method == kGrid || d.method == kSteepGrid ? SearchMethod::pruned_grid : SearchMethod::automatic;
}

}  // namespace

wheelrail::Problem to_problem(const io::WheelRailCase& input, bool round_wheel) {
  wheelrail::Problem p;
  p.side = input.side;
  p.track = input.track;
  p.wheelset = input.wheelset;
  p.state = input.state;
  if (input.vertical_force_prescribed) p.vertical_force = input.vertical_force;
  p.longitudinal_force = input.longitudinal_force;
  p.roller = input.roller;
  p.rail_springs = input.rail_springs;
  p.damping = input.damping;
  p.regime = input.regime;
  p.history = input.history;
  p.enforce_step_rule = input.conventions != Conventions::contact;
  p.reference_surface = input.reference_surface;

  const io::DiscretisationInput& d = input.discretisation;
  constexpr int kInitialContactPoint = 7;
  static_cast<ElementGrid&>(p.discretisation) = d;
  p.discretisation.reference_at_deepest = d.method == kInitialContactPoint;
  p.discretisation.search = search_grid(d, round_wheel);
  p.discretisation.search_method = search_method(d);
  p.discretisation.detector = d.detector;

  p.material = input.material;
  p.friction = input.friction;
  const io::FrictionVariation& variation = input.friction_variation;
  if (variation.kind == io::FrictionVariation::Kind::inclination) {
    p.friction_inclination = variation.positions;
    p.friction_laws = variation.laws;
  } else if (variation.kind == io::FrictionVariation::Kind::along_track) {
    p.friction = friction_of(input, 0.0);
  }
  p.normal_model = input.normal_model;
  p.tangential_model = input.tangential_model;
  p.fastsim = input.fastsim;
  p.influence = to_influence(input.influence);
  p.solver = input.solver;
  p.solver.conventions = d.conventions;
  p.max_force_iterations = input.solver.max_force;
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
  const double inclination = input.side == Side::left ? -contact_angle : contact_angle;
  return friction_at(v.positions, v.laws, v.kind == Kind::inclination ? inclination : input.state.position.x,
                     input.friction);
}

const io::WheelRailCase* first_wheelrail_case(const io::CaseFile& file) {
  for (const io::Case& c : file.cases)
    if (const auto* input = std::get_if<io::WheelRailCase>(&c.content)) return input;
  return nullptr;
}

void require_registered(const io::CaseFile& file) {
  const auto require = [](const io::SurfaceSource& source) {
    if (!source.backend.empty()) require_backend(source.backend);
  };
  for (const io::Case& one : file.cases) {
    const auto* c = std::get_if<io::WheelRailCase>(&one.content);
    if (c == nullptr) continue;
    for (const io::SurfaceSource* body : {&c->wheel, &c->rail}) {
      require(*body);
      for (const io::SurfaceSource& part : body->parts) require(part);
    }
    if (!c->discretisation.detector.empty()) detection::detector_of(c->discretisation.detector);
  }
}

io::CaseFile read_registered_case(const std::string& file, const std::vector<std::string>& overrides) {
  io::CaseFile out = io::read_any_case(file, overrides);
  require_registered(out);
  return out;
}

}  // namespace treadmark::app
