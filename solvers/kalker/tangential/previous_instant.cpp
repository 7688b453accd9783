// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/previous_instant.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::kalker {

namespace {

constexpr std::size_t kMostOperators = 24;

/// Steps next to the usual one, of which they differ by this share.
constexpr double kNodes = 2e-3;

/// A rectangle of a grid that holds all elements that matter, its size rounded up so that it is met again.
struct Box {
  int x = 0, y = 0, nx = 0, ny = 0;
};

/// Now or then there are tractions only where there are pressures.
Box box_around(const Patch& patch, std::span<const double> pressure, std::span<const double> pressure_then) {
  const Grid2& grid = patch.grid;
  int x0 = grid.nx, x1 = -1, y0 = grid.ny, y1 = -1;
  const auto include = [&](int ix, int iy) {
    x0 = std::min(x0, ix);
    x1 = std::max(x1, ix);
    y0 = std::min(y0, iy);
    y1 = std::max(y1, iy);
  };
  for (const auto& field : {pressure, pressure_then})
    for (int iy = 0; iy < grid.ny && !field.empty(); ++iy)
      for (int ix = 0; ix < grid.nx; ++ix)
        if (field[grid.index(ix, iy)] != 0.0) include(ix, iy);
  for (int i = 0; i < patch.size(); ++i)
    include(patch.column[static_cast<std::size_t>(i)], patch.row[static_cast<std::size_t>(i)]);
  Box out{x0, y0, roomy_columns(x1 - x0 + 1), roomy_rows(y1 - y0 + 1)};
  out.nx = std::max(out.nx, x1 - x0 + 1);
  out.ny = std::max(out.ny, y1 - y0 + 1);
  return out;
}

std::vector<double> cut(const Grid2& grid, const Box& box, std::span<const double> field) {
  std::vector<double> out(static_cast<std::size_t>(box.nx) * static_cast<std::size_t>(box.ny));
  for (int iy = 0; iy < box.ny && box.y + iy < grid.ny; ++iy)
    for (int ix = 0; ix < box.nx && box.x + ix < grid.nx; ++ix)
      out[static_cast<std::size_t>(iy) * static_cast<std::size_t>(box.nx) + static_cast<std::size_t>(ix)] =
          field[grid.index(box.x + ix, box.y + iy)];
  return out;
}

/// Values of a box at the elements of a patch, times factor, added to one component.
void add_to_patch(const Patch& patch, const Box& box, const std::vector<double>& ux, const std::vector<double>& uy,
                  double factor, Field2& out) {
  const std::size_t n = patch.cell.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = static_cast<std::size_t>(patch.row[i] - box.y) * static_cast<std::size_t>(box.nx) +
                           static_cast<std::size_t>(patch.column[i] - box.x);
    out[i] += factor * ux[at];
    out[n + i] += factor * uy[at];
  }
}

/// How much of the step the material of each element has been in contact: less than 1 where the step is longer than the
/// way from the leading edge, which lies one element ahead of the last one in contact. Empty if it is 1 everywhere.
std::vector<double> share_of_step(const Patch& patch, const RollingStep& step) {
  const Grid2& grid = patch.grid;
  constexpr double kWhole = 0.9999;
  std::vector<char> contact(grid.size(), 0);
  for (int i = 0; i < patch.size(); ++i) contact[patch.grid_index(i)] = 1;
  const double cx = step.shift_x / step.distance, cy = step.shift_y / step.distance;
  const double element = std::min(std::fabs(cx) > 1e-9 ? grid.dx / std::fabs(cx) : 1e30,
                                  std::fabs(cy) > 1e-9 ? grid.dy / std::fabs(cy) : 1e30);
  std::vector<double> out(patch.cell.size(), 1.0);
  bool any = false;
  for (std::size_t i = 0; i < out.size(); ++i) {
    // elements passed on the way ahead
    int steps = 0;
    for (; steps <= grid.nx + grid.ny; ++steps) {
      const long ix = patch.column[i] + to_whole<long>(std::round((steps + 1) * element * cx / grid.dx)),
                 iy = patch.row[i] + to_whole<long>(std::round((steps + 1) * element * cy / grid.dy));
      if (ix < 0 || iy < 0 || ix >= grid.nx || iy >= grid.ny ||
          contact[grid.index(static_cast<int>(ix), static_cast<int>(iy))] == 0)
        break;
      if (steps * element > step.distance) break;
    }
    const double share = (steps + 1) * element / step.distance;
    if (share >= kWhole) continue;
    out[i] = share;
    any = true;
  }
  if (!any) out.clear();
  return out;
}

}  // namespace

