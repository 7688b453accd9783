// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/kalker/tangential/tangential_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/contact/theories.hpp"
#include "treadmark/solvers/kalker/tangential/backward_change.hpp"
#include "treadmark/solvers/kalker/tangential/creepage_search.hpp"
#include "treadmark/solvers/kalker/tangential/previous_instant.hpp"

namespace treadmark::kalker {

namespace {

constexpr double kSameSize = 1e-6;  ///< of the elements of two grids, relative

[[noreturn]] void refuse_problem(const std::string& message, const std::string& advice) {
  throw Error(ErrorKind::configuration, message, {}, advice);
}

void check(const ContactProblem& problem, const ContactSolution& solution) {
  const Grid2& grid = problem.grid;
  if (grid.nx < 1 || grid.ny < 1 || !(grid.dx > 0.0) || !(grid.dy > 0.0))
    refuse_problem("the contact grid has no elements", "give positive numbers and steps");
  if (solution.pressure.size() != grid.size())
    refuse_problem("the tangential problem needs a pressure for each of " + std::to_string(grid.size()) +
                       " elements, not " + std::to_string(solution.pressure.size()),
                   "solve the normal problem first");
  if (!solution.state.empty() && solution.state.size() != grid.size())
    refuse_problem("element states do not fit the contact grid", "solve the normal problem first");
  if (theory(problem.tangential_model).limits.steady_only && problem.regime != Regime::steady)
    refuse_problem("the linear theory is for steady rolling", "use the full tangential model");
  const CombinedMaterial combined = combine(problem.material);
  if (!(combined.shear_modulus > 0.0)) refuse_problem("the shear modulus must be positive", "check the material");
  const Creepage& c = problem.creepage;
  for (const double value :
       {c.xi, c.eta, c.phi, c.spin_x, c.spin_y, problem.fx_relative.value_or(0.0), problem.fy_relative.value_or(0.0)})
    if (!std::isfinite(value))
      refuse_problem("a creepage, spin centre or tangential force is not finite", "check the input");
  if (problem.extra_slip_x.size() != problem.extra_slip_y.size() ||
      (!problem.extra_slip_x.empty() && problem.extra_slip_x.size() != grid.size()))
    refuse_problem("the given slip does not have two values for each of " + std::to_string(grid.size()) + " elements",
                   "give one pair each, or none");
  if (!problem.friction_of_row.empty() && problem.friction_of_row.size() != static_cast<std::size_t>(grid.ny))
    refuse_problem("there are " + std::to_string(problem.friction_of_row.size()) + " friction laws for " +
                       std::to_string(grid.ny) + " rows",
                   "give one for each row, or one for all");
  if (!(problem.friction.static_friction() >= 0.0))
    refuse_problem("the coefficient of friction is negative", "check the friction law");
}

/// Index offset of `to` in `from`, to the nearest element: start values need not lie where they belong exactly.
std::optional<std::array<int, 2>> offset_between(const Grid2& from, const Grid2& to) {
  const auto close = [](double a, double b) { return std::abs(a - b) <= kSameSize * b; };
  if (!close(from.dx, to.dx) || !close(from.dy, to.dy)) return std::nullopt;
  const double ox = (to.x0 - from.x0) / to.dx, oy = (to.y0 - from.y0) / to.dy;
  // Grids that do not overlap have nothing to tell each other.
  if (!(ox > -to.nx && ox < from.nx && oy > -to.ny && oy < from.ny)) return std::nullopt;
  return std::array<int, 2>{to_whole<int>(std::round(ox)), to_whole<int>(std::round(oy))};
}

}  // namespace

struct TangentialSolver::Workspace {
  ComplianceCache cache;
  KernelStore kernels;
  OperatorStore operators;
  std::optional<TangentialStart> last;

