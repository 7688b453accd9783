// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/tangential_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/tangential/patch_solver.hpp"
#include "treadmark/solvers/kalker/tangential/prescribed_force.hpp"

namespace treadmark::kalker {

namespace {

constexpr double kEqualMaterials = 1e-6;     ///< |K| below this has no influence
constexpr double kAngleTolerance = 1e-6;     ///< of the rolling direction [rad]
constexpr double kAlignment = 1e-6;          ///< of two grids, in elements
/// Forces closer to the friction limit than this cannot be told from full sliding.
constexpr double kFullSliding = 1.0 - 1e-9;

[[noreturn]] void refuse(const std::string& message, const std::string& advice) {
  throw Error(ErrorKind::configuration, message, {}, advice);
}

Transport transport_of(const ContactProblem& problem) {
  if (problem.regime == Regime::shift) return Transport::none;
  const double chi = std::remainder(problem.rolling.chi, 2.0 * std::numbers::pi);
  if (std::abs(chi) < kAngleTolerance) return Transport::forward;
  if (std::abs(std::abs(chi) - std::numbers::pi) < kAngleTolerance) return Transport::backward;
  refuse("steady rolling in direction " + std::to_string(problem.rolling.chi) + " rad is not supported",
         "turn the contact frame so that chi is 0 or pi");
}

void check(const ContactProblem& problem, const ContactSolution& solution) {
  const Grid2& grid = problem.grid;
  if (grid.nx < 1 || grid.ny < 1 || !(grid.dx > 0.0) || !(grid.dy > 0.0))
    refuse("the contact grid has no elements", "give positive numbers and steps");
  if (solution.pressure.size() != grid.size())
    refuse("the tangential problem needs a pressure for each of " + std::to_string(grid.size()) + " elements, not " +
               std::to_string(solution.pressure.size()),
           "solve the normal problem first");
  if (!solution.state.empty() && solution.state.size() != grid.size())
    refuse("element states do not fit the contact grid", "solve the normal problem first");
  const CombinedMaterial combined = combine(problem.material);
  if (!(combined.shear_modulus > 0.0)) refuse("the shear modulus must be positive", "check the material");
  if (std::abs(combined.difference) > kEqualMaterials)
    refuse("elastically dissimilar bodies (K = " + std::to_string(combined.difference) +
               ") couple the normal and tangential problems, which is not supported",
           "use bodies with equal (1 - 2 nu)/G, so that K = 0");
  const Creepage& c = problem.creepage;
  for (const double value : {c.xi, c.eta, c.phi, c.spin_x, c.spin_y, problem.fx_relative.value_or(0.0),
                             problem.fy_relative.value_or(0.0)})
    if (!std::isfinite(value)) refuse("a creepage, spin centre or tangential force is not finite", "check the input");
  if (problem.regime == Regime::steady && !(problem.rolling.velocity > 0.0))
    refuse("the rolling velocity must be positive", "give its magnitude; the direction is chi");
  if (!(problem.friction.static_friction() >= 0.0))
    refuse("the coefficient of friction is negative", "check the friction law");
}

/// What the next problem may start from.
struct LastSolution {
  Grid2 grid;
  Transport transport = Transport::none;
  std::vector<double> traction_x, traction_y, bound, slip_speed;
  Creepage creepage;
  bool force_prescribed = false;
};

/// Index offset of `to` in `from`, if their elements line up.
std::optional<std::array<int, 2>> offset_between(const Grid2& from, const Grid2& to) {
  const auto close = [](double a, double b) { return std::abs(a - b) <= kAlignment * b; };
  if (!close(from.dx, to.dx) || !close(from.dy, to.dy)) return std::nullopt;
  const double ox = (to.x0 - from.x0) / to.dx, oy = (to.y0 - from.y0) / to.dy;
  // Grids that do not overlap have nothing to tell each other.
  if (!(ox > -to.nx && ox < from.nx && oy > -to.ny && oy < from.ny)) return std::nullopt;
  if (std::abs(ox - std::round(ox)) > kAlignment || std::abs(oy - std::round(oy)) > kAlignment) return std::nullopt;
  return std::array<int, 2>{static_cast<int>(std::lround(ox)), static_cast<int>(std::lround(oy))};
}

/// Accuracy of tractions on the way to a prescribed force: at first, in relation to the deviation that is left, and by
/// how much it is tightened.
constexpr double kRoughest = 1e-3, kRoughness = 30.0, kRefinement = 0.01;

}  // namespace

struct TangentialSolver::Workspace {
  ComplianceCache cache;
  std::optional<LastSolution> last;

