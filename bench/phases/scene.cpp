// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/phases/scene.hpp"

#include <map>
#include <stdexcept>
#include <string>

#include "treadmark/backends/create.hpp"
#include "treadmark/solvers/wheelrail/search_window.hpp"

namespace treadmark::bench {
namespace {

Scene make_scene(std::string_view backend) {
  SurfaceSpec wheel;
  wheel.body = Body::wheel;
  wheel.nominal_radius = 0.49;
  wheel.shape = StandardProfile{"S1002"};
  WheelFlat flat;
  flat.length = 0.16;
  flat.depth = 1.4e-3;
  flat.y_center = 6e-3;
  flat.width = 60e-3;
  wheel.defects.flats = {flat};
  SurfaceSpec rail;
  rail.shape = StandardProfile{"60E1"};

  Scene s;
  s.geometry = {create_surface(rail), create_surface(wheel, backend), false};
  wheelrail::Problem& p = s.problem;
  p.track.cant = 1.0 / 40.0;
  p.wheelset.nominal_radius = 0.49;
  p.state.position.pitch = 0.06;
  p.state.velocity = {2.0, 0.0, 0.0, 0.0, 0.0, -2.0 / 0.49};
  p.vertical_force = 1.25e5;
  p.discretisation.dx = p.discretisation.ds = 0.4e-3;
  wheelrail::Pair pair(s.geometry);
  s.solution = pair.solve(p);
  if (s.solution.status != Status::ok || s.solution.patches.empty())
    throw std::runtime_error("the benchmark scene could not be solved: " + s.solution.message);
  s.bodies = {s.geometry.rail.get(), s.geometry.wheel.get(), s.solution.placement.X_TS, s.solution.placement.X_TA};
  s.search = wheelrail::search_settings(s.geometry, p, s.solution.placement);
  return s;
}

}  // namespace

const Scene& scene(std::string_view backend) {
  static std::map<std::string, Scene, std::less<>> scenes;
  const auto found = scenes.find(backend);
  return found != scenes.end() ? found->second : scenes.emplace(std::string(backend), make_scene(backend)).first->second;
}

kalker::ContactProblem patch_problem(const Scene& s) {
  const wheelrail::PatchSolution& patch = s.solution.patches.front();
  kalker::ContactProblem c;
  c.grid = patch.grid;
  c.gap = patch.distance;
  c.material = s.problem.material;
  c.friction = s.problem.friction;
  c.force_prescribed = false;
  c.approach = patch.approach;
  c.regime = kalker::Regime::steady;
  c.creepage.xi = patch.kinematics.xi;
  c.creepage.eta = patch.kinematics.eta;
  c.creepage.phi = patch.kinematics.phi;
  c.rolling.velocity = patch.kinematics.velocity;
  c.rolling.step = patch.grid.dx;
  return c;
}

}  // namespace treadmark::bench
