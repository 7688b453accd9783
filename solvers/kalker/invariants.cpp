// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/invariants.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/model/contact/theories.hpp"

namespace treadmark::kalker {
namespace {

/// Sums over the elements, from which all invariants follow.
struct ElementSums {
  bool finite = true;
  double most_negative = 0.0, most_outside = 0.0;  ///< pressures [Pa]
  double pressure = 0.0;                           ///< sum [Pa]
  double bound = 0.0, greatest_bound = 0.0, excess = 0.0;
  double slip_bound = 0.0, slip_lack = 0.0;  ///< of slipping elements
  double work = 0.0;                         ///< of tractions along the slip; negative: dissipated
};

bool all_finite(const std::vector<double>& field) {
  // A sum of what is finite times zero is zero. Several sums, which do not wait for each other.
  constexpr std::size_t kLanes = 8;
  double sum[kLanes] = {};
  std::size_t i = 0;
  for (; i + kLanes <= field.size(); i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) sum[k] += 0.0 * field[i + k];
  for (; i < field.size(); ++i) sum[0] += 0.0 * field[i];
  return ranges::all_of(sum, [](double part) { return part == 0.0; });
}

bool finite_fields(const ContactSolution& s) {
  for (const auto* field :
       {&s.pressure, &s.traction_x, &s.traction_y, &s.displacement_n, &s.displacement_x, &s.displacement_y, &s.slip_x,
        &s.slip_y, &s.friction, &s.plastic_x, &s.plastic_y, &s.yield_stress, &s.temperature_1, &s.temperature_2})
    if (!all_finite(*field)) return false;
  return true;
}

bool finite_totals(const ContactSolution& s) {
  double sum = 0.0;
  for (const double value : {s.approach, s.creepage.xi, s.creepage.eta, s.creepage.phi, s.rolling_step, s.force_n,
                             s.force_x, s.force_y, s.moment_x, s.moment_y, s.moment_n, s.max_pressure, s.elastic_energy,
                             s.frictional_power, s.max_temperature_1, s.max_temperature_2})
    sum += 0.0 * value;
  if (s.sensitivities) {
    for (const auto& row : s.sensitivities->by_creepage)
      for (const double value : row) sum += 0.0 * value;
    for (const double value : s.sensitivities->by_approach) sum += 0.0 * value;
  }
  return sum == 0.0;
}

ElementSums sums_of(const ContactProblem& problem, const ContactSolution& s) {
  ElementSums sums;
  sums.finite = finite_fields(s) && finite_totals(s);
  const std::size_t n = s.pressure.size();
  const bool has_states = s.state.size() == n,
             tangential = s.traction_x.size() == n && s.friction.size() == n && s.traction_y.size() == n && has_states,
             has_slip = tangential && s.slip_x.size() == n && s.slip_y.size() == n;
  const bool strips = theory(problem.tangential_model).limits.strips;
  for (std::size_t i = 0; i < n; ++i) {
    const double p = s.pressure[i];
    sums.pressure += p;
    sums.most_negative = std::min(sums.most_negative, p);
    if (has_states && s.state[i] == ElementState::exterior) sums.most_outside = std::max(sums.most_outside, p);
    if (!tangential || (p == 0.0 && s.traction_x[i] == 0.0 && s.traction_y[i] == 0.0)) continue;
    const double traction = std::sqrt(s.traction_x[i] * s.traction_x[i] + s.traction_y[i] * s.traction_y[i]),
                 bound = s.friction[i] * std::max(p, 0.0);
    sums.bound += bound;
    sums.greatest_bound = std::max(sums.greatest_bound, bound);
    sums.excess = std::max(sums.excess, traction - bound);
    // Strip theory may call an element without traction slipping, at the ends of a strip.
    if (s.state[i] == ElementState::slip && !(strips && traction == 0.0)) {
      sums.slip_bound += bound;
      sums.slip_lack += std::max(0.0, bound - traction);
    }
    if (has_slip) sums.work += s.traction_x[i] * s.slip_x[i] + s.traction_y[i] * s.slip_y[i];
  }
  return sums;
}

/// Penetration of the rigid bodies [m], and what gap and displacement leave of it where there is no pressure. Elements
/// without a gap do not count.
struct Depths {
  double rigid = 0.0, outside = 0.0;
};

Depths depths(std::span<const double> gap, const ContactSolution& s) {
  // Several minima, which do not wait for each other.
  constexpr std::size_t kLanes = 8;
  double rigid[kLanes], outside[kLanes];
  ranges::fill(rigid, kInfinity);
  ranges::fill(outside, kInfinity);
  const auto look = [&](std::size_t i, std::size_t k) {
    const double h = gap[i], left = s.pressure[i] > 0.0 ? kInfinity : h + s.displacement_n[i];
    rigid[k] = h < rigid[k] ? h : rigid[k];
    outside[k] = left < outside[k] ? left : outside[k];
  };
  std::size_t i = 0;
  for (; i + kLanes <= gap.size(); i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) look(i + k, k);
  for (; i < gap.size(); ++i) look(i, 0);
  return {s.approach - *ranges::min_element(rigid), s.approach - *ranges::min_element(outside)};
}

std::optional<Violation> broken(Invariant invariant, double amount, std::string text) {
  return Violation{invariant, amount, std::move(text)};
}

std::optional<Violation> broken_tangentially(const ContactProblem& problem, const ContactSolution& s,
                                             const ElementSums& sums) {
  const double eps = problem.settings.eps, area = problem.grid.cell_area(), limit = sums.bound * area;
  if (!theory(problem.tangential_model).limits.no_slip) {
    constexpr double kRounding = 1e-9;
    const double excess = sums.greatest_bound > 0.0 ? sums.excess / sums.greatest_bound : sums.excess;
    if (excess > 10.0 * eps + kRounding)
      return broken(Invariant::traction_bound, excess,
                    fmt::format("a traction exceeds friction by {:.3g} of the greatest bound", excess));
    const double force = std::hypot(s.force_x, s.force_y);
    if (force > limit * (1.0 + 10.0 * eps + kRounding))
      return broken(Invariant::traction_bound, force / limit - 1.0,
                    fmt::format("a tangential force of {:.6g} N exceeds the {:.6g} N of friction", force, limit));
    constexpr double kLeastLack = 1e-6;
    if (s.yield_stress.empty() && sums.slip_lack > (100.0 * eps + kLeastLack) * sums.slip_bound)
      return broken(Invariant::sliding, sums.slip_lack / sums.slip_bound,
                    fmt::format("tractions of slipping elements lack {:.3g} of their friction",
                                sums.slip_lack / sums.slip_bound));
  }
  if (problem.friction_of_row.empty()) {
    constexpr double kLeastMiss = 1e-6;
    const double full = problem.friction.static_friction() * s.force_n;
    for (const auto& [wanted, found, name] : {std::tuple{problem.fx_relative, s.force_x, "longitudinal"},
                                              std::tuple{problem.fy_relative, s.force_y, "lateral"}})
      if (wanted && std::abs(found - *wanted * full) > (10.0 * eps + kLeastMiss) * full)
        return broken(
            Invariant::tangential_force, std::abs(found / full - *wanted),
            fmt::format("a {} force of {:.6g} N is prescribed, found are {:.6g} N", name, *wanted * full, found));
  }
  // Slip below a millionth of rolling (shift: of a millimetre) is what rounding leaves, that below eps what accuracy
  // allows.
  const double noise = std::max(1e-6, eps) * (problem.regime == Regime::shift ? 1e-3 : 1.0) * sums.bound;
  if (sums.work > noise)
    return broken(Invariant::dissipation, sums.work * area,
                  fmt::format("friction adds {:.3g} {} instead of taking it", sums.work * area,
                              problem.regime == Regime::shift ? "J" : "N of rolling"));
  return std::nullopt;
}

}  // namespace

std::string_view to_string(Invariant invariant) {
  constexpr std::string_view kNames[] = {"finite",         "pressure", "penetration",      "normal_force",
                                         "traction_bound", "sliding",  "tangential_force", "dissipation"};
  return kNames[static_cast<std::size_t>(invariant)];
}

std::optional<Violation> broken_invariant(const ContactProblem& problem, const ContactSolution& s) {
  if (s.status == Status::no_contact) return std::nullopt;
  const ElementSums sums = sums_of(problem, s);
  if (!sums.finite) return broken(Invariant::finite, 1.0, "a number of the solution is not finite");
  if (s.status != Status::ok || s.normal.status != Status::ok || s.tangential.status != Status::ok) return std::nullopt;
  if (sums.most_negative < 0.0)
    return broken(Invariant::pressure, -sums.most_negative,
                  fmt::format("a pressure of {:.6g} Pa pulls", sums.most_negative));
  if (sums.most_outside > 0.0)
    return broken(Invariant::pressure, sums.most_outside,
                  fmt::format("a pressure of {:.6g} Pa acts outside contact", sums.most_outside));
  const std::size_t n = problem.gap.size();
  if (problem.normal_model == NormalModel::full && s.pressure.size() == n && s.displacement_n.size() == n) {
    constexpr double kLeastDepth = 1e-6;
    const Depths found = depths(problem.gap, s);
    if (found.outside > (10.0 * problem.settings.eps + kLeastDepth) * found.rigid)
      return broken(Invariant::penetration, found.outside / found.rigid,
                    fmt::format("without pressure an element lies {:.3g} um deep, of {:.3g} um of the rigid bodies",
                                kMicro * found.outside, kMicro * found.rigid));
  }
  constexpr double kForce = 1e-3;
  if (problem.force_prescribed && problem.normal_model == NormalModel::full) {
    const double miss = std::abs(sums.pressure * problem.grid.cell_area() - problem.normal_force);
    if (miss > (100.0 * problem.settings.eps + kForce) * problem.normal_force)
      return broken(Invariant::normal_force, miss / problem.normal_force,
                    fmt::format("a normal force of {:.6g} N is prescribed, found are {:.6g} N", problem.normal_force,
                                sums.pressure * problem.grid.cell_area()));
  }
  return s.traction_x.empty() ? std::nullopt : broken_tangentially(problem, s, sums);
}

void require_invariants(const ContactProblem& problem, ContactSolution& solution) {
  const std::optional<Violation> violation = broken_invariant(problem, solution);
  if (!violation) return;
  Report& report = solution.traction_x.empty() ? solution.normal : solution.tangential;
  solution.status = report.status = Status::failed;
  report.message =
      fmt::format("the result breaks the invariant {}: {}", to_string(violation->invariant), violation->text);
}

}  // namespace treadmark::kalker