  bool start(const ContactProblem& problem, const Patch& patch, PatchSolver& solver) const;
  void store(const ContactProblem& problem, const Patch& patch, const PatchSolver& solver, const Creepage& creepage);
};

bool TangentialSolver::Workspace::start(const ContactProblem& problem, const Patch& patch, PatchSolver& solver) const {
  if (!last || last->steady != (patch.transport != Transport::none) ||
      last->forward != (patch.transport != Transport::backward))
    return false;
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
  last->steady = patch.transport != Transport::none;
  last->forward = patch.transport != Transport::backward;
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

/// Plastic shear of the layer, the distances of before included.
void write_layer(const ContactProblem& problem, const Patch& patch, const PatchSolver& solver,
                 const ContactHistory& previous, ContactSolution& solution) {
  const std::size_t size = problem.grid.size(), n = patch.cell.size();
  const InterfaceLayer::Shear shear = solver.layer_shear();
  const FrictionState& state = solver.state();
  const RollingStep& step = solver.step();
  solution.yield_stress.assign(size, problem.material.layer_yield);
  const bool steady = step.transport != Transport::none;
  const auto before = [&](const std::vector<double>& field) {
    if (steady || field.empty()) return std::vector<double>(size, 0.0);
    return step.rolling ? carried(problem.grid, field, step.shift_x, step.shift_y, 0.0) : field;
  };
  solution.plastic_x = before(previous.plastic_x);
  solution.plastic_y = before(previous.plastic_y);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = patch.grid_index(static_cast<int>(i));
    if (steady && patch.ahead[i] >= 0) {
      const std::size_t from = patch.grid_index(patch.ahead[i]);
      solution.plastic_x[at] = solution.plastic_x[from];
      solution.plastic_y[at] = solution.plastic_y[from];
    }
    solution.yield_stress[at] = shear.yield[i];
    const double distance = std::hypot(state.slip[i], state.slip[n + i]);
    if (!state.slipping[i] || !(distance > 0.0) || !(shear.distance[i] > 0.0)) continue;
    // the layer shears along the traction, against what is left of the slip
    const double share = shear.distance[i] / distance;
    solution.plastic_x[at] -= share * state.slip[i];
    solution.plastic_y[at] -= share * state.slip[n + i];
    solution.slip_x[at] *= 1.0 - share;
    solution.slip_y[at] *= 1.0 - share;
    if (shear.only[i]) solution.state[at] = ElementState::plastic;
  }
}

/// Fields on the problem's grid.
void write_patch(const ContactProblem& problem, const Patch& patch, PatchSolver& solver, const ContactHistory& previous,
                 ContactSolution& solution) {
  const std::size_t n = patch.cell.size();
  const FrictionState& state = solver.state();
  const double distance = solver.step().distance;
  double dissipated = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = patch.grid_index(static_cast<int>(i));
    solution.traction_x[at] = state.traction[i];
    solution.traction_y[at] = state.traction[n + i];
    solution.slip_x[at] = state.slip[i] / distance;
    solution.slip_y[at] = state.slip[n + i] / distance;
    solution.friction[at] = solver.friction()[i];
    solution.state[at] = state.slipping[i] ? ElementState::slip : ElementState::adhesion;
    if (state.slipping[i]) dissipated += state.traction[i] * state.slip[i] + state.traction[n + i] * state.slip[n + i];
  }
  solution.frictional_power = dissipated * problem.grid.cell_area() / solver.step().time;
  if (problem.material.layer_yield > 0.0) write_layer(problem, patch, solver, previous, solution);
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

}  // namespace

TangentialSolver::TangentialSolver() : workspace_(std::make_unique<Workspace>()) {}
TangentialSolver::~TangentialSolver() = default;
TangentialSolver::TangentialSolver(TangentialSolver&&) noexcept = default;
TangentialSolver& TangentialSolver::operator=(TangentialSolver&&) noexcept = default;

void TangentialSolver::reset() { workspace_->last.reset(); }

std::optional<TangentialStart> TangentialSolver::start() const { return workspace_->last; }
void TangentialSolver::start_from(std::optional<TangentialStart> start) { workspace_->last = std::move(start); }

std::vector<double> TangentialSolver::normal_displacement(const ContactProblem& problem,
                                                          const ContactSolution& solution) {
  const KernelChoice kernel = workspace_->kernels.get(problem);
  if (!kernel.coupled || solution.traction_x.empty()) return {};
  return displacement_by_traction(problem, kernel, solution.traction_x, solution.traction_y, workspace_->operators);
}

bool TangentialSolver::couples(const ContactProblem& problem) { return workspace_->kernels.get(problem).coupled; }

