// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/kalker/tangential/patch_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "treadmark/model/contact/theories.hpp"
#include "treadmark/solvers/kalker/tangential/nested_start.hpp"

namespace treadmark::kalker {

namespace {

/// Start values that violate the conditions by more than this share of the bound are not worth keeping.
constexpr double kUsefulStart = 0.28;
/// Accuracy of slip speeds in the iteration on friction, in multiples of eps.
constexpr double kSlipAccuracy = 10.0;
constexpr double kSensitivityAccuracy = 0.03;
constexpr int kSensitivityIterations = 60;
constexpr double kExactSensitivity = 1e-6;
constexpr int kExactIterations = 200;
constexpr int kMostCorrections = 20;
constexpr double kSmallestRelaxation = 0.02;

}  // namespace

ComplianceKey compliance_key(const Patch& patch, const Material& material,
                             std::shared_ptr<const InfluenceKernel> kernel) {
  const CombinedMaterial combined = combine(material);
  return {patch.box_nx,
          patch.box_ny,
          patch.grid.dx,
          patch.grid.dy,
          combined.poisson,
          combined.shear_modulus,
          material.layer_flexibility,
          std::move(kernel)};
}

PatchSolver::PatchSolver(const ContactProblem& problem, const Patch& patch, PatchConditions conditions,
                         ComplianceCache& cache)
    : input_(problem),
      patch_(patch),
      conditions_(std::move(conditions)),
      laws_(friction_of(problem)),
      layer_(problem.material, patch),
      cache_(cache),
      key_(compliance_key(patch, problem.material, conditions_.kernel)),
      matrix_(patch, cache.get(key_), conditions_.rows) {
  problem_.matrix = &matrix_;
  if (!conditions_.yield_before.empty()) layer_.start_from(conditions_.yield_before);
  const std::size_t n = conditions_.pressure.size();
  friction_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    friction_[i] = laws_.at(patch_, i).static_friction();
    static_bound_ += friction_[i] * std::max(conditions_.pressure[i], 0.0);
  }
  slip_speed_.assign(n, 0.0);
  set_bound();
}

