// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/fastsim/flexibilities.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"

namespace treadmark::kalker {

namespace {

using std::numbers::pi;

double squared(double value) { return value * value; }

}  // namespace

EquivalentEllipse equivalent_ellipse(const Grid2& grid, std::span<const double> pressure) {
  int first_x = grid.nx, last_x = -1, first_y = grid.ny, last_y = -1, count = 0;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      if (!(pressure[grid.index(ix, iy)] > 0.0)) continue;
      ++count;
      first_x = std::min(first_x, ix);
      last_x = std::max(last_x, ix);
      first_y = std::min(first_y, iy);
      last_y = std::max(last_y, iy);
    }
  if (count == 0) return {};
  const double c = std::sqrt(count * grid.cell_area() / pi);
  const double ratio = std::sqrt((last_x - first_x + 1) * grid.dx / ((last_y - first_y + 1) * grid.dy));
  return {c * ratio, c / ratio};
}

LinearFlexibilities linear_flexibilities(const KalkerCoefficients& c, double shear_modulus, double a, double b) {
  return {8.0 * a / (3.0 * c.c11 * shear_modulus), 8.0 * a / (3.0 * c.c22 * shear_modulus),
          pi * a * std::sqrt(a / b) / (4.0 * c.c23 * shear_modulus)};
}

namespace {

/// Of the linear theory, blended with a single one where creepages are large (Kalker 1990).
Flexibilities of_linear_theory(const ContactProblem& problem, const Creepage& creepage, double bound,
                               const EquivalentEllipse& equivalent, bool blended) {
  const CombinedMaterial material = combine(problem.material);
  const double g = material.shear_modulus;
  const bool hertzian = problem.hertz && problem.hertz->semi_axis_x > 0.0 && problem.hertz->semi_axis_y > 0.0;
  const double a = hertzian ? problem.hertz->semi_axis_x : equivalent.a;
  const double b = hertzian ? problem.hertz->semi_axis_y : equivalent.b;
  const KalkerCoefficients c = kalker_coefficients(a, b, material.poisson);
  auto [l1, l2, l3] = linear_flexibilities(c, g, a, b);

  const double xi = creepage.xi, eta = creepage.eta, phi = creepage.phi;
  if (blended && (xi != 0.0 || eta != 0.0 || phi != 0.0) && bound > 0.0) {
    const double spin = phi * (pi * a * a / 4.0) / (8.0 * a / 3.0);
    const double single = (xi * xi + eta * eta + spin * spin) / (xi * xi / l1 + eta * eta / l2 + spin * spin / l3);
    const double xi_full = bound / (a * b * g * c.c11), eta_full = bound / (a * b * g * c.c22);
    const double weight =
        std::min(1.0, std::sqrt((xi * xi + eta * eta) / (squared(xi_full) + squared(eta_full))) / 3.0);
    for (double* l : {&l1, &l2, &l3}) *l = (1.0 - weight) * *l + weight * single;
  }
  return {l1, l2, l1 / l3, l2 / l3, 1.0};
}

/// Less slope at small creepage, after Spiryagin et al. (2013).
double reduced_slope(const ContactProblem& problem, const Creepage& creepage, double bound,
                     const EquivalentEllipse& equivalent) {
  const FastsimSettings& s = problem.fastsim;
  const CombinedMaterial material = combine(problem.material);
  const double with_spin = creepage.eta + equivalent.a * creepage.phi;
  const double lateral = std::abs(creepage.eta) >= std::abs(with_spin) ? creepage.eta : with_spin;
  const double c11 = kalker_coefficients(equivalent.a, equivalent.b, material.poisson).c11;
  const double e = bound > 0.0 ? material.shear_modulus * pi * equivalent.a * equivalent.b * s.k0 * c11 *
                                     std::hypot(creepage.xi, lateral) / (4.0 * bound)
                               : 0.0;
  return s.k0 * (s.alpha + (1.0 - s.alpha) / (1.0 + s.beta * e));
}

}  // namespace

Flexibilities flexibilities(const ContactProblem& problem, const Creepage& creepage, double mu, double normal_force,
                            const EquivalentEllipse& equivalent, bool blended) {
  const double bound = mu * normal_force, one = problem.fastsim.flexibility;
  Flexibilities result = problem.tangential_model == TangentialModel::fastsim_one_flexibility
                             ? Flexibilities{one, one, 1.0, 1.0, 1.0}
                             : of_linear_theory(problem, creepage, bound, equivalent, blended);
  result.slope = reduced_slope(problem, creepage, bound, equivalent);
  return result;
}

}  // namespace treadmark::kalker
