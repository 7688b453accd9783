// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/pair_gradient.hpp"

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/wheelrail/mirror.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/solvers/wheelrail/pair_step.hpp"

namespace treadmark::wheelrail {
namespace {

using kalker::Quantity;
using Of = PairQuantity::Of;

[[noreturn]] void refuse_gradient(const char* message, const char* advice) {
  throw Error(ErrorKind::configuration, message, {}, advice);
}

bool turns_in_the_mirror(const PairQuantity& quantity) {
  const Quantity n = quantity.number;
  return quantity.of == Of::patch && (n == Quantity::middle_y || n == Quantity::force_y || n == Quantity::moment_n);
}

void add_scaled(std::vector<double>& to, double factor, const std::vector<double>& field) {
  to.resize(field.size());
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * field[i];
}

PairGradient right_hand_gradient(const Problem& p, const PairSolution& s, const PairQuantity& quantity,
                                 std::vector<kalker::ContactSolver>& solvers) {
  const std::size_t count = s.patches.size();
  while (solvers.size() < count) solvers.emplace_back();
  PairGradient out;
  const auto of_patch = [&](std::size_t k, Quantity number) {
    const PatchSolution& patch = s.patches[k];
    kalker::ContactProblem problem = contact_problem_of(p, patch);
    problem.sub_patches.count = static_cast<int>(patch.region.parts.size());
    kalker::Gradient found = solvers[k].gradient(problem, patch.contact, number);
    out.report.iterations += found.report.iterations;
    if (out.report.status == Status::ok) {
      out.report.status = found.report.status;
      out.report.residual = found.report.residual;
      out.report.message = found.report.message;
    }
    return found;
  };
  // how far a patch's bodies come together as the wheel comes down, and what of its normal force is vertical
  const auto lowering = [&](std::size_t k) { return s.patches[k].frame.X_TC.rotation(2, 2); };
  const auto upright = [&](std::size_t k) {
    const kalker::ContactSolution& c = s.patches[k].contact;
    return (s.patches[k].frame.X_TC.rotation * Vec3(c.force_x, c.force_y, c.force_n)).z() / c.force_n;
  };

  const bool balanced = p.vertical_force.has_value();
  std::vector<kalker::Gradient> force;
  double stiffness = 0.0;
  if (balanced || quantity.of == Of::vertical_force)
    for (std::size_t k = 0; k < count; ++k) {
      force.push_back(of_patch(k, Quantity::force_n));
      stiffness += upright(k) * lowering(k) * force[k].by_load;
    }
  for (const PatchSolution& patch : s.patches) out.by_gap.emplace_back(patch.grid.size(), 0.0);
  // at a given height, and by that height
  double by_height = 1.0;
  if (quantity.of == Of::vertical_force) {
    by_height = stiffness;
    for (std::size_t k = 0; k < count; ++k) add_scaled(out.by_gap[k], upright(k), force[k].by_gap);
  } else if (quantity.of == Of::patch) {
    const kalker::Gradient number = of_patch(quantity.patch, quantity.number);
    by_height = lowering(quantity.patch) * number.by_load;
    add_scaled(out.by_gap[quantity.patch], 1.0, number.by_gap);
  }
  out.by_load = by_height;
  if (!balanced) return out;
  // the wheel comes down by what the patches carry too little
  out.by_load /= stiffness;
  for (std::size_t k = 0; k < count; ++k) add_scaled(out.by_gap[k], -out.by_load * upright(k), force[k].by_gap);
  return out;
}

}  // namespace

ShapeGradient pulled_back(const Surface& surface, std::span<const HeightWeights> weights) {
  ShapeGradient out;
  out.by.assign(surface.parameter_count(), 0.0);
  for (const HeightWeights& some : weights)
    if (surface.pull_back(some.X_SP, some.points_P, some.weights, out.by) == HeightsBy::differences)
      out.heights = HeightsBy::differences;
  return out;
}

PairGradient Pair::gradient(const Problem& problem, const PairSolution& solution, const PairQuantity& quantity) {
  if (solution.status != Status::ok || solution.patches.empty())
    refuse_gradient("a solution that is not ok has no derivatives", "solve the problem first");
  if (problem.rail_springs || problem.longitudinal_force || problem.reference_surface == ReferenceSurface::curved)
    refuse_gradient(
        "rails on springs, a longitudinal force that is given and curved contact have no derivatives by the gap",
        "give positions and creepages, and take a plane");
  if (quantity.of == Of::patch && quantity.patch >= solution.patches.size())
    refuse_gradient("there is no such patch", "they count from 0");
  if (problem.side == Side::right) return right_hand_gradient(problem, solution, quantity, solvers_);
  PairGradient out = right_hand_gradient(mirrored(problem), mirrored(solution), quantity, solvers_);
  for (std::size_t k = 0; k < out.by_gap.size(); ++k) reverse_rows(out.by_gap[k], solution.patches[k].grid);
  if (!turns_in_the_mirror(quantity)) return out;
  out.by_load = -out.by_load;
  for (std::vector<double>& field : out.by_gap)
    for (double& value : field) value = -value;
  return out;
}

}  // namespace treadmark::wheelrail
