// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/phases/solved_case.hpp"

#include <map>
#include <stdexcept>
#include <string>
#include <variant>

#include "treadmark/app/bench/bench_case.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"

namespace treadmark::bench {
namespace {

SolvedCase solve(std::string_view backend, bool flat = true, double element = 0.0) {
  const io::CaseFile file = app::bench_case();
  auto input = std::get<io::WheelRailCase>(file.cases.front().content);
  input.rail.defects = {};
  if (!flat) input.wheel.defects = {};
  if (element > 0.0) input.discretisation.dx = input.discretisation.ds = element;
  const NaturalSurface rail = app::read_surface(input.rail, Body::rail, app::profile_radius(input, Body::rail)),
                       wheel = app::read_surface(input.wheel, Body::wheel, app::profile_radius(input, Body::wheel));
  SolvedCase s;
  s.geometry = {rail.surface, represent(wheel, {std::string(backend), 0.0, {}}).surface, !flat, !flat};
  s.problem = app::to_problem(input, !flat);
  s.solution = wheelrail::Pair(s.geometry).solve(s.problem);
  if (s.solution.status != Status::ok || s.solution.patches.empty())
    throw std::runtime_error("the case of the benchmark could not be solved: " + s.solution.message);
  return s;
}

}  // namespace

const SolvedCase& solved_case(std::string_view backend) {
  static std::map<std::string, SolvedCase, std::less<>> known;
  const auto found = known.find(backend);
  return found != known.end() ? found->second : known.emplace(std::string(backend), solve(backend)).first->second;
}

const SolvedCase& solved_case_of_half_a_millimetre(bool flat) {
  constexpr double kElement = 0.5e-3;
  static const SolvedCase round = solve("analytic", false, kElement), flattened = solve("analytic", true, kElement);
  return flat ? flattened : round;
}

kalker::ContactProblem patch_problem(const SolvedCase& s) {
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