InfluenceOperator& OperatorStore::get(int nx, int ny, const Grid2& grid, double shear_modulus,
                                      const std::shared_ptr<const InfluenceKernel>& kernel, double shift_x,
                                      double shift_y) {
  for (auto it = entries_.begin(); it != entries_.end(); ++it)
    if (it->nx == nx && it->ny == ny && it->dx == grid.dx && it->dy == grid.dy && it->shear_modulus == shear_modulus &&
        it->shift_x == shift_x && it->shift_y == shift_y && it->kernel == kernel) {
      entries_.splice(entries_.begin(), entries_, it);
      return entries_.front().product;
    }
  entries_.push_front({nx, ny, grid.dx, grid.dy, shear_modulus, shift_x, shift_y, kernel,
                       InfluenceOperator(nx, ny, grid.dx, grid.dy, shear_modulus, kernel, shift_x, shift_y)});
  if (entries_.size() > kMostOperators) entries_.pop_back();
  return entries_.front().product;
}

namespace {

/// Displacements by tractions of the instant before where material was a step ago. Coefficients for a step that
/// nobody met before cost more than all else; close to the usual step they are a parabola through three that are kept.
/// False: the step is another one.
bool interpolated_displacement(const ContactProblem& problem, const RollingStep& step, const Box& box,
                               const KernelChoice& kernel, OperatorStore& operators, const std::vector<double>& px,
                               const std::vector<double>& py, std::vector<double>& ux, std::vector<double>& uy) {
  const double usual = problem.rolling.usual_step;
  if (!(usual > 0.0) || !step.rolling) return false;
  const double t = (step.distance / usual - 1.0) / kNodes;
  if (!(std::abs(t) <= 1.0)) return false;
  const double g = combine(problem.material).shear_modulus;
  std::array<InfluenceOperator*, 3> nodes{};
  for (int k = 0; k < 3; ++k) {
    const double node = usual * (1.0 + (k - 1) * kNodes);
    nodes[static_cast<std::size_t>(k)] =
        &operators.get(box.nx, box.ny, problem.grid, g, kernel.kernel, node * (step.shift_x / step.distance),
                       node * (step.shift_y / step.distance));
  }
  const std::array<double, 3> weights{0.5 * t * (t - 1.0), 1.0 - t * t, 0.5 * t * (t + 1.0)};
  InfluenceOperator::tangential_by_tangential(nodes, weights, px, py, ux, uy);
  return true;
}

}  // namespace

