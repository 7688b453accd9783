// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/basic_case.hpp"

#include <chrono>

#include "treadmark/app/gap_formula.hpp"
#include "treadmark/app/patch_result.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"

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
      break;
  }
  return {};
}

kalker::NormalModel normal_model(io::NormalModelInput model) {
  switch (model) {
    case io::NormalModelInput::full:
      return kalker::NormalModel::full;
    case io::NormalModelInput::elliptic:
      return kalker::NormalModel::elliptic;
    case io::NormalModelInput::parabolic:
      return kalker::NormalModel::parabolic;
    case io::NormalModelInput::semi_double_elliptic:
      return kalker::NormalModel::semi_double_elliptic;
    case io::NormalModelInput::kpec:
      return kalker::NormalModel::kpec;
    case io::NormalModelInput::analyn:
      return kalker::NormalModel::analyn;
  }
  return kalker::NormalModel::full;
}

kalker::Regime regime(io::RegimeInput input) {
  switch (input) {
    case io::RegimeInput::none:
      return kalker::Regime::frictionless;
    case io::RegimeInput::shift:
      return kalker::Regime::shift;
    case io::RegimeInput::transient:
      return kalker::Regime::transient;
    case io::RegimeInput::steady:
      return kalker::Regime::steady;
  }
  return kalker::Regime::frictionless;
}

double timed(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

io::CaseResult solve_basic_case(const io::BasicCase& input) {
  kalker::ContactProblem p;
  std::vector<double> gap;
  if (const auto* h = std::get_if<io::HertzInput>(&input.geometry)) {
    p.hertz = hertz_shape(input, *h);
    p.grid = kalker::hertz_grid(*p.hertz, input.mx, input.my, h->scale);
    gap = kalker::hertz_gap(*p.hertz, p.grid);
  } else {
    p.grid = {input.x0, input.y0, input.dx, input.dy, input.mx, input.my};
    gap = gap_of_formula(std::get<io::GapInput>(input.geometry), p.grid);
  }
  p.gap = gap;
  p.material = input.material;
  p.friction = input.friction;
  p.force_prescribed = input.normal_force_prescribed;
  p.normal_force = input.normal_force;
  p.approach = input.approach;
  p.regime = regime(input.regime);
  p.creepage = {input.xi, input.eta, input.phi, input.spin_x, input.spin_y};
  p.rolling = {input.chi, input.velocity, input.dq, input.spin_offset_factor};
  p.fx_relative = input.fx_relative;
  p.fy_relative = input.fy_relative;
  p.normal_model = normal_model(input.normal_model);
  p.tangential_model = input.tangential_model == io::TangentialModelInput::fastsim ? kalker::TangentialModel::fastsim
                                                                                    : kalker::TangentialModel::full;
  p.fastsim = {input.fastsim_k0, input.fastsim_alpha, input.fastsim_beta};
  p.settings = to_solver_settings(input.solver);

  kalker::ContactSolver solver;
  kalker::ContactSolution solution;
  io::CaseResult result;
  result.normal_s = timed([&] { solution = solver.solve_normal(p); });
  result.normal_solves = 1;
  result.status = solution.status;
  if (solution.status == Status::no_contact) {
    result.message = "the bodies do not touch";
    return result;
  }
  result.tangential_s = timed([&] { solver.solve_tangential(p, solution); });
  result.tangential_solves = p.regime == kalker::Regime::frictionless ? 0 : 1;
  for (const Report* report : {&solution.normal, &solution.tangential})
    if (report->status != Status::ok) {
      result.status = report->status;
      result.message = report->message.empty() ? "the contact problem did not converge" : report->message;
      break;
    }

  io::PatchResult r = patch_result(solution, p.grid, gap, input.material, input.friction);
  r.shift = input.regime != io::RegimeInput::steady;  // without rolling there is work, not power
  r.has_rolling = input.regime == io::RegimeInput::steady;
  r.chi = input.chi;
  r.dq = solution.rolling_step;
  r.velocity = input.velocity;
  r.xi = solution.creepage.xi;
  r.eta = solution.creepage.eta;
  r.phi = solution.creepage.phi;
  result.patches.push_back(std::move(r));
  return result;
}

}  // namespace treadmark::app