std::vector<double> PatchSolver::friction_bound() const {
  std::vector<double> out(friction_.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = friction_[i] * std::max(conditions_.pressure[i], 0.0);
  return out;
}

std::vector<double> PatchSolver::slip_distance() const {
  std::vector<double> out(slip_speed_);
  for (double& s : out) s *= time_step();
  return out;
}

void PatchSolver::set_bound() { problem_.bound = layer_.bound(friction_bound(), slip_distance()); }

InterfaceLayer::Shear PatchSolver::layer_shear() const {
  std::vector<double> distance = new_slip_speed();
  for (double& s : distance) s *= time_step();
  return layer_.divide(friction_bound(), distance);
}

void PatchSolver::start_from(Field2 traction, std::vector<double> slip_speed) {
  state_.traction = std::move(traction);
  slip_speed_ = std::move(slip_speed);
  started_ = true;
}

bool PatchSolver::solve_at_fixed_friction(double eps, bool updated) {
  const bool sweeps = input_.settings.method == SolverSettings::Method::sweeps;
  const FrictionSolveResult result =
      sweeps ? friction_solve_.run_sweeps(problem_, state_, eps, input_.settings.max_iterations)
             : friction_solve_.run(problem_, state_, eps, input_.settings.max_iterations, updated);
  steps_ += result.steps;
  sweeps_ += result.sweeps;
  return result.converged;
}

std::vector<double> PatchSolver::new_slip_speed() const {
  const std::size_t n = friction_.size();
  std::vector<double> speed(n);
  for (std::size_t i = 0; i < n; ++i)
    if (state_.slipping[i]) speed[i] = std::hypot(state_.slip[i], state_.slip[n + i]) / time_step();
  return speed;
}

/// The no-slip equations W + A p = 0, by corrections that are each as exact as a sensitivity.
bool PatchSolver::adhere(double eps) {
  const std::size_t n = friction_.size();
  state_.traction.resize(2 * n);
  state_.slip.resize(2 * n);
  state_.slipping.assign(n, 0);
  state_.direction.assign(2 * n, 0.0);
  state_.excess.assign(n, 0.0);
  for (int round = 0; round < kMostCorrections; ++round) {
    ++steps_;
    matrix_.slip(state_.traction, state_.slip);
    for (std::size_t k = 0; k < 2 * n; ++k) state_.slip[k] += problem_.rigid_slip[k];
    const Field2 change = friction_solve_.newton().sensitivity(problem_, state_, state_.slip, {}, kSensitivityAccuracy,
                                                               kSensitivityIterations);
    for (std::size_t k = 0; k < 2 * n; ++k) state_.traction[k] += change[k];
    state_.violation = rms(change);
    if (state_.violation > eps * rms(state_.traction)) continue;
    std::fill(state_.slip.begin(), state_.slip.end(), 0.0);
    return true;
  }
  return false;
}

bool PatchSolver::solve(const Creepage& creepage, double eps) {
  if (theory(input_.tangential_model).limits.no_slip) {
    creepage_ = creepage;
    problem_.rigid_slip = conditions_.known_slip.at(creepage);
    return adhere(eps);
  }
  const bool fixed = laws_.constant() && !layer_.hardens();
  const auto adapt = [&] {
    if (!laws_.constant()) {
      std::vector<double> speed = slip_speed_;
      if (layer_.plastic()) {
        // what the layer shears does not slide
        const InterfaceLayer::Shear shear = layer_.divide(friction_bound(), slip_distance());
        for (std::size_t i = 0; i < speed.size(); ++i)
          speed[i] = std::max(0.0, speed[i] - shear.distance[i] / time_step());
      }
      friction_ =
          friction_of_slip(patch_, laws_, speed, time_step(), conditions_.friction_before, conditions_.temperature);
    }
    set_bound();
  };
  if (!fixed) adapt();
  problem_.rigid_slip = conditions_.known_slip.at(creepage);
  if (started_) {
    const double dx = creepage.xi - creepage_.xi, dy = creepage.eta - creepage_.eta;
    for (std::size_t k = 0; k < predicted_[0].size(); ++k) state_.traction[k] += dx * predicted_[0][k];
    for (std::size_t k = 0; k < predicted_[1].size(); ++k) state_.traction[k] += dy * predicted_[1][k];
    limit_to_bound(state_.traction, problem_.bound);
    state_.update(problem_);
    started_ = state_.violation <= kUsefulStart * rms(problem_.bound);
  }
  const bool updated = started_;
  if (!started_) state_.traction = nested_start(patch_, key_, problem_.bound, problem_.rigid_slip, cache_);
  started_ = true;
  creepage_ = creepage;
  predicted_ = {};
  friction_unsettled_ = false;
  if (fixed) return solve_at_fixed_friction(eps, updated);

  // Slip speeds and coefficients of friction by relaxed substitution: shorter steps when changes reverse, longer ones
  // when they go on in the same direction, as where a solution gives way to another one.
  double relaxation = 1.0;
  std::vector<double> last;
  for (int round = 0; round < std::max(1, input_.settings.max_outer); ++round) {
    if (!solve_at_fixed_friction(eps)) return false;
    const std::vector<double> speed = new_slip_speed();
    std::vector<double> change(speed.size());
    for (std::size_t i = 0; i < speed.size(); ++i) change[i] = speed[i] - slip_speed_[i];
    const bool converged = rms(change) <= kSlipAccuracy * eps * rms(speed);
    if (!last.empty()) {
      const double along = std::inner_product(change.begin(), change.end(), last.begin(), 0.0);
      relaxation = along < 0.0 ? std::max(0.5 * relaxation, kSmallestRelaxation) : std::min(1.3 * relaxation, 1.0);
    }
    for (std::size_t i = 0; i < speed.size(); ++i) slip_speed_[i] += (converged ? 1.0 : relaxation) * change[i];
    if (converged) return true;
    last = std::move(change);
    adapt();
  }
  friction_unsettled_ = true;
  return false;
}

std::array<double, 2> PatchSolver::relative_force() const {
  const std::size_t n = friction_.size();
  const auto middle = state_.traction.begin() + static_cast<std::ptrdiff_t>(n);
  return {std::accumulate(state_.traction.begin(), middle, 0.0) / static_bound_,
          std::accumulate(middle, state_.traction.end(), 0.0) / static_bound_};
}

std::array<double, 2> PatchSolver::relative_stiffness(int component) {
  const std::size_t n = friction_.size();
  const auto c = static_cast<std::size_t>(component);
  predicted_[c] = friction_solve_.newton().sensitivity(problem_, state_, conditions_.known_slip.per_unit(component), {},
                                                       kSensitivityAccuracy, kSensitivityIterations);
  const auto middle = predicted_[c].begin() + static_cast<std::ptrdiff_t>(n);
  return {std::accumulate(predicted_[c].begin(), middle, 0.0) / static_bound_,
          std::accumulate(middle, predicted_[c].end(), 0.0) / static_bound_};
}

void PatchSolver::take(const Creepage& creepage, Field2 traction, std::vector<double> friction) {
  friction_ = std::move(friction);
  set_bound();
  creepage_ = creepage;
  problem_.rigid_slip = conditions_.known_slip.at(creepage);
  state_.traction = std::move(traction);
  state_.update(problem_);
  started_ = true;
}

Field2 PatchSolver::change_by_creepage(const Creepage& unit) {
  return friction_solve_.newton().sensitivity(problem_, state_, conditions_.known_slip.rigid(unit), {},
                                              kExactSensitivity, kExactIterations);
}

Field2 PatchSolver::change_by_pressure(std::span<const double> more) {
  std::vector<double> bound(more.size());
  for (std::size_t i = 0; i < bound.size(); ++i) bound[i] = friction_[i] * more[i];
  return friction_solve_.newton().sensitivity(problem_, state_, Field2(2 * more.size(), 0.0), bound, kExactSensitivity,
                                              kExactIterations);
}

void PatchSolver::slide(std::array<double, 2> direction) {
  const std::size_t n = friction_.size();
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
