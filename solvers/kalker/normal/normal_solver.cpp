// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/kalker/normal/normal_solver.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <string>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/solvers/kalker/normal/assumed_pressure.hpp"
#include "treadmark/solvers/kalker/normal/bound_constrained_cg.hpp"
#include "treadmark/solvers/kalker/normal/contact_estimate.hpp"
#include "treadmark/solvers/kalker/normal/contact_stiffness.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/solvers/kalker/normal/interpenetration.hpp"
#include "treadmark/solvers/kalker/normal/normal_operator.hpp"
#include "treadmark/solvers/kalker/normal/virtual_penetration.hpp"

namespace treadmark::kalker {

namespace {

/// Elements around the estimated contact that may become part of it without a new box.
constexpr int kMargin = 2;

/// More elements than this are neither copied for a mere chance nor is their work memory kept.
constexpr std::size_t kManyElements = 65536;

[[noreturn]] void refuse(const std::string& message, const std::string& advice = {}) {
  throw Error(ErrorKind::configuration, "normal contact: " + message, {}, advice);
}

void check(const ContactProblem& problem) {
  const Grid2& grid = problem.grid;
  if (grid.nx < 1 || grid.ny < 1 || !(grid.dx > 0.0) || !(grid.dy > 0.0) || !std::isfinite(grid.dx * grid.dy))
    refuse("the grid has " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) + " elements of " +
               std::to_string(grid.dx) + " x " + std::to_string(grid.dy) + " m",
           "numbers and sizes must be positive");
  if (problem.normal_model == NormalModel::full && problem.gap.size() != grid.size())
    refuse("the gap has " + std::to_string(problem.gap.size()) + " values for " + std::to_string(grid.size()) +
           " elements");
  const Material& m = problem.material;
  for (const double g : {m.shear_modulus_1, m.shear_modulus_2})
    if (!(g > 0.0)) refuse("a shear modulus is " + std::to_string(g) + " Pa", "it must be positive");
  for (const double nu : {m.poisson_1, m.poisson_2})
    if (!(nu > -1.0 && nu <= 0.5)) refuse("Poisson's ratio is " + std::to_string(nu), "use a value from 0 to 0.5");
  if (problem.force_prescribed && !(problem.normal_force >= 0.0 && std::isfinite(problem.normal_force)))
    refuse("the normal force is " + std::to_string(problem.normal_force) + " N", "it must not be negative");
  if (!problem.force_prescribed && !std::isfinite(problem.approach))
    refuse("the approach is " + std::to_string(problem.approach) + " m");
  if (!(problem.settings.eps > 0.0) || problem.settings.max_iterations < 1)
    refuse("the accuracy and the number of iterations must be positive");
}

/// Box of the elements of a grid for which a condition on the index holds.
template <class Condition>
ElementBox bounding_box(const Grid2& grid, const Condition& condition) {
  ElementBox box;
  for (int iy = 0; iy < grid.ny; ++iy) {
    const std::size_t row = grid.index(0, iy);
    int first = 0, last = grid.nx - 1;
    while (first < grid.nx && !condition(row + static_cast<std::size_t>(first))) ++first;
    if (first == grid.nx) continue;
    while (!condition(row + static_cast<std::size_t>(last))) --last;
    box.include(first, iy);
    box.include(last, iy);
  }
  return box;
}

/// One direction of a box: with margins, then grown to a size that transforms like, and moved into 0 .. limit.
void round_interval(int& begin, int& end, int limit, int (*roomy)(int)) {
  begin = std::max(0, begin - kMargin);
  end = std::min(limit, end + kMargin);
  const int size = std::min(limit, roomy(end - begin));
  begin = std::max(0, begin - (size - (end - begin)) / 2);
  end = std::min(limit, begin + size);
  begin = end - size;
}

ElementBox rounded(ElementBox box, const Grid2& grid) {
  round_interval(box.x0, box.x1, grid.nx, roomy_columns);
  round_interval(box.y0, box.y1, grid.ny, roomy_rows);
  return box;
}

AlignedVector<double> cut(const Grid2& grid, std::span<const double> field, const ElementBox& box) {
  AlignedVector<double> part;
  part.reserve(box.size());
  for (int iy = box.y0; iy < box.y1; ++iy) {
    const auto row = field.begin() + static_cast<std::ptrdiff_t>(grid.index(box.x0, iy));
    part.insert(part.end(), row, row + box.nx());
  }
  return part;
}

void paste(const Grid2& grid, std::span<double> field, const ElementBox& box, const AlignedVector<double>& part) {
  auto source = part.begin();
  for (int iy = box.y0; iy < box.y1; ++iy, source += box.nx())
    std::copy(source, source + box.nx(), field.begin() + static_cast<std::ptrdiff_t>(grid.index(box.x0, iy)));
}

}  // namespace