  bool start(const ContactProblem& problem, const Patch& patch, PatchSolver& solver) const;
  void store(const ContactProblem& problem, const Patch& patch, const PatchSolver& solver, const Creepage& creepage);
};

bool TangentialSolver::Workspace::start(const ContactProblem& problem, const Patch& patch, PatchSolver& solver) const {
  if (!last || last->transport != patch.transport) return false;
  const auto offset = offset_between(last->grid, problem.grid);
  if (!offset) return false;
  const std::size_t n = patch.cell.size();
  Field2 traction(2 * n);
  std::vector<double> speed(n);
  for (std::size_t i = 0; i < n; ++i) {
    const int ix = patch.column[i] + (*offset)[0], iy = patch.row[i] + (*offset)[1];
    if (ix < 0 || iy < 0 || ix >= last->grid.nx || iy >= last->grid.ny) continue;
    const std::size_t from = last->grid.index(ix, iy);
    speed[i] = last->slip_speed[from];
    // Tractions of slip elements follow the bound.
    const double before = last->bound[from];
    const double size = std::hypot(last->traction_x[from], last->traction_y[from]);
    const double factor = before > 0.0 && size > (1.0 - 1e-9) * before ? solver.bound()[i] / before : 1.0;
    traction[i] = factor * last->traction_x[from];
    traction[n + i] = factor * last->traction_y[from];
  }
  solver.start_from(std::move(traction), std::move(speed));
  return true;
}

void TangentialSolver::Workspace::store(const ContactProblem& problem, const Patch& patch, const PatchSolver& solver,
                                        const Creepage& creepage) {
  if (!last) last.emplace();
  last->grid = problem.grid;
  last->transport = patch.transport;
  last->creepage = creepage;
  last->force_prescribed = problem.fx_relative || problem.fy_relative;
  for (auto* field : {&last->traction_x, &last->traction_y, &last->bound, &last->slip_speed})
    field->assign(problem.grid.size(), 0.0);
  const std::size_t n = patch.cell.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = patch.grid_index(static_cast<int>(i));
    last->traction_x[at] = solver.state().traction[i];
    last->traction_y[at] = solver.state().traction[n + i];
    last->bound[at] = solver.bound()[i];
    last->slip_speed[at] = solver.slip_speed()[i];
  }
}

namespace {

struct Outcome {
  Creepage creepage;
  Status status = Status::ok;
  std::string message;
};

/// Creepages by which the prescribed forces arise; the others stay as given.
Outcome solve_for_force(const ContactProblem& problem, PatchSolver& solver, const std::optional<Creepage>& estimate) {
  Outcome outcome;
  outcome.creepage = problem.creepage;
  const double fx = problem.fx_relative.value_or(0.0), fy = problem.fy_relative.value_or(0.0);
  const double size = std::hypot(fx, fy);
  double total = 0.0;
  for (const double bound : solver.bound()) total += bound;
  if (size > 0.0 && (size >= kFullSliding || !(total > 0.0))) {
    solver.slide({fx / size, fy / size});
    outcome.status = Status::not_converged;
    outcome.message = "the prescribed tangential force reaches the limit of friction: the contact slides, at a creepage "
                      "that is not determined";
    return outcome;
  }
  if (!(total > 0.0)) {
    outcome.status = solver.solve(outcome.creepage, problem.settings.eps) ? Status::ok : Status::not_converged;
    return outcome;
  }

  // The unknowns in the order of the search.
  std::vector<int> unknown;
  if (problem.fx_relative) unknown.push_back(0);
  if (problem.fy_relative) unknown.push_back(1);
  const auto component = [](Creepage& c, int k) -> double& { return k == 0 ? c.xi : c.eta; };
  Creepage start = problem.creepage;
  for (const int k : unknown) {
    component(start, k) = 0.0;
    if (estimate) component(start, k) = k == 0 ? estimate->xi : estimate->eta;
  }
  ForceSearchSettings settings;
  settings.count = static_cast<int>(unknown.size());
  settings.tolerance = problem.settings.eps;
  settings.max_iterations = problem.settings.max_force;
  settings.exact_derivatives = problem.friction.kind == FrictionLaw::Kind::coulomb;
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    settings.target[k] = unknown[k] == 0 ? fx : fy;
    settings.start[k] = component(start, unknown[k]);
  }
  bool solved = true;
  double eps = std::max(kRoughest, settings.tolerance);
  const auto evaluate = [&](std::array<double, 2> values) {
    for (std::size_t k = 0; k < unknown.size(); ++k) component(outcome.creepage, unknown[k]) = values[k];
    ForceSample sample;
    double worst = 0.0;
    const auto measure = [&] {
      solved = solver.solve(outcome.creepage, eps);
      const std::array<double, 2> force = solver.relative_force();
      worst = 0.0;
      for (std::size_t k = 0; k < unknown.size(); ++k) {
        sample.force[k] = force[static_cast<std::size_t>(unknown[k])];
        worst = std::max(worst, std::abs(sample.force[k] - settings.target[k]));
      }
    };
    measure();
    // Far from the target rough tractions will do.
    while (eps > problem.settings.eps && worst < kRoughness * eps) {
      eps = std::max(problem.settings.eps, kRefinement * eps);
      measure();
    }
    sample.sliding = solver.sliding();
    if (worst > settings.tolerance)
      for (std::size_t column = 0; column < unknown.size(); ++column) {
        const std::array<double, 2> d = solver.relative_stiffness(unknown[column]);
        for (std::size_t k = 0; k < unknown.size(); ++k)
          sample.derivative[k][column] = d[static_cast<std::size_t>(unknown[k])];
      }
    return sample;
  };
  const ForceSearchResult found = find_creepage(settings, evaluate);
  if (!found.converged) {
    outcome.status = Status::not_converged;
    outcome.message = "the prescribed tangential force is missed by " + std::to_string(found.residual) +
                      " of the friction limit after " + std::to_string(found.iterations) + " iterations";
  } else if (!solved) {
    outcome.status = Status::not_converged;
  }
  return outcome;
}

}  // namespace

