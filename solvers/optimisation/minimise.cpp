// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/optimisation/minimise.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

#include <nlopt.h>

namespace treadmark::optimisation {
namespace {

constexpr double kAllowed = 1e-6;  ///< of a constraint
/// Points without numbers one after the other, each much nearer than the one before: moving asymptotes would go on
/// within themselves for ever.
constexpr int kMostWithout = 25;

struct SearchState {
  const Minimisation& problem;
  nlopt_opt optimiser;
  std::vector<double> point;  ///< that was asked for last
  std::optional<PointValues> values;
  std::exception_ptr thrown;
  int without = 0;  ///< points without numbers, the last ones
};

/// Null where there is nothing, and once something was thrown. Objective and constraints are asked for one after the
/// other.
const PointValues* values_at(SearchState& s, unsigned n, const double* x) noexcept {
  if (s.thrown) return nullptr;
  try {
    if (!std::equal(s.point.begin(), s.point.end(), x, x + n)) {
      s.point.assign(x, x + n);
      s.values = s.problem.at(s.point);
    }
    return s.values ? &*s.values : nullptr;
  } catch (...) {
    s.thrown = std::current_exception();
    nlopt_force_stop(s.optimiser);
    return nullptr;
  }
}

double objective_at(unsigned n, const double* x, double* gradient, void* state) {
  SearchState& s = *static_cast<SearchState*>(state);
  const PointValues* values = values_at(s, n, x);
  if (values == nullptr) {
    if (++s.without > kMostWithout) nlopt_force_stop(s.optimiser);
    return HUGE_VAL;
  }
  s.without = 0;
  if (gradient != nullptr) std::copy(values->gradient.begin(), values->gradient.end(), gradient);
  return values->objective;
}

void constraints_at(unsigned m, double* result, unsigned n, const double* x, double* gradient, void* state) {
  const PointValues* values = values_at(*static_cast<SearchState*>(state), n, x);
  if (values == nullptr) {
    std::fill_n(result, m, HUGE_VAL);
    if (gradient != nullptr) std::fill_n(gradient, std::size_t{m} * n, 0.0);
    return;
  }
  std::copy(values->constraints.begin(), values->constraints.end(), result);
  if (gradient != nullptr) std::copy(values->jacobian.begin(), values->jacobian.end(), gradient);
}

}  // namespace

Minimum minimise(const Minimisation& problem) {
  const auto algorithm = problem.method == Method::mma ? NLOPT_LD_MMA : NLOPT_LD_SLSQP;
  const auto n = static_cast<unsigned>(problem.start.size()), m = static_cast<unsigned>(problem.constraints);
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser(nlopt_create(algorithm, n), nlopt_destroy);
  SearchState state{problem, optimiser.get(), {}, {}, {}, 0};
  nlopt_set_lower_bounds(optimiser.get(), problem.lower.data());
  nlopt_set_upper_bounds(optimiser.get(), problem.upper.data());
  nlopt_set_min_objective(optimiser.get(), objective_at, &state);
  const std::vector<double> allowed(m, kAllowed);
  if (m > 0) nlopt_add_inequality_mconstraint(optimiser.get(), m, constraints_at, &state, allowed.data());
  nlopt_set_ftol_rel(optimiser.get(), problem.tolerance);
  nlopt_set_xtol_abs1(optimiser.get(), problem.tolerance);

  Minimum out;
  out.point = problem.start;
  for (std::size_t i = 0; i < out.point.size(); ++i)
    out.point[i] = std::clamp(out.point[i], problem.lower[i], problem.upper[i]);
  // At a kink, as where contact jumps, what was learned of the curvature before it leads nowhere: begun anew from there
  // the search goes on.
  constexpr int kMostTimes = 6;
  nlopt_result ended = NLOPT_FAILURE;
  double before = HUGE_VAL;
  bool converged = false;
  for (int times = 0; times < kMostTimes; ++times) {
    double least = 0.0;
    ended = nlopt_optimize(optimiser.get(), out.point.data(), &least);
    if (state.thrown) std::rethrow_exception(state.thrown);
    out.report.iterations += nlopt_get_numevals(optimiser.get());
    converged = converged || ended > 0;
    const bool kept = times > 0 && !(least < before - problem.tolerance * std::fabs(before));
    if (ended <= 0 || problem.method != Method::slsqp || kept) break;
    before = least;
  }
  if (converged) return out;
  out.report.status =
      ended == NLOPT_ROUNDOFF_LIMITED || ended == NLOPT_FORCED_STOP ? Status::not_converged : Status::failed;
  const char* said = ended == NLOPT_FAILURE ? nullptr : nlopt_get_errmsg(optimiser.get());  // "bug" for any failure
  out.report.message = ended == NLOPT_ROUNDOFF_LIMITED ? "no better point is found along the gradients"
                       : ended == NLOPT_FORCED_STOP    ? "no point beside the last one has numbers"
                       : said != nullptr               ? said
                                                       : "no point near the last one keeps the constraints";
  return out;
}

}  // namespace treadmark::optimisation
