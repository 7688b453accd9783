// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/contact_solver.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/model/contact/theories.hpp"
#include "treadmark/model/magnitudes.hpp"
#include "treadmark/solvers/kalker/fastsim/fastsim.hpp"
#include "treadmark/solvers/kalker/heat/surface_temperature.hpp"
#include "treadmark/solvers/kalker/invariants.hpp"
#include "treadmark/solvers/kalker/normal/sub_patch_solver.hpp"
#include "treadmark/solvers/kalker/solver_state.hpp"

namespace treadmark::kalker {

namespace {

/// Normal and tangential problem agree when tractions change by no more than this many eps.
constexpr double kAgreement = 5.0;
/// Relative change of temperatures at which friction fits them.
constexpr double kSameTemperature = 1e-5;

/// Errors: Error(configuration) for a number beyond the magnitudes that are taken.
void check_magnitudes(const ContactProblem& problem) {
  const auto require = [](double value, double greatest, const char* name) {
    if (std::isfinite(value) && std::abs(value) > greatest)  // others are refused where they are used
      throw Error(ErrorKind::configuration,
                  fmt::format("{} is {:g}, beyond the greatest magnitude that is taken, {:g}", name, value, greatest));
  };
  const auto friction = [&](const FrictionLaw& law) {
    for (const double value : {law.kinetic, law.amplitude_1, law.amplitude_2, law.temperature_change})
      require(value, kMostFriction, "a coefficient of friction");
  };
  friction(problem.friction);
  for (const FrictionLaw& law : problem.friction_of_row) friction(law);
  if (problem.regime == Regime::frictionless) return;
  const Creepage& c = problem.creepage;
  for (const double value : {c.xi, c.eta, c.phi}) require(value, kMostCreepage, "a creepage");
  for (const std::span<const double> slip : {problem.extra_slip_x, problem.extra_slip_y})
    for (const double value : slip) require(value, kMostCreepage, "a given slip");
  if (problem.regime == Regime::shift) return;
  require(problem.rolling.velocity, kMostSpeed, "the rolling velocity");
  require(problem.rolling.step, kMostStep, "the rolling step");
}

void empty_tangential_fields(const ContactProblem& problem, ContactSolution& solution) {
  for (auto* field : {&solution.traction_x, &solution.traction_y, &solution.displacement_x, &solution.displacement_y,
                      &solution.slip_x, &solution.slip_y})
    field->assign(problem.grid.size(), 0.0);
  solution.friction.assign(problem.grid.size(), problem.friction.static_friction());
  solution.creepage = problem.creepage;
}

/// Change of all tractions relative to their size.
double relative_change(const ContactSolution& before, const ContactSolution& after) {
  double change = 0.0, size = 0.0;
  for (const auto field : {&ContactSolution::pressure, &ContactSolution::traction_x, &ContactSolution::traction_y}) {
    const auto &a = before.*field, &b = after.*field;
    for (std::size_t i = 0; i < b.size(); ++i) {
      const double d = b[i] - (a.empty() ? 0.0 : a[i]);
      change += d * d;
      size += b[i] * b[i];
    }
  }
  return size > 0.0 ? std::sqrt(change / size) : 0.0;
}

}  // namespace

struct ContactSolver::Workspace {
  NormalSolver normal;
  SubPatchSolver sub_patches;
  TangentialSolver tangential;
  ContactHistory previous, last;  ///< the instant before the last one, and the last one