PatchConditions patch_conditions(const ContactProblem& problem, const Patch& patch, const RollingStep& step,
                                 const KernelChoice& kernel, std::span<const double> pressure,
                                 const ContactHistory& previous, OperatorStore& operators) {
  const Grid2& grid = problem.grid;
  const std::size_t n = patch.cell.size();
  const double g = combine(problem.material).shear_modulus;
  PatchConditions out;
  out.kernel = kernel.unusual();
  out.rows = kernel.rows(grid, patch.box_y, patch.box_ny);
  out.pressure.resize(n);
  for (std::size_t i = 0; i < n; ++i) out.pressure[i] = pressure[patch.grid_index(static_cast<int>(i))];
  KnownSlip& known = out.known_slip;
  known.patch = &patch;
  known.step = step;
  known.spin_offset_factor = step.rolling ? problem.rolling.spin_offset_factor : 0.0;
  const bool steady = step.transport != Transport::none, history = !steady && !previous.empty();
  if (step.rolling && !steady) known.share = share_of_step(patch, step);
  const bool given = !problem.extra_slip_x.empty();
  if (!given && !history && !kernel.coupled) return out;
  known.other.assign(2 * n, 0.0);

  if (given)
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t at = patch.grid_index(static_cast<int>(i));
      known.other[i] += step.distance * problem.extra_slip_x[at];
      known.other[n + i] += step.distance * problem.extra_slip_y[at];
    }
  // Displacements now by pressures of dissimilar bodies, and displacements of the same material a step ago.
  const ContactHistory& then = previous;
  const Box box =
      box_around(patch, pressure, history ? std::span<const double>(then.pressure) : std::span<const double>{});
  const std::size_t size = static_cast<std::size_t>(box.nx) * static_cast<std::size_t>(box.ny);
  const std::optional<RowInclination> inclination = kernel.rows(grid, box.y, box.ny);
  const RowInclination* rows = inclination ? &*inclination : nullptr;
  std::vector<double> ux(size), uy(size), before_x(size, 0.0), before_y(size, 0.0), edge_x, edge_y;
  if (kernel.coupled) {
    const std::vector<double> p = cut(grid, box, pressure);
    operators.get(box.nx, box.ny, grid, g, kernel.kernel, 0.0, 0.0).tangential_by_normal(p, ux, uy, rows);
    add_to_patch(patch, box, ux, uy, 1.0, known.other);
    if (steady)
      operators.get(box.nx, box.ny, grid, g, kernel.kernel, step.shift_x, step.shift_y)
          .tangential_by_normal(p, before_x, before_y, rows);
  }
  if (history) {
    const std::vector<double> px = cut(grid, box, then.traction_x), py = cut(grid, box, then.traction_y);
    const auto displacement = [&](double shift_x, double shift_y, std::vector<double>& x, std::vector<double>& y) {
      x.assign(size, 0.0);
      y.assign(size, 0.0);
      const bool moved = shift_x != 0.0 || shift_y != 0.0, plain = !rows && !kernel.coupled;
      if (!(moved && plain && interpolated_displacement(problem, step, box, kernel, operators, px, py, x, y)))
        operators.get(box.nx, box.ny, grid, g, kernel.kernel, shift_x, shift_y)
            .tangential_by_tangential(px, py, x, y, rows);
      if (kernel.coupled) {
        operators.get(box.nx, box.ny, grid, g, kernel.kernel, shift_x, shift_y)
            .tangential_by_normal(cut(grid, box, then.pressure), ux, uy, rows);
        for (std::size_t k = 0; k < size; ++k) {
          x[k] += ux[k];
          y[k] += uy[k];
        }
      }
      if (problem.material.layer_flexibility > 0.0) {
        const double l = problem.material.layer_flexibility;
        const std::vector<double> lx = cut(grid, box, carried(grid, then.traction_x, shift_x, shift_y, 0.0)),
                                  ly = cut(grid, box, carried(grid, then.traction_y, shift_x, shift_y, 0.0));
        for (std::size_t k = 0; k < size; ++k) {
          x[k] += l * lx[k];
          y[k] += l * ly[k];
        }
      }
    };
    displacement(step.shift_x, step.shift_y, before_x, before_y);
    if (!known.share.empty()) displacement(0.0, 0.0, edge_x, edge_y);
  }
  add_to_patch(patch, box, before_x, before_y, -1.0, known.other);
  // Material that has come in during the step had the displacement of the leading edge when it did.
  for (std::size_t i = 0; i < known.share.size() && history; ++i) {
    if (known.share[i] >= 1.0) continue;
    const double way = known.share[i] * step.distance;
    const int ix = std::clamp(
                  patch.column[i] - box.x + to_whole<int>(std::round(way * step.shift_x / step.distance / grid.dx)), 0,
                  box.nx - 1),
              iy = std::clamp(
                  patch.row[i] - box.y + to_whole<int>(std::round(way * step.shift_y / step.distance / grid.dy)), 0,
                  box.ny - 1);
    const std::size_t at = static_cast<std::size_t>(iy) * static_cast<std::size_t>(box.nx) +
                           static_cast<std::size_t>(ix),
                      own = static_cast<std::size_t>(patch.row[i] - box.y) * static_cast<std::size_t>(box.nx) +
                            static_cast<std::size_t>(patch.column[i] - box.x);
    known.other[i] += before_x[own] - edge_x[at];
    known.other[n + i] += before_y[own] - edge_y[at];
  }

  if (!history) return out;
  const auto of_material = [&](const std::vector<double>& field, double outside) {
    std::vector<double> values(n, outside);
    if (field.empty()) return values;
    const std::vector<double> moved = step.rolling ? carried(grid, field, step.shift_x, step.shift_y, outside) : field;
    for (std::size_t i = 0; i < n; ++i) values[i] = moved[patch.grid_index(static_cast<int>(i))];
    return values;
  };
  out.friction_before = of_material(then.friction, problem.friction.static_friction());
  if (problem.material.layer_yield > 0.0)
    out.yield_before = of_material(then.yield_stress, problem.material.layer_yield);
  return out;
}

void add_displacement_by_pressure(const ContactProblem& problem, const KernelChoice& kernel,
                                  std::span<const double> pressure, OperatorStore& operators, std::span<double> ux,
                                  std::span<double> uy) {
  const Grid2& grid = problem.grid;
  std::vector<double> x(grid.size()), y(grid.size());
  const std::optional<RowInclination> rows = kernel.rows(grid, 0, grid.ny);
  operators.get(grid.nx, grid.ny, grid, combine(problem.material).shear_modulus, kernel.kernel, 0.0, 0.0)
      .tangential_by_normal(pressure, x, y, rows ? &*rows : nullptr);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    ux[i] += x[i];
    uy[i] += y[i];
  }
}

std::vector<double> displacement_by_traction(const ContactProblem& problem, const KernelChoice& kernel,
                                             std::span<const double> px, std::span<const double> py,
                                             OperatorStore& operators) {
  const Grid2& grid = problem.grid;
  std::vector<double> u(grid.size());
  const std::optional<RowInclination> rows = kernel.rows(grid, 0, grid.ny);
  operators.get(grid.nx, grid.ny, grid, combine(problem.material).shear_modulus, kernel.kernel, 0.0, 0.0)
      .normal_by_tangential(px, py, u, rows ? &*rows : nullptr);
  return u;
}

}  // namespace treadmark::kalker
