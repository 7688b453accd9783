// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/interfaces/contact/sensitivities.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/interfaces/contact/log.hpp"

namespace treadmark::contact {
namespace {

/// The patch by itself, pressed together as it is, with its creepages given.
io::BasicCase patch_alone(const Problem& p, const io::PatchResult& r) {
  io::BasicCase b;
  if (p.module == 3) {
    b = std::get<io::BasicCase>(p.previous->content);
  } else {
    const auto& c = std::get<io::WheelRailCase>(p.previous->content);
    const Grid2& g = r.fields.grid;
    b.mx = g.nx, b.my = g.ny, b.x0 = g.x0, b.y0 = g.y0, b.dx = g.dx, b.dy = g.dy;
    b.geometry = io::GapInput{io::GapInput::Kind::per_element, r.fields.gap};
    b.spin_x = r.reference_x, b.spin_y = r.reference_s;
    b.extra_slip_x = r.fields.extra_slip_x, b.extra_slip_y = r.fields.extra_slip_s;
    b.regime = c.regime;
    b.tangential_model = c.tangential_model;
    b.fastsim = c.fastsim;
    b.normal_model = c.normal_model;
    b.chi = r.chi, b.dq = r.dq, b.velocity = r.velocity;
    b.material = c.material;
    b.friction = app::friction_of(c, r.angle);
    b.solver = c.solver;
    b.conventions = c.conventions;
    b.thermal = c.thermal;
    b.influence.kind = c.influence.kind;
    b.normal_force_prescribed = false;
    b.approach = r.approach;
  }
  b.fx_relative.reset();
  b.fy_relative.reset();
  b.xi = r.xi, b.eta = r.eta, b.phi = r.phi;
  b.sensitivities = false;
  b.subsurface = {};
  b.history = HistoryUse::start;
  constexpr double kFine = 1e-8;
  b.solver.eps = std::min(b.solver.eps, kFine);
  return b;
}

/// dM_n by xi, eta, phi [N m, N m, N m^2].
std::array<double, 3> moment_row(const Problem& p, const io::PatchResult& r) {
  std::array<double, 3> row{};
  io::BasicCase alone = patch_alone(p, r);
  if (alone.regime != Regime::steady || !r.fields.row_angle.empty()) return row;
  app::BasicSequence solver;
  // Parts of a patch that hardly feel each other are not told here: then it is another problem.
  constexpr double kSame = 1e-3;
  const io::CaseResult again = solver.solve(alone);
  if (again.status != Status::ok || again.patches.empty() || std::abs(again.patches.front().fn - r.fn) > kSame * r.fn ||
      std::hypot(again.patches.front().fx - r.fx, again.patches.front().fs - r.fs) > kSame * r.fn) {
    warn("WARNING: the sensitivities of the moment of this patch are not computed, they are 0");
    return row;
  }
  const double size = std::sqrt(r.ncon * r.fields.grid.cell_area());
  const double creepage = std::hypot(r.xi, r.eta, r.phi * size);
  constexpr double kShare = 1e-3, kLeast = 1e-7;
  const double step = std::max(kShare * creepage, kLeast);
  double* const inputs[] = {&alone.xi, &alone.eta, &alone.phi};
  const double steps[] = {step, step, step / size};
  for (std::size_t k = 0; k < row.size(); ++k) {
    const double middle = *inputs[k];
    double moment[2] = {0.0, 0.0};
    for (const int side : {0, 1}) {
      *inputs[k] = middle + (side == 0 ? -steps[k] : steps[k]);
      const io::CaseResult found = solver.solve(alone);
      if (found.status != Status::ok || found.patches.empty()) return {};
      moment[side] = found.patches.front().mn;
    }
    *inputs[k] = middle;
    row[k] = (moment[1] - moment[0]) / (2.0 * steps[k]);
  }
  return row;
}

/// What forces are related to.
double friction_force(const Problem& p, const io::PatchResult& r) {
  if (p.module == 3) return std::get<io::BasicCase>(p.previous->content).friction.static_friction() * r.fn;
  const auto& c = std::get<io::WheelRailCase>(p.previous->content);
  const bool varies = c.friction_variation.kind == io::FrictionVariation::Kind::inclination;
  return varies ? r.fn : app::friction_of(c, r.angle).static_friction() * r.fn;
}

}  // namespace

SensitivityMatrix sensitivities(const Problem& p, const io::PatchResult& r, bool with_moment) {
  constexpr int kTangential = 3;
  SensitivityMatrix m{};
  if (!r.sensitivities || !p.previous) return m;
  const Units& u = p.units;
  const bool shift = r.shift && p.flags[CNTC_ic_tang] == 1;
  // One unit of the caller's creepages in SI.
  const double unit[] = {shift ? u.length : 1.0, shift ? u.length : 1.0, shift ? 1.0 : u.curvature()};
  m[0][0] = r.sensitivities->by_approach[0] * u.length;
  const double bound = friction_force(p, r);
  if (p.flags[CNTC_ic_sens] < kTangential || !(bound > 0.0)) return m;
  const std::array<double, 3> moment = with_moment ? moment_row(p, r) : std::array<double, 3>{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& by = r.sensitivities->by_creepage[k];
    m[1][k + 1] = by[0] * unit[k] / bound;
    m[2][k + 1] = by[1] * unit[k] / bound;
    m[3][k + 1] = moment[k] * unit[k] / u.moment();
  }
  return m;
}

}  // namespace treadmark::contact
