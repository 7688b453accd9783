// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/cases/basic_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "treadmark/app/cases/wheelrail_result.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/stopwatch.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/solvers/kalker/plausibility.hpp"
#include "treadmark/solvers/kalker/refinement.hpp"
#include "treadmark/solvers/kalker/tangential/rigid_slip.hpp"

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

}  // namespace

std::optional<kalker::HertzShape> hertz_shape(const io::BasicCase& input) {
  const auto* hertz = std::get_if<io::HertzInput>(&input.geometry);
  return hertz != nullptr ? std::optional(hertz_shape(input, *hertz)) : std::nullopt;
}

namespace {

/// The problem of a case; gap and slip are kept beside it.
struct PosedProblem {
  kalker::ContactProblem problem;
  std::vector<double> gap, slip_x, slip_y;
};

/// Takes the slip by spin out of one direction, as an extra rigid slip that is its opposite.
void remove_spin_slip(const io::BasicCase& input, PosedProblem& posed) {
  kalker::ContactProblem& p = posed.problem;
  if (input.spin_slip == io::SpinSlip::both || input.phi == 0.0 || p.regime == Regime::frictionless) return;
  const bool lateral = input.spin_slip == io::SpinSlip::longitudinal;
  const kalker::RollingStep step = kalker::rolling_step(p);
  const double ahead_x = p.rolling.spin_offset_factor * step.shift_x,
               ahead_y = p.rolling.spin_offset_factor * step.shift_y;
  posed.slip_x.assign(input.extra_slip_x.begin(), input.extra_slip_x.end());
  posed.slip_y.assign(input.extra_slip_y.begin(), input.extra_slip_y.end());
  for (auto* slip : {&posed.slip_x, &posed.slip_y}) slip->resize(p.grid.size(), 0.0);
  for (int iy = 0; iy < p.grid.ny; ++iy)
    for (int ix = 0; ix < p.grid.nx; ++ix) {
      const std::size_t i = p.grid.index(ix, iy);
      if (lateral)
        posed.slip_y[i] -= input.phi * (p.grid.x(ix) - input.spin_x + ahead_x);
      else
        posed.slip_x[i] += input.phi * (p.grid.y(iy) - input.spin_y + ahead_y);
    }
  p.extra_slip_x = posed.slip_x;
  p.extra_slip_y = posed.slip_y;
}

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
  p.settings.conventions = input.conventions;
  p.influence = to_influence(input.influence);
  p.history = input.history;
  p.friction_of_row = input.friction_of_row;
  p.extra_slip_x = input.extra_slip_x;
  p.extra_slip_y = input.extra_slip_y;
  remove_spin_slip(input, out);
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
  {
    const Stopwatch watch(result.normal_s);
    solution = solver_.solve_normal(p);
  }
  result.normal_solves = 1;
  result.status = solution.status;
  {
    const Stopwatch watch(result.tangential_s);
    solver_.solve_tangential(p, solution);
  }
  if (solution.status == Status::no_contact) {
    result.status = Status::no_contact;
    result.message = "the bodies do not touch";
    if (p.force_prescribed)
      result.remarks.push_back({RemarkKind::no_contact_under_load, 0,
                                "a normal force is prescribed and the bodies do not touch: does it press them "
                                "together, and may any element touch?"});
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
  // What is posed without bodies may be dimensionless; of what has the stiffness of a solid, a line contact of 0.1 E'
  // has a half-width of a fifth of its radius (Johnson 1985, eq. 4.45). What yields like steel is as stiff as a metal.
  constexpr double kSoftestSolid = 0.1e9, kNotSmall = 0.1, kSoftestMetal = 10e9, kYields = 0.03;
  const double modulus = kalker::contact_modulus(p.material);
  kalker::judge({p.grid, p.material, p.friction.static_friction(), rolling, p.regime == Regime::shift,
                 modulus < kSoftestSolid ? kInfinity : kNotSmall * modulus,
                 modulus < kSoftestMetal ? kInfinity : kYields * modulus, input.grid_border == io::GridBorder::closed,
                 p.normal_model, p.tangential_model, p.fastsim.flexibility},
                solution, 1, result.remarks);
  const kalker::Refinement refinement = kalker::estimate_refinement(p, solution, p.force_prescribed, coarse_solver_);
  r.refinement = {refinement.pressure, refinement.area, refinement.force};
  kalker::judge_refinement(refinement, 1, result.remarks);
  if (result.status == Status::ok && p.force_prescribed)
    kalker::judge_force("normal force", p.normal_force, solution.force_n, result.remarks,
                        p.normal_model == NormalModel::full
                            ? ""
                            : "the pressure follows a formula and is summed over elements, take smaller ones");
  result.patches.push_back(std::move(r));
  return result;
}

namespace {

double quadratic(const std::vector<double>& b, double x, double y) {
  return b[0] * x * x + b[1] * x * y + b[2] * y * y + b[3] * x + b[4] * y + b[5];
}

double circular(const std::vector<double>& b, double x, double y) {
  constexpr std::size_t kFirstHeight = 4;
  const double x_middle = b[0], radius = b[1], y_first = b[2], step = b[3];
  const std::size_t count = b.size() - kFirstHeight;
  double height = b[kFirstHeight];
  if (count > 1) {
    const double position = (y - y_first) / step;
    const auto k = to_whole<std::size_t>(std::clamp(std::floor(position), 0.0, static_cast<double>(count - 2)));
    const double fraction = position - static_cast<double>(k);
    height = (1.0 - fraction) * b[kFirstHeight + k] + fraction * b[kFirstHeight + k + 1];
  }
  return height + (x - x_middle) * (x - x_middle) / (2.0 * radius);
}

double sinusoidal(const std::vector<double>& b, double x, double y) {
  return b[0] * std::sin(b[1] * (x - b[2])) - b[3] * std::sin(b[4] * (x - b[5])) + x * x / b[6] + y * y / b[7];
}

}  // namespace

std::vector<double> gap_of_formula(const io::GapInput& input, const Grid2& grid) {
  using Kind = io::GapInput::Kind;
  const std::vector<double>& b = input.coefficients;
  const bool fits = input.kind == Kind::quadratic    ? b.size() == 6
                    : input.kind == Kind::circular   ? b.size() >= 5
                    : input.kind == Kind::sinusoidal ? b.size() == 8
                                                     : b.size() == grid.size();
  if (!fits)
    throw Error(ErrorKind::configuration, "the undeformed distance has " + std::to_string(b.size()) + " coefficients");
  if (input.kind == Kind::per_element) return b;
  std::vector<double> gap;
  gap.reserve(grid.size());
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double x = grid.x(ix), y = grid.y(iy);
      gap.push_back(input.kind == Kind::quadratic  ? quadratic(b, x, y)
                    : input.kind == Kind::circular ? circular(b, x, y)
                                                   : sinusoidal(b, x, y));
    }
  return gap;
}

