// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/nested_start.hpp"

#include <array>
#include <cmath>

namespace treadmark::kalker {

namespace {

constexpr int kSmallPatch = 400;    ///< elements; below, Newton's method from zero is as fast
constexpr double kAccuracy = 3e-3;  ///< of the coarse problem; its discretisation error is larger
constexpr int kCoarseSweeps = 8;

}  // namespace

Field2 nested_start(const Patch& patch, const ComplianceKey& key, std::span<const double> bound,
                    const Field2& known_slip, ComplianceCache& cache) {
  const std::size_t n = patch.cell.size();
  Field2 start(2 * n);
  if (patch.size() < kSmallPatch) return start;

  // Coarse elements are pairs of columns and, unless there is one row only, of rows.
  const Grid2& fine = patch.grid;
  const int ratio_y = patch.box_ny > 1 ? 2 : 1;
  Grid2 coarse;
  coarse.dx = 2.0 * fine.dx;
  coarse.dy = ratio_y * fine.dy;
  coarse.nx = (patch.box_nx + 1) / 2;
  coarse.ny = (patch.box_ny + ratio_y - 1) / ratio_y;
  coarse.x0 = fine.x(patch.box_x) + 0.5 * fine.dx;
  coarse.y0 = fine.y(patch.box_y) + 0.5 * (ratio_y - 1) * fine.dy;
  const auto parent = [&](std::size_t i) {
    return coarse.index((patch.column[i] - patch.box_x) / 2, (patch.row[i] - patch.box_y) / ratio_y);
  };
  std::vector<double> coarse_bound(coarse.size());
  std::vector<ElementState> state(coarse.size(), ElementState::exterior);
  std::vector<std::array<double, 3>> slip(coarse.size());  // sum of both components, number
  for (std::size_t i = 0; i < n; ++i) {
    coarse_bound[parent(i)] += bound[i] / (2.0 * ratio_y);
    state[parent(i)] = ElementState::adhesion;
    slip[parent(i)][0] += known_slip[i];
    slip[parent(i)][1] += known_slip[n + i];
    slip[parent(i)][2] += 1.0;
  }

  const Patch coarse_patch = make_patch(coarse, patch.transport, state);
  ComplianceKey coarse_key = key;
  coarse_key.nx = coarse_patch.box_nx;
  coarse_key.ny = coarse_patch.box_ny;
  coarse_key.dx = coarse.dx;
  coarse_key.dy = coarse.dy;
  coarse_key.kernel = nullptr;  // made for other elements; for a start half-spaces will do
  FrictionProblem problem;
  const std::size_t m = coarse_patch.cell.size();
  problem.rigid_slip.resize(2 * m);
  problem.bound.resize(m);
  const double step = patch.transport == Transport::none ? 1.0 : 2.0;  // steady rolling: an element's length
  for (std::size_t i = 0; i < m; ++i) {
    const std::size_t at = coarse_patch.grid_index(static_cast<int>(i));
    problem.bound[i] = coarse_bound[at];
    problem.rigid_slip[i] = step * slip[at][0] / slip[at][2];
    problem.rigid_slip[m + i] = step * slip[at][1] / slip[at][2];
  }
  FrictionState solution;
  solution.traction = nested_start(coarse_patch, coarse_key, problem.bound, problem.rigid_slip, cache);
  PatchOperator matrix(coarse_patch, cache.get(coarse_key));
  problem.matrix = &matrix;
  FrictionSolve().run(problem, solution, kAccuracy, kCoarseSweeps);

  // The share of the bound is what carries over best: it keeps slip elements slipping.
  std::vector<double> share_x(coarse.size()), share_y(coarse.size());
  std::vector<char> in_contact(coarse.size(), 0);
  for (std::size_t i = 0; i < m; ++i) {
    if (!(problem.bound[i] > 0.0)) continue;
    const std::size_t at = coarse_patch.grid_index(static_cast<int>(i));
    in_contact[at] = 1;
    share_x[at] = solution.traction[i] / problem.bound[i];
    share_y[at] = solution.traction[m + i] / problem.bound[i];
  }
  // Linear between the middles of coarse elements in contact; slip stays slip where all around slip.
  for (std::size_t i = 0; i < n; ++i) {
    const int fx = patch.column[i] - patch.box_x, fy = patch.row[i] - patch.box_y;
    const int cx = fx / 2, cy = fy / ratio_y;
    const int sx = fx % 2 == 0 ? -1 : 1, sy = ratio_y == 1 ? 0 : fy % 2 == 0 ? -1 : 1;
    double x = 0.0, y = 0.0, total = 0.0;
    for (const int jy : {0, sy})
      for (const int jx : {0, sx}) {
        const int ix = cx + jx, iy = cy + jy;
        if (ix < 0 || iy < 0 || ix >= coarse.nx || iy >= coarse.ny || !in_contact[coarse.index(ix, iy)]) continue;
        const double weight = (jx == 0 ? 0.75 : 0.25) * (jy == 0 ? 0.75 : 0.25);
        x += weight * share_x[coarse.index(ix, iy)];
        y += weight * share_y[coarse.index(ix, iy)];
        total += weight;
      }
    if (!std::isfinite(x + y)) x = y = 0.0;  // nothing is known
    start[i] = x / total * bound[i];
    start[n + i] = y / total * bound[i];
  }
  return start;
}

}  // namespace treadmark::kalker
