// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/friction_newton.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/solvers/kalker/halfspace/element_blocks.hpp"

namespace treadmark::kalker {

namespace {

enum Kind : char { kFixed, kAdhesion, kSlip };

constexpr double kShortestStep = 1.0 / 32.0;
constexpr double kSufficientDecrease = 1e-4;
constexpr double kReliableReduction = 0.3;  ///< of the violation: the step is trusted as a measure of the error
constexpr double kLoosestInner = 0.1, kTightestInner = 0.02;  ///< relative accuracy of linear solutions
constexpr double kRoundOff = 1e-13;
/// Bounds that exceed all tractions by more than this say nothing about their round-off.
constexpr double kIdleBound = 1e3;

}  // namespace

void FrictionNewton::linearise(const FrictionProblem& problem, const FrictionState& state) {
  const std::size_t n = problem.bound.size();
  kind_.resize(n);
  tangent_.resize(2 * n);
  stiffness_.resize(n);
  damping_.resize(n);
  field_.resize(2 * n);
  image_.resize(2 * n);
  const double diagonal = problem.matrix->diagonal();
  for_each_element(n, [&](std::size_t i) {
    kind_[i] = !state.slipping[i] ? kAdhesion : problem.bound[i] > 0.0 ? kSlip : kFixed;
    tangent_[i] = -state.direction[n + i];
    tangent_[n + i] = state.direction[i];
    damping_[i] = kind_[i] == kSlip ? state.excess[i] / problem.bound[i] : 0.0;
    stiffness_[i] = damping_[i] * diagonal;
  });
}

GmresResult FrictionNewton::solve_linear(const FrictionProblem& problem, std::span<double> rhs, std::span<double> x,
                                         const GmresTarget& target, int max_inner) {
  const std::size_t n = problem.bound.size();
  PatchOperator& matrix = *problem.matrix;
  const std::vector<int>& ahead = matrix.patch().ahead;
  const bool rolling = matrix.patch().transport != Transport::none;

  // Reduced vectors hold the component along the tangent in the x place of slip elements, zero in the y place.
  const auto expand = [&](std::span<const double> v, std::span<double> p) {
    for_each_element(n, [&](std::size_t i) {
      if (kind_[i] == kAdhesion) {
        p[i] = v[i];
        p[n + i] = v[n + i];
      } else {
        const double t = kind_[i] == kSlip ? v[i] : 0.0;
        p[i] = t * tangent_[i];
        p[n + i] = t * tangent_[n + i];
      }
    });
  };
  const auto multiply = [&](std::span<const double> v, std::span<double> out) {
    expand(v, field_);
    matrix.slip(field_, image_);
    for_each_element(n, [&](std::size_t i) {
      if (kind_[i] == kAdhesion) {
        out[i] = image_[i];
        out[n + i] = image_[n + i];
      } else {
        out[i] =
            kind_[i] == kSlip ? image_[i] * tangent_[i] + image_[n + i] * tangent_[n + i] + stiffness_[i] * v[i] : 0.0;
        out[n + i] = 0.0;
      }
    });
  };
  // Increments along the row by the approximate inverse of B, then tractions by summing them up from the leading edge.
  // Slip elements resist the more, the faster they slip; in the limit each of them stands alone.
  const double own = 1.0 / matrix.diagonal();
  const auto precondition = [&](std::span<const double> v, std::span<double> out) {
    expand(v, field_);
    for_each_element(n, [&](std::size_t i) {
      const double coupled = 1.0 / (1.0 + damping_[i]);
      field_[i] *= coupled;
      field_[n + i] *= coupled;
    });
    matrix.inverse_displacement(field_, image_);
    // Sums go along rows: blocks begin where nothing is ahead.
    const auto nothing_ahead = [&](std::size_t i) {
      while (rolling && i < n && ahead[i] >= 0) ++i;
      return i;
    };
    for_blocks(n, [&](std::size_t begin, std::size_t block_end) {
      double px = 0.0, py = 0.0;
      for (std::size_t i = nothing_ahead(begin), end = nothing_ahead(block_end); i < end; ++i) {
        if (!rolling || ahead[i] < 0) px = py = 0.0;
        px += image_[i];
        py += image_[n + i];
        if (kind_[i] == kAdhesion) {
          out[i] = px;
          out[n + i] = py;
          continue;
        }
        const double coupled = 1.0 / (1.0 + damping_[i]);
        const double t = kind_[i] == kSlip
                             ? coupled * (px * tangent_[i] + py * tangent_[n + i] + (1.0 - coupled) * own * v[i])
                             : 0.0;
        out[i] = t;
        out[n + i] = 0.0;
        px = t * tangent_[i];
        py = t * tangent_[n + i];
      }
    });
  };
  for_each_element(n, [&](std::size_t i) {
    if (kind_[i] == kAdhesion) return;
    rhs[i] = kind_[i] == kSlip ? rhs[i] * tangent_[i] + rhs[n + i] * tangent_[n + i] : 0.0;
    rhs[n + i] = 0.0;
  });
  const GmresResult result = gmres_.solve(multiply, precondition, rhs, x, target, max_inner);
  expand(x, x);
  return result;
}

NewtonResult FrictionNewton::solve(const FrictionProblem& problem, FrictionState& state,
                                   const NewtonSettings& settings) {
  const std::size_t n = problem.bound.size();
  NewtonResult result;
  const double r = 1.0 / problem.matrix->diagonal();
  if (!settings.updated) {
    limit_to_bound(state.traction, problem.bound);
    state.update(problem);
    ++result.products;
  }
  Field2 rhs(2 * n), known(2 * n), step(2 * n);
  double relative = kLoosestInner;
  const double tractions = rms(state.traction) + r * rms(problem.rigid_slip);
  const double floor = kRoundOff * std::min(rms(problem.bound), kIdleBound * tractions);
  for (; result.steps < settings.max_steps; ++result.steps) {
    check_cancelled();
    if (state.violation <= floor) {
      result.converged = true;
      break;
    }
    linearise(problem, state);
    // Slip elements go to the circle; what this does to the slip distance belongs to the right-hand side.
    const double moved = sum_of_blocks(n, [&](std::size_t begin, std::size_t end) {
      double part = 0.0;
      for (std::size_t i = begin; i < end; ++i) {
        known[i] = known[n + i] = 0.0;
        if (kind_[i] == kAdhesion) continue;
        const double along = state.direction[i] * state.traction[i] + state.direction[n + i] * state.traction[n + i];
        known[i] = (problem.bound[i] - along) * state.direction[i];
        known[n + i] = (problem.bound[i] - along) * state.direction[n + i];
        if (problem.bound[i] - along > 1e-12 * problem.bound[i]) part += 1.0;
      }
      return part;
    });
    if (moved > 0.0) {
      problem.matrix->slip(known, rhs);
      ++result.products;
    } else {
      clear(std::span(rhs));
    }
    for_each_element(n, [&](std::size_t i) {
      if (kind_[i] == kAdhesion) {
        rhs[i] = -rhs[i] - state.slip[i];
        rhs[n + i] = -rhs[n + i] - state.slip[n + i];
      } else {
        // Along the tangent: p_t / (gamma r) with gamma = g/|z|.
        const double factor = problem.bound[i] > 0.0 ? (1.0 + damping_[i]) / r : 0.0;
        rhs[i] = -rhs[i] - factor * state.traction[i];
        rhs[n + i] = -rhs[n + i] - factor * state.traction[n + i];
      }
    });
    // As exactly as the accuracy asks for where one more step may reach it.
    const double wanted = 0.3 * settings.eps * rms(state.traction) * std::sqrt(static_cast<double>(2 * n));
    const GmresTarget target = [&](double size) {
      return wanted >= kTightestInner * size ? std::min(wanted, kLoosestInner * size) : relative * size;
    };
    const GmresResult inner = solve_linear(problem, rhs, step, target, settings.max_inner);
    result.products += inner.iterations;
    for_each_element(2 * n, [&](std::size_t k) { step[k] += known[k]; });

    // Backtracking on the violation.
    FrictionState trial;  // in memory only now, when the linear solution needs none
    double length = 1.0;
    for (; length >= kShortestStep; length *= 0.5) {
      fill_by_blocks(trial.traction, 2 * n, [&](std::size_t k) { return state.traction[k] + length * step[k]; });
      limit_to_bound(trial.traction, problem.bound);
      trial.update(problem);
      ++result.products;
      if (trial.violation < state.violation * (1.0 - kSufficientDecrease * length)) break;
    }
    if (length < kShortestStep) break;

    for_each_element(2 * n, [&](std::size_t k) { step[k] = trial.traction[k] - state.traction[k]; });
    const double change = rms(step), ratio = trial.violation / state.violation;
    std::swap(state, trial);
    // What is left to do is about the last change times the reduction it brought.
    if (length == 1.0 && ratio < kReliableReduction && ratio * change <= settings.eps * rms(state.traction)) {
      ++result.steps;
      result.converged = true;
      break;
    }
    // Quadratic convergence needs ever more exact steps.
    relative = std::clamp(0.5 * ratio * ratio, kTightestInner, kLoosestInner);
  }
  return result;
}

Field2 FrictionNewton::sensitivity(const FrictionProblem& problem, const FrictionState& state,
                                   const Field2& rigid_slip_change, std::span<const double> bound_change,
                                   double tolerance, int max_inner) {
  linearise(problem, state);
  Field2 rhs(rigid_slip_change), change(rhs.size());
  const std::size_t n = problem.bound.size();
  Field2 known;
  if (!bound_change.empty()) {
    // slip elements follow their bound; what that does to the slip belongs to the right-hand side
    known.assign(2 * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      if (kind_[i] != kSlip) continue;
      known[i] = bound_change[i] * state.direction[i];
      known[n + i] = bound_change[i] * state.direction[n + i];
    }
    Field2 caused(2 * n);
    problem.matrix->slip(known, caused);
    for (std::size_t k = 0; k < 2 * n; ++k) rhs[k] += caused[k];
  }
  for (double& value : rhs) value = -value;
  const GmresResult inner = solve_linear(
      problem, rhs, change, [tolerance](double size) { return tolerance * size; }, max_inner);
  sensitivity_products_ += inner.iterations;
  for (std::size_t k = 0; k < known.size(); ++k) change[k] += known[k];
  return change;
}

}  // namespace treadmark::kalker