  void solve_normal(const ContactProblem& problem, ContactSolution& solution) {
    if (problem.sub_patches.count > 1)
      sub_patches.solve(problem, solution);
    else
      normal.solve(problem, solution);
  }
  void choose_previous(const ContactProblem& problem);
  void solve_once(const ContactProblem& problem, ContactSolution& solution);
  void solve_warm(const ContactProblem& problem, ContactSolution& solution);
  void solve_in_turns(const ContactProblem& problem, ContactSolution& solution);
};

ContactSolver::ContactSolver() : workspace_(std::make_unique<Workspace>()) {}
ContactSolver::~ContactSolver() = default;
ContactSolver::ContactSolver(ContactSolver&&) noexcept = default;
ContactSolver& ContactSolver::operator=(ContactSolver&&) noexcept = default;

void ContactSolver::reset() {
  workspace_->normal.reset();
  workspace_->sub_patches.reset();
  workspace_->tangential.reset();
  workspace_->previous = workspace_->last = {};
}

std::shared_ptr<const ContactSolver::State> ContactSolver::save() const {
  const Workspace& w = *workspace_;
  auto state = std::make_shared<State>();
  state->previous = w.previous;
  state->last = w.last;
  state->normal = w.normal.start();
  state->sub_patches = w.sub_patches.start();
  state->tangential = w.tangential.start();
  return state;
}

void ContactSolver::restore(const std::shared_ptr<const State>& state) {
  if (!state) return reset();
  Workspace& w = *workspace_;
  w.previous = state->previous;
  w.last = state->last;
  w.normal.start_from(state->normal);
  w.sub_patches.start_from(state->sub_patches);
  w.tangential.start_from(state->tangential);
}

const ContactHistory& ContactSolver::history() const { return workspace_->last; }

void ContactSolver::continue_from(ContactHistory instant) { workspace_->last = std::move(instant); }

void ContactSolver::Workspace::choose_previous(const ContactProblem& problem) {
  switch (problem.history) {
    case HistoryUse::start:
      previous = {};
      break;
    case HistoryUse::keep_going:
      previous = last;
      break;
    case HistoryUse::normal_only:
      previous = last;
      for (auto* field : {&previous.traction_x, &previous.traction_y, &previous.plastic_x, &previous.plastic_y,
                          &previous.layer_x, &previous.layer_y})
        std::fill(field->begin(), field->end(), 0.0);
      previous.friction.clear();
      previous.yield_stress.clear();
      break;
    case HistoryUse::same_instant:
      break;
  }
  if (problem.regime == Regime::shift || problem.regime == Regime::transient)
    previous = averaged_on(previous, problem.grid, problem.friction.static_friction(), problem.material.layer_yield);
}

/// The tangential tractions push the surfaces apart or together, the pressures move them tangentially.
void ContactSolver::Workspace::solve_in_turns(const ContactProblem& problem, ContactSolution& solution) {
  ContactProblem moved = problem;
  std::vector<double> gap;
  double change = 0.0;
  for (int round = 1;; ++round) {
    check_cancelled();
    const ContactSolution before = solution;
    if (round > 1) {
      const std::vector<double> by_traction = tangential.normal_displacement(problem, solution);
      gap.assign(problem.gap.begin(), problem.gap.end());
      for (std::size_t i = 0; i < gap.size(); ++i) gap[i] += by_traction[i];
      moved.gap = gap;
      solve_normal(moved, solution);
      for (std::size_t i = 0; i < gap.size(); ++i) solution.displacement_n[i] += by_traction[i];
      if (solution.status == Status::no_contact) return empty_tangential_fields(problem, solution);
      solution.traction_x = before.traction_x;  // of the last round, until the new ones are there
      solution.traction_y = before.traction_y;
    }
    tangential.solve(problem, solution, previous);
    if (problem.settings.max_coupling <= 1) return;
    if (round > 1) {
      const double earlier = std::exchange(change, relative_change(before, solution));
      if (change <= kAgreement * problem.settings.eps) return;
      // The rounds contract: what all further ones would change together.
      constexpr double kContracting = 0.5;
      const double rate = round > 2 ? change / earlier : 1.0;
      if (rate < kContracting && change * rate / (1.0 - rate) <= kAgreement * problem.settings.eps) return;
    }
    if (round >= problem.settings.max_coupling) break;
  }
  if (solution.tangential.status == Status::ok) {
    solution.tangential.status = Status::not_converged;
    solution.tangential.message =
        fmt::format("normal and tangential problem still change each other by {:.2g} after {} rounds", change,
                    problem.settings.max_coupling);
  }
}

void ContactSolver::Workspace::solve_once(const ContactProblem& problem, ContactSolution& solution) {
  if (theory(problem.tangential_model).limits.springs)
    solve_fastsim(problem, solution, previous);
  else if (tangential.couples(problem))
    solve_in_turns(problem, solution);
  else
    tangential.solve(problem, solution, previous);
}

/// With surface temperatures, in turns with friction that depends on them.
void ContactSolver::Workspace::solve_warm(const ContactProblem& problem, ContactSolution& solution) {
  const auto by_temperature = [](const FrictionLaw& law) { return law.kind == FrictionLaw::Kind::temperature; };
  const std::vector<FrictionLaw>& rows = problem.friction_of_row;
  const bool depends =
      rows.empty() ? by_temperature(problem.friction) : std::any_of(rows.begin(), rows.end(), by_temperature);
  if (!depends || !problem.thermal) {
    solve_once(problem, solution);
    if (problem.thermal) add_surface_temperatures(problem, solution);
    return;
  }
  std::vector<double> temperature(problem.grid.size(), problem.thermal->body_1.bulk_temperature);
  double relaxation = 1.0, last_change = 0.0;
  for (int round = 1;; ++round) {
    check_cancelled();
    solution.temperature_1 = temperature;
    solve_once(problem, solution);
    if (solution.status == Status::no_contact || solution.tangential.status != Status::ok) return;
    add_surface_temperatures(problem, solution);
    double change = 0.0, size = 0.0;
    for (std::size_t i = 0; i < temperature.size(); ++i) {
      const double d = solution.temperature_1[i] - temperature[i];
      change += d * d;
      size += solution.temperature_1[i] * solution.temperature_1[i];
    }
    if (change <= kSameTemperature * kSameTemperature * size) return;
    if (round >= problem.settings.max_outer) {
      solution.tangential.status = Status::not_converged;
      solution.tangential.message =
          "friction did not converge with temperature in " + std::to_string(round) + " rounds";
      return;
    }
    if (round > 1 && change > 0.8 * last_change) relaxation = std::max(0.05, 0.5 * relaxation);
    last_change = change;
    for (std::size_t i = 0; i < temperature.size(); ++i)
      temperature[i] += relaxation * (solution.temperature_1[i] - temperature[i]);
  }
}

ContactSolution ContactSolver::solve_normal(const ContactProblem& problem) {
  ContactSolution solution;
  workspace_->solve_normal(problem, solution);
  accumulate_totals(problem, solution);
  require_invariants(problem, solution);
  return solution;
}

void ContactSolver::solve_tangential(const ContactProblem& problem, ContactSolution& solution) {
  if (solution.pressure.size() != problem.grid.size())
    throw Error(ErrorKind::configuration, "the tangential problem needs the normal solution of the same grid", {},
                "call solve_normal first");
  check_magnitudes(problem);
  workspace_->choose_previous(problem);
  if (problem.regime != Regime::frictionless) {
    if (solution.status == Status::no_contact || solution.status == Status::failed) {
      empty_tangential_fields(problem, solution);
    } else {
      workspace_->solve_warm(problem, solution);
      if (solution.status != Status::no_contact)
        solution.status = solution.normal.status != Status::ok ? solution.normal.status : solution.tangential.status;
      accumulate_totals(problem, solution);
    }
  }
  if (problem.sensitivities && problem.tangential_model == TangentialModel::full && solution.elements_contact > 0) {
    const std::vector<double> by_approach = workspace_->normal.pressure_by_approach(problem, solution);
    if (problem.regime != Regime::frictionless) {
      solution.sensitivities =
          workspace_->tangential.sensitivities(problem, solution, workspace_->previous, by_approach);
    } else {
      solution.sensitivities.emplace();
      for (const double p : by_approach) solution.sensitivities->by_approach[0] += p * problem.grid.cell_area();
    }
  }
  require_invariants(problem, solution);
  workspace_->last = history_of(problem, solution);
}

ContactSolution ContactSolver::solve(const ContactProblem& problem) {
  ContactSolution solution = solve_normal(problem);
  solve_tangential(problem, solution);
  return solution;
}

Gradient ContactSolver::gradient(const ContactProblem& problem, const ContactSolution& solution, Quantity quantity) {
  if (solution.pressure.size() != problem.grid.size())
    throw Error(ErrorKind::configuration, "derivatives need the solution of the same problem", {}, "solve it first");
  if (problem.regime != Regime::frictionless && workspace_->tangential.couples(problem))
    throw Error(ErrorKind::configuration, "pressures that depend on tractions have no derivatives by the gap");
  FieldWeights weights = weights_of(problem, solution, quantity);
  Gradient tangential;
  if (!(weights.traction_x.empty() && weights.traction_y.empty()))
    tangential = workspace_->tangential.gradient(problem, solution, weights);
  Gradient out = workspace_->normal.gradient_by_gap(problem, solution, weights.pressure, weights.approach);
  out.by_creepage = tangential.by_creepage;
  out.by_friction = tangential.by_friction;
  out.report.iterations += tangential.report.iterations;
  if (out.report.status == Status::ok && tangential.report.status != Status::ok) out.report = tangential.report;
  return out;
}

}  // namespace treadmark::kalker
