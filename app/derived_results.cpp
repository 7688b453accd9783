// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/derived_results.hpp"

#include <numeric>
#include <utility>

#include "treadmark/solvers/kalker/subsurface/subsurface_stress.hpp"

namespace treadmark::app {
namespace {

/// Coordinates of chosen columns or rows that exist; none chosen: all.
std::vector<double> coordinates(const std::vector<int>& chosen, int count, double first, double step) {
  std::vector<int> all = chosen;
  if (all.empty()) {
    all.resize(static_cast<std::size_t>(count));
    std::iota(all.begin(), all.end(), 0);
  }
  std::vector<double> out;
  for (const int i : all)
    if (i < count) out.push_back(first + i * step);
  return out;
}

std::vector<double> moved(std::vector<double> positions, double by) {
  for (double& p : positions) p += by;
  return positions;
}

io::SubsurfaceBlock block_result(const io::SubsurfaceInput::Block& input, const kalker::SurfaceTractions& tractions,
                                 const Material& material, const Vec2& origin) {
  const Grid2& grid = tractions.grid;
  const std::vector<double> x = input.at_elements ? coordinates(input.columns, grid.nx, grid.x0, grid.dx)
                                                  : moved(input.x, origin.x()),
                            y = input.at_elements ? coordinates(input.rows, grid.ny, grid.y0, grid.dy)
                                                  : moved(input.y, origin.y());
  const bool whole = input.at_elements && input.columns.empty() && input.rows.empty();
  const std::vector<kalker::SubsurfacePoint> points =
      whole ? kalker::subsurface_stress_on_grid(tractions, material, input.z)
            : kalker::subsurface_stress(tractions, material, kalker::block_of_points(x, y, input.z));
  io::SubsurfaceBlock out;
  out.nx = static_cast<int>(x.size());
  out.ny = static_cast<int>(y.size());
  out.nz = static_cast<int>(input.z.size());
  for (const kalker::SubsurfacePoint& p : points)
    out.values.push_back({p.point, p.displacement, p.stress, p.hydrostatic, p.von_mises, p.tresca, p.principal});
  return out;
}

}  // namespace

void add_subsurface(const io::SubsurfaceInput& input, const Material& material, const Grid2& grid,
                    const kalker::ContactSolution& solution, io::PatchResult& result, const Vec2& origin) {
  const kalker::SurfaceTractions tractions = kalker::surface_tractions(grid, solution);
  for (const io::SubsurfaceInput::Block& block : input.blocks) {
    io::SubsurfaceBlock values = block_result(block, tractions, material, origin);
    if (!values.values.empty()) result.subsurface.push_back(std::move(values));
  }
  result.subsurface_table = input.text_table;
  result.full_tensor = input.full_tensor;
}

void add_dissipation(io::PatchResult& result) {
  io::PatchFields& f = result.fields;
  if (f.traction_x.empty() || f.slip_x.empty() || !f.yield_stress.empty()) return;
  const double velocity = result.shift ? 1.0 : result.velocity;  // in a shift, slip is a distance
  f.dissipation.assign(f.traction_x.size(), 0.0);
  for (std::size_t i = 0; i < f.dissipation.size(); ++i)
    if (f.state[i] != 0)
      f.dissipation[i] = 0.0 - velocity * (f.traction_x[i] * f.slip_x[i] + f.traction_s[i] * f.slip_s[i]);
}

}  // namespace treadmark::app
