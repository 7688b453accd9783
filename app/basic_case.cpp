// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/basic_case.hpp"

#include <chrono>
#include <limits>

#include "treadmark/app/derived_results.hpp"
#include "treadmark/app/gap_formula.hpp"
#include "treadmark/app/patch_result.hpp"
#include "treadmark/app/planform.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/solvers/kalker/normal/semi_double_elliptic.hpp"

namespace treadmark::app {
namespace {

kalker::HertzShape hertz_shape(const io::BasicCase& input, const io::HertzInput& h) {
  const CombinedMaterial material = combine(input.material);
  const kalker::HertzLoad load{input.normal_force_prescribed,
                               input.normal_force_prescribed ? input.normal_force : input.approach};
  switch (h.given) {
    case io::HertzInput::Given::curvatures:
      return kalker::hertz_from_curvatures(h.a1, h.b1, load, material);
    case io::HertzInput::Given::curvature_and_ratio:
      return kalker::hertz_from_curvature_and_ratio(h.a1, h.aob, load, material);
    case io::HertzInput::Given::semi_axes:
      return kalker::hertz_from_semi_axes(h.aa, h.bb, load, material);
    case io::HertzInput::Given::line_curvature:
      return kalker::hertz_line_from_curvature(h.a1, h.bb, load, material);
    case io::HertzInput::Given::line_semi_axis:
      return kalker::hertz_line_from_semi_axis(h.aa, h.bb, load, material);
    case io::HertzInput::Given::semi_double_elliptic:
      return kalker::hertz_semi_double_elliptic(h.aa, h.bb_negative, h.bb_positive, load, material);
  }
  return {};
}

double timed(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The problem of a case; the gap is kept beside it.
struct PosedProblem {
  kalker::ContactProblem problem;
  std::vector<double> gap;
};

PosedProblem pose(const io::BasicCase& input) {
  PosedProblem out;
  kalker::ContactProblem& p = out.problem;
  if (const auto* h = std::get_if<io::HertzInput>(&input.geometry)) {
    p.hertz = hertz_shape(input, *h);
    p.grid = kalker::hertz_grid(*p.hertz, input.mx, input.my, h->scale);
    out.gap = kalker::hertz_gap(*p.hertz, p.grid);
  } else {
    p.grid = {input.x0, input.y0, input.dx, input.dy, input.mx, input.my};
    out.gap = gap_of_formula(std::get<io::GapInput>(input.geometry), p.grid);
  }
  restrict_contact(input.planform, p.grid, out.gap, p.sub_patches);
  p.gap = out.gap;
  p.material = input.material;
  p.friction = input.friction;
  p.force_prescribed = input.normal_force_prescribed;
  p.normal_force = input.normal_force;
  p.approach = input.approach;
  p.regime = input.regime;
  p.creepage = {input.xi, input.eta, input.phi, input.spin_x, input.spin_y};
  p.rolling = {input.chi, input.velocity, input.dq, input.spin_offset_factor};
  p.fx_relative = input.fx_relative;
  p.fy_relative = input.fy_relative;
  p.normal_model = input.normal_model;
  p.tangential_model = input.tangential_model;
  p.fastsim = input.fastsim;
  p.settings = input.solver;
  p.influence = to_influence(input.influence);
  p.history = input.history;
  p.friction_of_row = input.friction_of_row;
  p.extra_slip_x = input.extra_slip_x;
  p.extra_slip_y = input.extra_slip_y;
  p.thermal = input.thermal;
  p.sensitivities = input.sensitivities;
  return out;
}

}  // namespace

io::CaseResult BasicSequence::solve(const io::BasicCase& input) {
  PosedProblem posed = pose(input);
  const kalker::ContactProblem& p = posed.problem;
  kalker::ContactSolution solution;
  io::CaseResult result;
  result.normal_s = timed([&] { solution = solver_.solve_normal(p); });
  result.normal_solves = 1;
  result.status = solution.status;
  result.tangential_s = timed([&] { solver_.solve_tangential(p, solution); });
  if (solution.status == Status::no_contact) {
    result.status = Status::no_contact;
    result.message = "the bodies do not touch";
    return result;
  }
  result.tangential_solves = p.regime == kalker::Regime::frictionless ? 0 : 1;
  for (const Report* report : {&solution.normal, &solution.tangential})
    if (report->status != Status::ok) {
      result.status = report->status;
      result.message = report->message.empty() ? "the contact problem did not converge" : report->message;
      break;
    }

  io::PatchResult r = patch_result(solution, p.grid, posed.gap, input.material, input.friction);
  const bool rolling = input.regime == Regime::steady || input.regime == Regime::transient;
  r.shift = !rolling;  // without rolling there is work, not power
  r.has_rolling = rolling;
  r.chi = input.chi;
  r.dq = solution.rolling_step;
  r.velocity = input.velocity;
  r.xi = solution.creepage.xi;
  r.eta = solution.creepage.eta;
  r.phi = solution.creepage.phi;
  add_dissipation(r);
  add_subsurface(input.subsurface, input.material, p.grid, solution, r);
  result.patches.push_back(std::move(r));
  return result;
}

}  // namespace treadmark::app
