// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/fastsim/strip_theory.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"

namespace treadmark::kalker {

namespace {

using std::numbers::pi;

/// sqrt(half^2 - x^2), 0 beyond the ends.
double half_circle(double half, double x) { return std::sqrt(std::max(0.0, half * half - x * x)); }

/// Elements in contact of one part of the patch within one row.
struct Strip {
  int row;
  std::vector<int> columns;  ///< rising, not empty

  double middle(const Grid2& grid) const { return 0.5 * (grid.x(columns.front()) + grid.x(columns.back())); }
  double half_length(const Grid2& grid) const { return 0.5 * (columns.back() - columns.front() + 1) * grid.dx; }
};

/// Tractions of the adhesion area; false if the theory exceeds its own bound somewhere.
bool adhesion_tractions(const Grid2& grid, const Strip& elements, const StripTheory& theory,
                        const StripTheory::Solution& strip, std::vector<Vec2>& traction) {
  traction.assign(elements.columns.size(), Vec2::Zero());
  const double middle = elements.middle(grid);
  for (std::size_t k = 0; k < traction.size(); ++k) {
    const double x = theory.sign() * (grid.x(elements.columns[k]) - middle);
    if (!strip.adheres(x)) continue;
    traction[k] = theory.traction(strip, x);
    if (traction[k].norm() > theory.greatest()) return false;
  }
  return true;
}

void apply_to_strip(const ContactProblem& problem, const StripTheory& theory, const Strip& elements,
                    std::vector<Vec2>& traction, ContactSolution& solution) {
  const Grid2& grid = problem.grid;
  const double middle = elements.middle(grid);
  const StripTheory::Solution strip = theory.solve(
      elements.half_length(grid), grid.y(elements.row) - problem.creepage.spin_y, middle - problem.creepage.spin_x);
  if (!adhesion_tractions(grid, elements, theory, strip, traction)) return;
  for (std::size_t k = 0; k < traction.size(); ++k) {
    const std::size_t i = grid.index(elements.columns[k], elements.row);
    const bool adheres = strip.adheres(theory.sign() * (grid.x(elements.columns[k]) - middle));
    Vec2 p = adheres ? traction[k] : Vec2(solution.traction_x[i], solution.traction_y[i]);
    const double bound = solution.friction[i] * solution.pressure[i], size = p.norm();
    // The ends of a strip lie within half an element, where the adhesion traction can exceed the pressure's bound.
    if (size > bound || (!adheres && size > 0.0)) p *= bound / size;
    solution.traction_x[i] = p.x();
    solution.traction_y[i] = p.y();
    solution.state[i] = adheres ? ElementState::adhesion : ElementState::slip;
    if (adheres) solution.slip_x[i] = solution.slip_y[i] = 0.0;
  }
}

}  // namespace

StripTheory::StripTheory(const ContactProblem& problem, const Creepage& creepage, double mu, double normal_force,
                         const EquivalentEllipse& equivalent, double sign)
    : sign_(sign), a_(equivalent.a) {
  const CombinedMaterial material = combine(problem.material);
  poisson_ = material.poisson;
  greatest_ = mu * 1.5 * normal_force / (pi * equivalent.a * equivalent.b);
  const KalkerCoefficients c = kalker_coefficients(equivalent.a, equivalent.b, poisson_);
  const double stiffness = material.shear_modulus / (2.0 * greatest_);
  // Traction opposes creepage; a strip that rolls along -x is mirrored, which turns longitudinal creepage and spin.
  xi_ = -sign * stiffness * 4.0 * (1.0 - poisson_) * c.c11 / (pi * pi) * creepage.xi;
  eta_ = -stiffness * 4.0 * (1.0 - poisson_) * c.c22 / (pi * pi) * creepage.eta;
  phi_ = -sign * stiffness * 3.0 * std::sqrt(equivalent.a * equivalent.b) * c.c23 / pi * creepage.phi;
}

StripTheory::Solution StripTheory::solve(double half_length, double lateral, double along) const {
  const double xi = xi_ - phi_ * lateral / a_, eta = eta_ + phi_ * sign_ * along / a_;
  Solution strip;
  strip.half_length = half_length;
  strip.spin = phi_;
  const double root_squared = eta * eta + (1.0 - phi_ * phi_) * xi * xi;
  if (!(root_squared >= 0.0)) return strip;
  // d (1 - nu) / a = (root + eta phi) / (1 - phi^2), extended by root - eta phi: no cancellation near phi = 1.
  const double creepage_squared = xi * xi + eta * eta;
  const double shift =
      creepage_squared > 0.0 ? a_ / (1.0 - poisson_) * creepage_squared / (std::sqrt(root_squared) - eta * phi_) : 0.0;
  if (!(shift >= 0.0) || !std::isfinite(shift)) return strip;
  strip.full_slip = false;
  strip.shift = shift;
  const double with_spin = eta + phi_ * shift / a_, size = std::hypot(xi, with_spin);
  strip.kappa = size > 0.0 ? xi / size : 0.0;
  strip.lambda = size > 0.0 ? with_spin / size : 0.0;
  return strip;
}

Vec2 StripTheory::traction(const Solution& strip, double x) const {
  const double whole = half_circle(strip.half_length, x) / a_;
  const double adhesion = half_circle(strip.half_length - strip.shift, x - strip.shift) / a_;
  return greatest_ *
         Vec2(sign_ * strip.kappa * (whole - adhesion), strip.lambda * whole - (strip.lambda - strip.spin) * adhesion);
}

void apply_strip_theory(const ContactProblem& problem, const StripTheory& theory, ContactSolution& solution) {
  const Grid2& grid = problem.grid;
  const std::vector<std::uint8_t>& parts = problem.sub_patches.part;
  const auto part_of = [&](std::size_t i) {
    if (!(solution.pressure[i] > 0.0)) return 0;
    return parts.empty() ? 1 : static_cast<int>(parts[i]);
  };
  std::vector<Vec2> traction;
  Strip strip;
  for (strip.row = 0; strip.row < grid.ny; ++strip.row)
    for (int part = 1; part <= std::max(1, problem.sub_patches.count); ++part) {
      strip.columns.clear();
      for (int ix = 0; ix < grid.nx; ++ix)
        if (part_of(grid.index(ix, strip.row)) == part) strip.columns.push_back(ix);
      if (!strip.columns.empty()) apply_to_strip(problem, theory, strip, traction, solution);
    }
}

}  // namespace treadmark::kalker