TangentialSolver::TangentialSolver() : workspace_(std::make_unique<Workspace>()) {}
TangentialSolver::~TangentialSolver() = default;
TangentialSolver::TangentialSolver(TangentialSolver&&) noexcept = default;
TangentialSolver& TangentialSolver::operator=(TangentialSolver&&) noexcept = default;

void TangentialSolver::reset() { workspace_->last.reset(); }

void TangentialSolver::solve(const ContactProblem& problem, ContactSolution& solution) {
  solution.tangential = {};
  if (problem.regime == Regime::frictionless) return;
  check(problem, solution);
  const std::size_t size = problem.grid.size();
  for (auto* field : {&solution.traction_x, &solution.traction_y, &solution.displacement_x, &solution.displacement_y,
                      &solution.slip_x, &solution.slip_y})
    field->assign(size, 0.0);
  solution.friction.assign(size, problem.friction.static_friction());
  if (solution.state.empty()) {
    solution.state.assign(size, ElementState::exterior);
    for (std::size_t i = 0; i < size; ++i)
      if (solution.pressure[i] > 0.0) solution.state[i] = ElementState::adhesion;
  }
  solution.creepage = problem.creepage;
  const Transport transport = transport_of(problem);
  const double step = transport == Transport::none ? 1.0 : problem.grid.dx;
  solution.rolling_step = transport == Transport::none ? 0.0 : step;

  const Patch patch = make_patch(problem.grid, transport, solution.state);
  const std::size_t n = patch.cell.size();
  if (n == 0) {
    solution.tangential.status = Status::no_contact;
    return;
  }
  std::vector<double> pressure(n);
  for (std::size_t i = 0; i < n; ++i) {
    pressure[i] = solution.pressure[patch.grid_index(static_cast<int>(i))];
    if (!std::isfinite(pressure[i])) refuse("a pressure is not finite", "solve the normal problem first");
  }
  PatchSolver solver(problem, patch, std::move(pressure), workspace_->cache);
  const bool warm = workspace_->start(problem, patch, solver);

  Outcome outcome;
  if (problem.fx_relative || problem.fy_relative) {
    std::optional<Creepage> estimate;
    if (warm && workspace_->last->force_prescribed) estimate = workspace_->last->creepage;
    outcome = solve_for_force(problem, solver, estimate);
  } else {
    outcome.creepage = problem.creepage;
    if (!solver.solve(problem.creepage, problem.settings.eps)) outcome.status = Status::not_converged;
  }
  if (outcome.status != Status::ok && outcome.message.empty())
    outcome.message =
        solver.friction_unsettled()
            ? "friction and slip velocity did not come to terms in " + std::to_string(problem.settings.max_outer) +
                  " rounds"
            : "the friction conditions are violated by " + std::to_string(solver.residual()) +
                  " of the friction bound after " + std::to_string(solver.steps()) + " Newton steps and " +
                  std::to_string(solver.sweeps()) + " sweeps";
  workspace_->store(problem, patch, solver, outcome.creepage);

  // Fields on the problem's grid.
  solution.creepage = outcome.creepage;
  solution.tangential = {outcome.status, solver.steps() + solver.sweeps(), solver.residual(), outcome.message};
  const FrictionState& state = solver.state();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = patch.grid_index(static_cast<int>(i));
    solution.traction_x[at] = state.traction[i];
    solution.traction_y[at] = state.traction[n + i];
    solution.slip_x[at] = state.slip[i] / step;
    solution.slip_y[at] = state.slip[n + i] / step;
    solution.friction[at] = solver.friction()[i];
    solution.state[at] = state.slipping[i] ? ElementState::slip : ElementState::adhesion;
  }
  std::vector<double> ux(solver.matrix().compliance().size()), uy(ux.size());
  solver.matrix().displacement_of_box(state.traction, ux, uy);
  for (int by = 0; by < patch.box_ny; ++by)
    for (int bx = 0; bx < patch.box_nx; ++bx) {
      const int ix = patch.box_x + bx, iy = patch.box_y + by;
      if (ix >= problem.grid.nx || iy >= problem.grid.ny) continue;
      const std::size_t from =
          static_cast<std::size_t>(bx) + static_cast<std::size_t>(patch.box_nx) * static_cast<std::size_t>(by);
      solution.displacement_x[problem.grid.index(ix, iy)] = ux[from];
      solution.displacement_y[problem.grid.index(ix, iy)] = uy[from];
    }
}

}  // namespace treadmark::kalker