/// The last problem that was solved without start values. Cases that differ in creepage alone ask for it again.
struct LastCold {
  ContactProblem problem;
  std::vector<double> gap;  ///< what problem.gap showed
  ContactSolution solution;

  bool answers(const ContactProblem& p) const {
    const auto load = [](const ContactProblem& q) { return q.force_prescribed ? q.normal_force : q.approach; };
    const ContactProblem& q = problem;
    return !gap.empty() && p.grid == q.grid && p.force_prescribed == q.force_prescribed && load(p) == load(q) &&
           p.material == q.material && p.influence == q.influence && p.settings == q.settings && p.regime == q.regime &&
           p.rolling == q.rolling && p.hertz == q.hertz && p.gap.size() == gap.size() &&
           std::memcmp(p.gap.data(), gap.data(), p.gap.size_bytes()) == 0;  // bits: NaN means something
  }
  void keep(const ContactProblem& p, const ContactSolution& found) {
    gap.clear();
    if (p.gap.size() > kManyElements || found.status != Status::ok) return;
    problem = p;
    problem.gap = problem.extra_slip_x = problem.extra_slip_y = {};
    gap.assign(p.gap.begin(), p.gap.end());
    solution = found;
  }
};

struct NormalSolver::Workspace {
  LastCold last_cold;
  NormalOperatorCache operators;
  BoundConstrainedCg cg;
  std::vector<double> gap;  ///< without NaN
  Grid2 last_grid;
  std::vector<double> last_pressure;  ///< on last_grid; empty = none

  /// Pressures of the last problem on another grid, to the nearest element; false if there are none or elements are of
  /// another size.
  bool take_last(const Grid2& grid, std::vector<double>& pressure) const;
  void solve_full(const ContactProblem& problem, const CombinedMaterial& material, ContactSolution& solution);
  void solve_full_or_recall(const ContactProblem& problem, ContactSolution& solution);
  void first_pressure(const ContactProblem& problem, const CombinedMaterial& material,
                      std::vector<double>& pressure) const;
  PressureOnArea on_contact(const ContactProblem& problem, const ContactSolution& solution, std::span<const double> f,
                            std::optional<double> sum, std::vector<double>& q);
};

bool NormalSolver::Workspace::take_last(const Grid2& grid, std::vector<double>& pressure) const {
  if (last_pressure.empty() || grid.dx != last_grid.dx || grid.dy != last_grid.dy) return false;
  const double shift_x = (grid.x0 - last_grid.x0) / grid.dx, shift_y = (grid.y0 - last_grid.y0) / grid.dy;
  if (std::abs(shift_x) > 1e6 || std::abs(shift_y) > 1e6) return false;
  const int sx = to_whole<int>(std::round(shift_x)), sy = to_whole<int>(std::round(shift_y));
  bool any = false;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const int jx = ix + sx, jy = iy + sy;
      if (jx < 0 || jy < 0 || jx >= last_grid.nx || jy >= last_grid.ny) continue;
      const std::size_t i = grid.index(ix, iy);
      pressure[i] = gap[i] < kNeverInContact ? last_pressure[last_grid.index(jx, jy)] : 0.0;
      any = any || pressure[i] > 0.0;
    }
  return any;
}

