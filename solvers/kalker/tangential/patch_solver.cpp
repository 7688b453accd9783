// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/patch_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "treadmark/solvers/kalker/tangential/nested_start.hpp"
#include "treadmark/solvers/kalker/tangential/rigid_slip.hpp"
#include "treadmark/solvers/kalker/tangential/slip_friction.hpp"

namespace treadmark::kalker {

namespace {

/// Start values that violate the conditions by more than this share of the bound are not worth keeping.
constexpr double kUsefulStart = 0.1;
/// Accuracy of slip speeds in the iteration on friction, in multiples of eps.
constexpr double kSlipAccuracy = 10.0;
constexpr double kSensitivityAccuracy = 0.03;
constexpr int kSensitivityIterations = 60;
constexpr double kSmallestRelaxation = 0.02;

}  // namespace

ComplianceKey compliance_key(const Patch& patch, const Material& material) {
  const CombinedMaterial combined = combine(material);
  return {patch.box_nx,     patch.box_ny,           patch.grid.dx,
          patch.grid.dy,    combined.poisson,       combined.shear_modulus,
          material.layer_flexibility};
}

PatchSolver::PatchSolver(const ContactProblem& problem, const Patch& patch, std::vector<double> pressure,
                         ComplianceCache& cache)
    : input_(problem),
      patch_(patch),
      pressure_(std::move(pressure)),
      cache_(cache),
      key_(compliance_key(patch, problem.material)),
      matrix_(patch, cache.get(key_)) {
  problem_.matrix = &matrix_;
  friction_.assign(pressure_.size(), problem.friction.static_friction());
  slip_speed_.assign(pressure_.size(), 0.0);
  set_bound();
}

double PatchSolver::time_step() const {
  return patch_.transport == Transport::none ? 1.0 : patch_.grid.dx / input_.rolling.velocity;
}

void PatchSolver::set_bound() {
  problem_.bound.resize(pressure_.size());
  for (std::size_t i = 0; i < pressure_.size(); ++i) problem_.bound[i] = friction_[i] * std::max(pressure_[i], 0.0);
}

void PatchSolver::start_from(Field2 traction, std::vector<double> slip_speed) {
  state_.traction = std::move(traction);
  slip_speed_ = std::move(slip_speed);
  started_ = true;
}

bool PatchSolver::solve_at_fixed_friction(double eps) {
  const FrictionSolveResult result =
      friction_solve_.run(problem_, state_, eps, input_.settings.max_iterations);
  steps_ += result.steps;
  sweeps_ += result.sweeps;
  return result.converged;
}

std::vector<double> PatchSolver::new_slip_speed() const {
  const std::size_t n = pressure_.size();
  std::vector<double> speed(n);
  for (std::size_t i = 0; i < n; ++i)
    if (state_.slipping[i]) speed[i] = std::hypot(state_.slip[i], state_.slip[n + i]) / time_step();
  return speed;
}

bool PatchSolver::solve(const Creepage& creepage, double eps) {
  const bool coulomb = input_.friction.kind == FrictionLaw::Kind::coulomb;
  if (!coulomb) {
    friction_ = friction_of_slip(patch_, input_.friction, slip_speed_, time_step());
    set_bound();
  }
  problem_.rigid_slip = rigid_slip(patch_, creepage, input_.rolling.spin_offset_factor);
  if (started_) {
    const double dx = creepage.xi - creepage_.xi, dy = creepage.eta - creepage_.eta;
    for (std::size_t k = 0; k < predicted_[0].size(); ++k) state_.traction[k] += dx * predicted_[0][k];
    for (std::size_t k = 0; k < predicted_[1].size(); ++k) state_.traction[k] += dy * predicted_[1][k];
    limit_to_bound(state_.traction, problem_.bound);
    state_.update(problem_);
    started_ = state_.violation <= kUsefulStart * rms(problem_.bound);
  }
  if (!started_)
    state_.traction =
        nested_start(patch_, key_, problem_.bound, creepage, input_.rolling.spin_offset_factor, cache_);
  started_ = true;
  creepage_ = creepage;
  predicted_ = {};
  friction_unsettled_ = false;
  if (coulomb) return solve_at_fixed_friction(eps);

  // Slip speeds and coefficients of friction by relaxed substitution.
  double relaxation = 1.0, last_change = 0.0;
  for (int round = 0; round < std::max(1, input_.settings.max_outer); ++round) {
    if (!solve_at_fixed_friction(eps)) return false;
    const std::vector<double> speed = new_slip_speed();
    std::vector<double> change(speed.size());
    for (std::size_t i = 0; i < speed.size(); ++i) change[i] = speed[i] - slip_speed_[i];
    const double size = rms(change);
    const bool converged = size <= kSlipAccuracy * eps * rms(speed);
    if (round > 0)
      relaxation = size > 0.9 * last_change ? std::max(0.5 * relaxation, kSmallestRelaxation)
                                            : std::min(1.1 * relaxation, 1.0);
    last_change = size;
    for (std::size_t i = 0; i < speed.size(); ++i) slip_speed_[i] += (converged ? 1.0 : relaxation) * change[i];
    if (converged) return true;
    friction_ = friction_of_slip(patch_, input_.friction, slip_speed_, time_step());
    set_bound();
  }
  friction_unsettled_ = true;
  return false;
}

std::array<double, 2> PatchSolver::relative_force() const {
  const std::size_t n = pressure_.size();
  const double scale =
      input_.friction.static_friction() * std::accumulate(pressure_.begin(), pressure_.end(), 0.0);
  const auto middle = state_.traction.begin() + static_cast<std::ptrdiff_t>(n);
  return {std::accumulate(state_.traction.begin(), middle, 0.0) / scale,
          std::accumulate(middle, state_.traction.end(), 0.0) / scale};
}

std::array<double, 2> PatchSolver::relative_stiffness(int component) {
  const std::size_t n = pressure_.size();
  Creepage unit;
  (component == 0 ? unit.xi : unit.eta) = 1.0;
  const auto c = static_cast<std::size_t>(component);
  predicted_[c] = friction_solve_.newton().sensitivity(problem_, state_, rigid_slip(patch_, unit, 0.0),
                                                       kSensitivityAccuracy, kSensitivityIterations);
  const double scale =
      input_.friction.static_friction() * std::accumulate(pressure_.begin(), pressure_.end(), 0.0);
  const auto middle = predicted_[c].begin() + static_cast<std::ptrdiff_t>(n);
  return {std::accumulate(predicted_[c].begin(), middle, 0.0) / scale,
          std::accumulate(middle, predicted_[c].end(), 0.0) / scale};
}

void PatchSolver::slide(std::array<double, 2> direction) {
  const std::size_t n = pressure_.size();
  state_.traction.resize(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    state_.traction[i] = problem_.bound[i] * direction[0];
    state_.traction[n + i] = problem_.bound[i] * direction[1];
  }
  if (problem_.rigid_slip.empty()) problem_.rigid_slip.assign(2 * n, 0.0);
  state_.update(problem_);
  std::fill(state_.slipping.begin(), state_.slipping.end(), char{1});
}

bool PatchSolver::sliding() const {
  return std::find(state_.slipping.begin(), state_.slipping.end(), char{0}) == state_.slipping.end();
}

double PatchSolver::residual() const {
  const double bound = rms(problem_.bound);
  return bound > 0.0 ? state_.violation / bound : 0.0;
}

}  // namespace treadmark::kalker