void TangentialSolver::solve(const ContactProblem& problem, ContactSolution& solution, const ContactHistory& previous) {
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
  for (const double p : solution.pressure)
    if (!std::isfinite(p)) refuse_problem("a pressure is not finite", "solve the normal problem first");
  solution.creepage = problem.creepage;
  const RollingStep step = rolling_step(problem);
  solution.rolling_step = step.rolling ? step.distance : 0.0;

  const Patch patch = make_patch(problem.grid, step.transport, solution.state);
  if (patch.size() == 0) {
    solution.tangential.status = Status::no_contact;
    return;
  }
  const KernelChoice kernel = workspace_->kernels.get(problem);
  PatchConditions conditions =
      patch_conditions(problem, patch, step, kernel, solution.pressure, previous, workspace_->operators);
  for (int i = 0; i < patch.size() && !solution.temperature_1.empty(); ++i)
    conditions.temperature.push_back(solution.temperature_1[patch.grid_index(i)]);
  PatchSolver solver(problem, patch, std::move(conditions), workspace_->cache);
  const bool warm = workspace_->start(problem, patch, solver);
  if (problem.settings.first_slip != SolverSettings::FirstSlip::last)
    solver.set_slip_speed(problem.settings.first_slip == SolverSettings::FirstSlip::above ? problem.rolling.velocity
                                                                                          : 0.0);

  CreepageSearch outcome;
  if (problem.fx_relative || problem.fy_relative) {
    std::optional<Creepage> estimate;
    if (warm && workspace_->last->force_prescribed) estimate = workspace_->last->creepage;
    outcome = search_creepage(problem, solver, estimate);
  } else {
    outcome.creepage = problem.creepage;
    if (!solver.solve(problem.creepage, problem.settings.eps)) outcome.status = Status::not_converged;
  }
  if (theory(problem.tangential_model).limits.no_slip &&
      std::hypot(solver.relative_force()[0], solver.relative_force()[1]) > 1.0) {
    outcome.status = Status::not_converged;
    outcome.message = "the linear theory gives more force than friction: the creepage is beyond it";
  }
  if (outcome.status != Status::ok && outcome.message.empty())
    outcome.message = solver.friction_unsettled()
                          ? "friction did not converge with slip velocity in " +
                                std::to_string(problem.settings.max_outer) + " rounds"
                          : "the friction conditions are violated by " + std::to_string(solver.residual()) +
                                " of the friction bound after " + std::to_string(solver.steps()) +
                                " Newton steps and " + std::to_string(solver.sweeps()) + " sweeps";
  workspace_->store(problem, patch, solver, outcome.creepage);

  solution.creepage = outcome.creepage;
  solution.tangential = {outcome.status, solver.steps() + solver.sweeps(), solver.residual(), outcome.message};
  write_patch(problem, patch, solver, previous, solution);
  if (kernel.coupled)
    add_displacement_by_pressure(problem, kernel, solution.pressure, workspace_->operators, solution.displacement_x,
                                 solution.displacement_y);
}

Sensitivities TangentialSolver::sensitivities(const ContactProblem& problem, const ContactSolution& solution,
                                              const ContactHistory& previous,
                                              std::span<const double> pressure_by_approach) {
  if (solution.traction_x.size() != problem.grid.size() || pressure_by_approach.size() != problem.grid.size())
    refuse_problem("sensitivities need the solution of the same problem", "solve it first");
  const RollingStep step = rolling_step(problem);
  const Patch patch = make_patch(problem.grid, step.transport, solution.state);
  const std::size_t n = patch.cell.size();
  Sensitivities out;
  if (n == 0) return out;
  PatchSolver solver(problem, patch,
                     patch_conditions(problem, patch, step, workspace_->kernels.get(problem), solution.pressure,
                                      previous, workspace_->operators),
                     workspace_->cache);
  Field2 traction(2 * n);
  std::vector<double> friction(n), more_pressure(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = patch.grid_index(static_cast<int>(i));
    traction[i] = solution.traction_x[at];
    traction[n + i] = solution.traction_y[at];
    friction[i] = solution.friction[at];
    more_pressure[i] = pressure_by_approach[at];
  }
  solver.take(solution.creepage, std::move(traction), std::move(friction));
  const double area = problem.grid.cell_area();
  const auto sums = [&](const Field2& change) {
    std::array<double, 2> sum{};
    for (std::size_t i = 0; i < n; ++i) {
      sum[0] += change[i] * area;
      sum[1] += change[n + i] * area;
    }
    return sum;
  };
  Creepage unit;
  for (int k = 0; k < 3; ++k) {
    unit = {};
    unit.spin_x = solution.creepage.spin_x;
    unit.spin_y = solution.creepage.spin_y;
    (k == 0 ? unit.xi : k == 1 ? unit.eta : unit.phi) = 1.0;
    out.by_creepage[static_cast<std::size_t>(k)] = sums(solver.change_by_creepage(unit));
  }
  const std::array<double, 2> tangential = sums(solver.change_by_pressure(more_pressure));
  for (const double p : more_pressure) out.by_approach[0] += p * area;
  out.by_approach[1] = tangential[0];
  out.by_approach[2] = tangential[1];
  return out;
}