/// Semi-ellipsoidal pressure of arbitrary size over the elements that are thought to be in contact.
void NormalSolver::Workspace::first_pressure(const ContactProblem& problem, const CombinedMaterial& material,
                                             std::vector<double>& pressure) const {
  if (problem.hertz && !is_line_contact(*problem.hertz) && problem.hertz->semi_axis_x > 0.0) {
    bool any = false;
    for (int iy = 0; iy < problem.grid.ny; ++iy)
      for (int ix = 0; ix < problem.grid.nx; ++ix) {
        const std::size_t i = problem.grid.index(ix, iy);
        if (gap[i] >= kNeverInContact) continue;
        pressure[i] = hertz_pressure(*problem.hertz, problem.grid.x(ix), problem.grid.y(iy));
        any = any || pressure[i] > 0.0;
      }
    if (any) return;
  }
  const ContactEstimate estimate = estimate_contact(problem, gap, material);
  for (std::size_t i = 0; i < gap.size(); ++i) {
    const double depth = gap[i] - estimate.least_gap;
    // The element of least gap belongs to the contact however small that is.
    if (depth <= 0.0)
      pressure[i] = 1.0;
    else if (depth < estimate.threshold)
      pressure[i] = std::sqrt(1.0 - depth / estimate.threshold);
  }
}

void NormalSolver::Workspace::solve_full(const ContactProblem& problem, const CombinedMaterial& material,
                                         ContactSolution& solution) {
  const Grid2& grid = problem.grid;
  gap.assign(problem.gap.begin(), problem.gap.end());
  for (double& h : gap)
    if (std::isnan(h) || h > kNeverInContact) h = kNeverInContact;
  for (const double h : gap)
    if (h < -kNeverInContact) refuse("the gap is not finite");

  const auto report_no_contact = [&] {
    solution.status = solution.normal.status = Status::no_contact;
    last_pressure.clear();
  };
  solution.approach = problem.force_prescribed ? 0.0 : problem.approach;
  const double least_gap = *std::min_element(gap.begin(), gap.end());
  const bool contact = problem.force_prescribed ? problem.normal_force > 0.0 : least_gap < problem.approach;
  if (!contact || least_gap >= kNeverInContact) return report_no_contact();

  std::vector<double>& pressure = solution.pressure;
  if (!take_last(grid, pressure)) first_pressure(problem, material, pressure);

  const auto op = [&](const ElementBox& box) { return operators.get(box.nx(), box.ny(), box.y0, problem); };
  ElementBox box = rounded(bounding_box(grid, [&](std::size_t i) { return pressure[i] > 0.0; }), grid);
  cg.iterations = cg.products = 0;
  cg.approach = problem.approach;
  BoundConstrainedCg::Outcome outcome = BoundConstrainedCg::Outcome::iteration_limit;
  // Every box holds the one before it and at least a row or a column more.
  for (int left = grid.nx + grid.ny; left >= 0; --left) {
    if (left == 0) {
      outcome = BoundConstrainedCg::Outcome::iteration_limit;
      break;
    }
    const AlignedVector<double> box_gap = cut(grid, gap, box);
    cg.p = cut(grid, pressure, box);
    const NormalOperator box_operator = op(box);
    BoxProblem part;
    part.op = &box_operator;
    part.gap = box_gap;
    part.nx = box.nx();
    part.ny = box.ny();
    part.sum_prescribed = problem.force_prescribed;
    part.pressure_sum = problem.normal_force / grid.cell_area();
    part.eps = problem.settings.eps;
    part.max_iterations = problem.settings.max_iterations - cg.iterations;
    part.open_left = box.x0 > 0;
    part.open_right = box.x1 < grid.nx;
    part.open_low = box.y0 > 0;
    part.open_high = box.y1 < grid.ny;
    outcome = cg.solve(part);
    paste(grid, pressure, box, cg.p);
    if (outcome == BoundConstrainedCg::Outcome::box_too_small) {
      // By a share of its size, so that a bad first estimate costs few boxes.
      const int more_x = 1 + box.nx() / 8, more_y = 1 + box.ny() / 8;
      const ElementBox larger{std::max(0, box.x0 - more_x), std::max(0, box.y0 - more_y),
                              std::min(grid.nx, box.x1 + more_x), std::min(grid.ny, box.y1 + more_y)};
      box = rounded(larger, grid);
      continue;
    }
    if (outcome != BoundConstrainedCg::Outcome::converged) break;

    // Outside the box only elements below the approach can overlap, because u is nowhere negative. Check these.
    ElementBox whole = bounding_box(grid, [&](std::size_t i) { return gap[i] < cg.approach; });
    if (box.contains(whole)) {
      paste(grid, solution.displacement_n, box, cg.u);
      break;
    }
    std::vector<std::size_t> beside;
    for (int iy = whole.y0; iy < whole.y1; ++iy)
      for (int ix = whole.x0; ix < whole.x1; ++ix)
        if (gap[grid.index(ix, iy)] < cg.approach && !box.contains(ElementBox{ix, iy, ix + 1, iy + 1}))
          beside.push_back(grid.index(ix, iy));
    paste(grid, solution.displacement_n, box, cg.u);
    if (!sum_half_space_displacement(operators, problem, box, pressure, beside, solution.displacement_n)) {
      whole.include(box);
      half_space_displacement(operators, problem, rounded(whole, grid), pressure, solution.displacement_n);
      ++cg.products;
    }
    const double limit = cg.approach - cg.negligible_overlap(problem.settings.eps);
    const auto width = static_cast<std::size_t>(grid.nx);
    ElementBox overlapping;
    for (const std::size_t i : beside)
      if (gap[i] + solution.displacement_n[i] < limit)
        overlapping.include(static_cast<int>(i % width), static_cast<int>(i / width));
    if (overlapping.empty()) break;
    overlapping.include(box);
    box = rounded(overlapping, grid);
  }

  if (outcome == BoundConstrainedCg::Outcome::no_contact) return report_no_contact();
  solution.approach = cg.approach;
  solution.normal.iterations = cg.iterations;
  solution.normal.residual = cg.residual;
  if (outcome == BoundConstrainedCg::Outcome::iteration_limit) {
    solution.status = solution.normal.status = Status::not_converged;
    solution.normal.message =
        "the normal problem did not reach the accuracy in " + std::to_string(cg.iterations) + " iterations";
    paste(grid, solution.displacement_n, box, cg.u);
  }
  last_grid = grid;
  last_pressure = pressure;
  if (grid.size() <= kManyElements) return;
  cg = {};
  gap = {};
}

