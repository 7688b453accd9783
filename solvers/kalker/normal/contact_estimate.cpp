// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/contact_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "treadmark/core/constants.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"

namespace treadmark::kalker {

namespace {

/// Share of the interpenetration up to which elements are put into contact at first. One half is right for spheres, a
/// little more is found faster than a little less.
constexpr double kContactShare = 0.55;

/// Sphere: F = 4/3 e* sqrt(R) d^1.5 and V = pi R d^2 give F = 4/3 e* sqrt(V d / pi).
double force_at(double depth, double least_gap, std::span<const double> gap, double cell_area, double e_star) {
  double sum = 0.0;
  const double level = least_gap + depth;
  for (const double h : gap) sum += std::max(0.0, level - h);
  return 4.0 / 3.0 * e_star * std::sqrt(sum * cell_area * depth * std::numbers::inv_pi);
}

/// Depth for which force_at equals the force: secant steps in logarithms (force ~ depth^1.5), kept in a bracket.
double depth_for_force(double force, double least_gap, std::span<const double> gap, double cell_area, double e_star,
                       double start) {
  double low = 0.0, high = kInfinity, depth = start;
  for (int i = 0; i < 60; ++i) {
    const double found = force_at(depth, least_gap, gap, cell_area, e_star);
    if (std::abs(found - force) <= 0.01 * force) break;
    (found < force ? low : high) = depth;
    double next = depth * std::pow(force / found, 2.0 / 3.0);
    if (next <= low || next >= high) next = std::isfinite(high) ? 0.5 * (low + high) : 2.0 * depth;
    depth = next;
  }
  return depth;
}

}  // namespace

ContactEstimate estimate_contact(const ContactProblem& problem, std::span<const double> gap,
                                 const CombinedMaterial& material) {
  ContactEstimate estimate;
  estimate.least_gap = *std::min_element(gap.begin(), gap.end());
  if (!problem.force_prescribed) {
    estimate.approach = problem.approach;
    estimate.threshold = kContactShare * (problem.approach - estimate.least_gap);
    return estimate;
  }

  const double e_star = material.shear_modulus / (1.0 - material.poisson);
  const Grid2& grid = problem.grid;
  if (grid.ny == 1) {
    // Cylinder: h at the contact's edge is 2 f / (pi e*) for every radius, f the force per length (Johnson 1985).
    estimate.threshold = 2.0 * problem.normal_force / (grid.dy * std::numbers::pi * e_star);
    return estimate;
  }
  // The grid's area indented as a punch gives the order of magnitude to start with.
  const double start =
      problem.normal_force / (2.0 * e_star * std::sqrt(static_cast<double>(grid.size()) * grid.cell_area()));
  const double depth = depth_for_force(problem.normal_force, estimate.least_gap, gap, grid.cell_area(), e_star, start);
  estimate.approach = estimate.least_gap + depth;
  estimate.threshold = kContactShare * depth;
  return estimate;
}

}  // namespace treadmark::kalker