namespace {

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

/// Number from 1 of the first rectangle that holds a point; 0: none.
std::size_t rectangle_at(const std::vector<double>& rectangles, double x, double y) {
  for (std::size_t k = 0; 4 * k + 3 < rectangles.size(); ++k)
    if (x >= rectangles[4 * k] && x <= rectangles[4 * k + 1] && y >= rectangles[4 * k + 2] &&
        y <= rectangles[4 * k + 3])
      return k + 1;
  return 0;
}

}  // namespace

void restrict_contact(const io::PlanformInput& input, const Grid2& grid, std::vector<double>& gap,
                      kalker::SubPatches& sub_patches) {
  using Kind = io::PlanformInput::Kind;
  if (input.kind == Kind::free) return;
  const std::vector<double>& c = input.coefficients;
  const bool parts = input.kind == Kind::sub_patches;
  if (parts) {
    sub_patches.count = static_cast<int>(c.size() / 4);
    sub_patches.part.assign(grid.size(), 0);
    sub_patches.coupling = input.coupling;
  }
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double x = grid.x(ix), y = grid.y(iy);
      const std::size_t i = grid.index(ix, iy);
      if (input.kind == Kind::quadratic) {
        if (c[0] * x * x + c[1] * x * y + c[2] * y * y + c[3] * x + c[4] * y + c[5] >= 0.0) gap[i] = kNever;
        continue;
      }
      const std::size_t part = rectangle_at(c, x, y);
      if (part == 0) gap[i] = kNever;
      if (parts) sub_patches.part[i] = static_cast<std::uint8_t>(part);
    }
}

}  // namespace treadmark::app