Gradient TangentialSolver::gradient(const ContactProblem& problem, const ContactSolution& solution,
                                    FieldWeights& weights) {
  const KernelChoice kernel = workspace_->kernels.get(problem);
  if (problem.tangential_model != TangentialModel::full || !friction_of(problem).constant() ||
      problem.material.layer_yield > 0.0 || problem.fx_relative || problem.fy_relative || kernel.coupled ||
      !kernel.kernel->symmetric())
    refuse_problem("tractions of this problem have no derivatives by the gap",
                   "use the full theory, Coulomb's friction, given creepages and equal elastic bodies");
  if (solution.traction_x.size() != problem.grid.size())
    refuse_problem("derivatives need the solution of the same problem", "solve it first");
  const RollingStep step = rolling_step(problem);
  const Patch patch = make_patch(problem.grid, step.transport, solution.state);
  const std::size_t n = patch.cell.size();
  Gradient out;
  if (n == 0) {
    out.report.status = Status::no_contact;
    return out;
  }
  Compliance& compliance = workspace_->cache.get(compliance_key(patch, problem.material, kernel.unusual()));
  const double diagonal = PatchOperator(patch, compliance).diagonal();
  const auto at = [](const std::vector<double>& field, std::size_t i) { return field.empty() ? 0.0 : field[i]; };
  FrictionState state;
  for (Field2* field : {&state.traction, &state.slip, &state.direction}) field->assign(2 * n, 0.0);
  std::vector<double> bound(n);
  Field2 by_traction(2 * n), by_slip(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t from = patch.grid_index(static_cast<int>(i));
    const double px = solution.traction_x[from], py = solution.traction_y[from], size = std::hypot(px, py);
    const double sx = step.distance * solution.slip_x[from], sy = step.distance * solution.slip_y[from];
    bound[i] = solution.friction[from] * solution.pressure[from];
    state.traction[i] = px, state.traction[n + i] = py;
    state.slipping.push_back(solution.state[from] == ElementState::slip);
    state.excess.push_back(state.slipping[i] ? std::hypot(sx, sy) / diagonal : 0.0);
    if (state.slipping[i]) {
      state.slip[i] = sx, state.slip[n + i] = sy;
      if (size > 0.0) state.direction[i] = px / size, state.direction[n + i] = py / size;
    }
    by_traction[i] = at(weights.traction_x, from), by_traction[n + i] = at(weights.traction_y, from);
    by_slip[i] = at(weights.slip_x, from) / step.distance, by_slip[n + i] = at(weights.slip_y, from) / step.distance;
  }
  const BackwardChange back = backward_change(patch, compliance, std::move(bound), std::move(state),
                                              std::move(by_traction), std::move(by_slip));
  out.report.iterations = back.products;
  out.report.residual = back.residual;
  if (!back.converged) {
    out.report.status = Status::not_converged;
    out.report.message = "derivatives by tractions did not reach their accuracy";
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t to = patch.grid_index(static_cast<int>(i));
    weights.pressure[to] += solution.friction[to] * back.by_bound[i];
    out.by_friction += solution.pressure[to] * back.by_bound[i];
  }
  const KnownSlip known =
      patch_conditions(problem, patch, step, kernel, solution.pressure, {}, workspace_->operators).known_slip;
  for (std::size_t k = 0; k < 3; ++k) {
    Creepage unit;
    unit.spin_x = solution.creepage.spin_x, unit.spin_y = solution.creepage.spin_y;
    (k == 0 ? unit.xi : k == 1 ? unit.eta : unit.phi) = 1.0;
    const Field2 slip = known.rigid(unit);
    out.by_creepage[k] = std::inner_product(slip.begin(), slip.end(), back.by_rigid_slip.begin(), 0.0);
  }
  return out;
}

void write(const TangentialStart& start, ByteWriter& out) {
  write(start.grid, out);
  for (const bool value : {start.steady, start.forward, start.force_prescribed}) out.put(value);
  for (const auto* field : {&start.traction_x, &start.traction_y, &start.bound, &start.slip_speed}) out.put(*field);
  const Creepage& c = start.creepage;
  for (const double value : {c.xi, c.eta, c.phi, c.spin_x, c.spin_y}) out.put(value);
}

TangentialStart read_tangential_start(ByteReader& in) {
  TangentialStart start;
  start.grid = read_grid(in);
  for (bool* value : {&start.steady, &start.forward, &start.force_prescribed}) in.get(*value);
  for (auto* field : {&start.traction_x, &start.traction_y, &start.bound, &start.slip_speed})
    read_field(in, start.grid, false, *field);
  Creepage& c = start.creepage;
  for (double* value : {&c.xi, &c.eta, &c.phi, &c.spin_x, &c.spin_y}) in.get(*value);
  return start;
}

}  // namespace treadmark::kalker