void NormalSolver::Workspace::solve_full_or_recall(const ContactProblem& problem, ContactSolution& solution) {
  const bool cold = last_pressure.empty();
  if (cold && last_cold.answers(problem)) {
    solution = last_cold.solution;
    last_grid = problem.grid;
    last_pressure = solution.pressure;
    return;
  }
  solve_full(problem, combine(problem.material), solution);
  if (cold) last_cold.keep(problem, solution);
}

NormalSolver::NormalSolver() : workspace_(std::make_unique<Workspace>()) {}
NormalSolver::~NormalSolver() = default;
NormalSolver::NormalSolver(NormalSolver&&) noexcept = default;
NormalSolver& NormalSolver::operator=(NormalSolver&&) noexcept = default;

void NormalSolver::reset() { workspace_->last_pressure.clear(); }

NormalStart NormalSolver::start() const { return {workspace_->last_grid, workspace_->last_pressure}; }

void NormalSolver::start_from(NormalStart start) {
  workspace_->last_grid = start.grid;
  workspace_->last_pressure = std::move(start.pressure);
}

/// Pressures that stay within the contact of a solution: A q = f - c there. q: a field of the grid's size.
PressureOnArea NormalSolver::Workspace::on_contact(const ContactProblem& problem, const ContactSolution& solution,
                                                   std::span<const double> f, std::optional<double> sum,
                                                   std::vector<double>& q) {
  const Grid2& grid = problem.grid;
  if (solution.pressure.size() != grid.size())
    refuse("the pressures belong to another grid", "solve the problem first");
  q.assign(grid.size(), 0.0);
  std::vector<double> inside(grid.size(), 0.0);
  for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = solution.pressure[i] > 0.0 ? 1.0 : 0.0;
  const ElementBox whole = bounding_box(grid, [&](std::size_t i) { return inside[i] > 0.0; });
  if (whole.empty()) return {};
  const ElementBox box = rounded(whole, grid);
  const NormalOperator op = operators.get(box.nx(), box.ny(), box.y0, problem);
  const AlignedVector<double> area = cut(grid, inside, box);
  AlignedVector<double> right = f.empty() ? area : cut(grid, f, box);
  for (std::size_t i = 0; i < right.size(); ++i) right[i] *= area[i];
  constexpr double kAccuracy = 1e-8;
  PressureOnArea found = pressure_on_area(op, area, right, sum, kAccuracy);
  paste(grid, q, box, found.q);
  return found;
}

