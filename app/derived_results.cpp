// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/derived_results.hpp"

#include <numeric>

#include "treadmark/solvers/kalker/subsurface/subsurface_stress.hpp"

namespace treadmark::app {
namespace {

/// Coordinates of chosen columns or rows; none chosen: all.
std::vector<double> coordinates(const std::vector<int>& chosen, int count, double first, double step) {
  std::vector<int> all = chosen;
  if (all.empty()) {
    all.resize(static_cast<std::size_t>(count));
    std::iota(all.begin(), all.end(), 0);
  }
  std::vector<double> out;
  for (const int i : all) out.push_back(first + i * step);
  return out;
}

io::SubsurfaceBlock block_result(const io::SubsurfaceInput::Block& input, const kalker::SurfaceTractions& tractions,
                                 const Material& material) {
  const Grid2& grid = tractions.grid;
  const std::vector<double> x = input.at_elements ? coordinates(input.columns, grid.nx, grid.x0, grid.dx) : input.x,
                            y = input.at_elements ? coordinates(input.rows, grid.ny, grid.y0, grid.dy) : input.y;
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

void add_derived(const io::BasicCase& input, const kalker::ContactProblem& problem, const kalker::ContactSolution& solution,
                 io::PatchResult& result) {
  const kalker::SurfaceTractions tractions = kalker::surface_tractions(problem.grid, solution);
  for (const io::SubsurfaceInput::Block& block : input.subsurface.blocks)
    result.subsurface.push_back(block_result(block, tractions, input.material));
  result.subsurface_table = input.subsurface.text_table;
  result.full_tensor = input.subsurface.full_tensor;
}

io::MatFileHead mat_head(const io::BasicCase& input, int case_number) {
  io::MatFileHead head;
  head.spin_x = input.spin_x;
  head.spin_y = input.spin_y;
  head.tangential = static_cast<int>(input.regime);
  head.heat = input.thermal ? 1 : 0;
  head.case_number = case_number;
  head.material = input.material;
  head.friction = input.friction;
  const bool viscoelastic = input.material.creep_ratio_1 != 0.0 || input.material.creep_ratio_2 != 0.0;
  using Model = io::TangentialModelInput;
  head.material_model = viscoelastic                                              ? 1
                        : input.tangential_model == Model::fastsim_one_flexibility ? 2
                        : input.tangential_model == Model::fastsim                 ? 3
                        : input.tangential_model == Model::fastrip                 ? 5
                        : input.material.layer_flexibility > 0.0                   ? 4
                                                                                   : 0;
  switch (input.friction.kind) {
    case FrictionLaw::Kind::coulomb:
      head.friction_law = 0;
      break;
    case FrictionLaw::Kind::linear:
      head.friction_law = 2;
      break;
    case FrictionLaw::Kind::rational:
      head.friction_law = 3;
      break;
    case FrictionLaw::Kind::exponential:
      head.friction_law = 4;
      break;
    case FrictionLaw::Kind::temperature:
      head.friction_law = 6;
      break;
  }
  return head;
}

}  // namespace treadmark::app