std::vector<double> NormalSolver::pressure_by_approach(const ContactProblem& problem, const ContactSolution& solution) {
  std::vector<double> out;
  workspace_->on_contact(problem, solution, {}, {}, out);
  return out;
}

Gradient NormalSolver::gradient_by_gap(const ContactProblem& problem, const ContactSolution& solution,
                                       std::span<const double> by_pressure, double by_approach) {
  if (by_pressure.size() != problem.grid.size())
    refuse("there are " + std::to_string(by_pressure.size()) + " derivatives by the pressure of " +
           std::to_string(problem.grid.size()) + " elements");
  if (problem.normal_model != NormalModel::full)
    refuse("approximate pressures have no derivatives by the gap", "use the full normal problem");
  if (problem.sub_patches.count > 1) refuse("parts that share an influence have no derivatives by the gap");
  if (!workspace_->operators.symmetric(problem))
    refuse("coefficients of influence that are not symmetric have no derivatives by the gap");
  Gradient out;
  const std::optional<double> sum = problem.force_prescribed ? std::optional(-by_approach) : std::nullopt;
  const PressureOnArea found = workspace_->on_contact(problem, solution, by_pressure, sum, out.by_gap);
  out.report.iterations = found.iterations;
  out.report.residual = found.residual;
  if (found.q.empty()) {
    out.report.status = Status::no_contact;
    return out;
  }
  if (!found.converged) {
    out.report.status = Status::not_converged;
    out.report.message = "derivatives by the gap did not reach their accuracy";
  }
  out.by_load = problem.force_prescribed ? found.shift / problem.grid.cell_area()
                                         : by_approach + std::accumulate(out.by_gap.begin(), out.by_gap.end(), 0.0);
  for (double& value : out.by_gap) value = -value;
  return out;
}

void NormalSolver::solve(const ContactProblem& problem, ContactSolution& solution) {
  check(problem);
  const std::size_t n = problem.grid.size();
  solution = ContactSolution();
  solution.pressure.assign(n, 0.0);
  solution.displacement_n.assign(n, 0.0);
  solution.state.assign(n, ElementState::exterior);
  if (problem.normal_model == NormalModel::full)
    workspace_->solve_full_or_recall(problem, solution);
  else if (problem.normal_model == NormalModel::kpec || problem.normal_model == NormalModel::analyn)
    solve_virtual_penetration(problem, workspace_->operators, solution);
  else
    assume_pressure(problem, workspace_->operators, solution);

  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double p = solution.pressure[i];
    if (!(p > 0.0)) continue;
    solution.state[i] = ElementState::adhesion;
    ++solution.elements_contact;
    sum += p;
    solution.max_pressure = std::max(solution.max_pressure, p);
  }
  solution.elements_adhesion = solution.elements_contact;
  solution.force_n = sum * problem.grid.cell_area();
}

void write(const NormalStart& start, ByteWriter& out) {
  write(start.grid, out);
  out.put(start.pressure);
}

NormalStart read_normal_start(ByteReader& in) {
  NormalStart start;
  start.grid = read_grid(in);
  read_field(in, start.grid, true, start.pressure);
  return start;
}

}  // namespace treadmark::kalker
