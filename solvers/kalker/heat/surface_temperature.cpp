// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/heat/surface_temperature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::kalker {

namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& advice) {
  throw Error(ErrorKind::configuration, "surface temperatures: " + what, {}, advice);
}

void check_size(std::size_t size, const ContactProblem& problem, const char* name) {
  if (size != problem.grid.size())
    refuse(std::string(name) + " has " + std::to_string(size) + " values on a grid of " +
               std::to_string(problem.grid.size()) + " elements",
           "solve the contact problem first");
}

void check_problem(const ContactProblem& problem, const ContactSolution& solution) {
  if (problem.regime != Regime::steady)
    refuse("the regime is not steady rolling", "choose steady rolling or leave heat out");
  if (!(problem.rolling.velocity > 0.0) || !std::isfinite(problem.rolling.velocity))
    refuse("the rolling velocity is " + std::to_string(problem.rolling.velocity) + " m/s", "give a positive one");
  if (std::abs(std::sin(problem.rolling.chi)) > 1e-6)
    refuse("the rolling direction is " + std::to_string(problem.rolling.chi) + " rad", "roll along +x or -x (0 or pi)");
  check_size(solution.state.size(), problem, "state");
  check_size(solution.traction_x.size(), problem, "traction_x");
  check_size(solution.traction_y.size(), problem, "traction_y");
  check_size(solution.slip_x.size(), problem, "slip_x");
  check_size(solution.slip_y.size(), problem, "slip_y");
}

/// Thermal effusivity sqrt(lambda rho c) [W s^0.5 / (m^2 K)].
double effusivity(const ThermalProperties& body, const char* name) {
  const double square = body.conductivity * body.density * body.heat_capacity;
  const bool positive = body.conductivity > 0.0 && body.density > 0.0 && body.heat_capacity > 0.0;
  if (!positive || !std::isfinite(square) || !std::isfinite(body.bulk_temperature))
    refuse(std::string("the thermal properties of ") + name + " are not positive, or not finite",
           "give conductivity, density and heat capacity above 0");
  return std::sqrt(square);
}

/// The elements of a row as the material passes them: 0 is the one it enters first.
class Row {
 public:
  Row(const Grid2& grid, int iy, double chi) : grid_(&grid), iy_(iy), reversed_(std::cos(chi) > 0.0) {}
  int size() const { return grid_->nx; }
  std::size_t operator[](int k) const { return grid_->index(reversed_ ? grid_->nx - 1 - k : k, iy_); }

 private:
  const Grid2* grid_;
  int iy_;
  bool reversed_;
};

/// What heat does at the two surfaces.
struct Shares {
  double bulk_1 = 0.0, bulk_2 = 0.0;
  double conduction_1 = 0.0, conduction_2 = 0.0;  ///< of the difference of bulk temperatures: rise of 1, fall of 2
  double friction_1 = 0.0, friction_2 = 0.0;      ///< rise by flux times root of distance [K m^1.5 / W]
};

Shares shares(const Thermal& thermal, double velocity) {
  const double b1 = effusivity(thermal.body_1, "body 1"), b2 = effusivity(thermal.body_2, "body 2");
  const double share_1 = b1 / (b1 + b2), share_2 = b2 / (b1 + b2);
  const bool exchanged = thermal.conventions == Conventions::contact;
  const double rise = 2.0 / ((b1 + b2) * std::sqrt(std::numbers::pi * velocity));
  Shares s;
  s.bulk_1 = thermal.body_1.bulk_temperature;
  s.bulk_2 = thermal.body_2.bulk_temperature;
  s.conduction_1 = exchanged ? share_1 : share_2;
  s.conduction_2 = exchanged ? share_2 : share_1;
  s.friction_2 = rise;
  s.friction_1 = exchanged ? rise * b2 / b1 : rise;
  return s;
}

}  // namespace

std::vector<double> frictional_heat(const ContactProblem& problem, const ContactSolution& solution,
                                    double plastic_fraction) {
  check_problem(problem, solution);
  const Grid2& grid = problem.grid;
  const bool layer = !solution.plastic_x.empty() || !solution.plastic_y.empty();
  if (layer) {
    check_size(solution.plastic_x.size(), problem, "plastic_x");
    check_size(solution.plastic_y.size(), problem, "plastic_y");
  }
  std::vector<double> flux(grid.size(), 0.0);
  for (int iy = 0; iy < grid.ny; ++iy) {
    const Row row(grid, iy, problem.rolling.chi);
    Vec2 plastic_before = Vec2::Zero();
    for (int k = 0; k < row.size(); ++k) {
      const std::size_t i = row[k];
      const Vec2 plastic = layer ? Vec2(solution.plastic_x[i], solution.plastic_y[i]) : Vec2(Vec2::Zero());
      const Vec2 sheared = plastic - plastic_before;
      plastic_before = plastic;
      if (solution.state[i] != ElementState::slip && solution.state[i] != ElementState::plastic) continue;
      const double slip = std::hypot(solution.slip_x[i], solution.slip_y[i]);
      const double speed = problem.rolling.velocity * (slip + plastic_fraction * sheared.norm() / grid.dx);
      flux[i] = std::hypot(solution.traction_x[i], solution.traction_y[i]) * speed;
    }
  }
  return flux;
}

namespace {

/// Sum over the elements passed of flux times the difference of roots of distance, at every element of a row: the
/// surface temperature by a flux on a moving half-space (Carslaw and Jaeger 1959), but for a factor.
void add_frictional_rise(const Row& row, const std::vector<double>& flux, const std::vector<double>& roots, double own,
                         const Shares& s, SurfaceTemperatures& out) {
  for (int k = 0; k < row.size(); ++k) {
    double sum = own * roots[0] * flux[row[k]];
    for (int j = 0; j < k; ++j) {
      const double q = flux[row[j]];
      if (q != 0.0) sum += q * (roots[static_cast<std::size_t>(k - j)] - roots[static_cast<std::size_t>(k - j - 1)]);
    }
    out.body_1[row[k]] += s.friction_1 * sum;
    out.body_2[row[k]] += s.friction_2 * sum;
  }
}

/// Bulk temperatures before the contact, one temperature in it, relaxation behind it.
void set_conduction(const Row& row, const std::vector<ElementState>& state, double dx, double offset_behind,
                    const Shares& s, SurfaceTemperatures& out) {
  int first = row.size(), last = -1;
  for (int k = 0; k < row.size(); ++k)
    if (state[row[k]] != ElementState::exterior) first = std::min(first, k), last = k;
  const double length = (last - first + 1) * dx;  // 2 a
  for (int k = 0; k < row.size(); ++k) {
    double share = 0.0;  // of the exchange in contact that is left
    if (k >= first && k <= last) share = 1.0;
    if (k > last && last >= 0) {
      const double behind = (k - last + offset_behind) * dx;
      share = std::numbers::inv_pi * 2.0 * std::asin(std::sqrt(length / (length + behind)));
    }
    out.body_1[row[k]] = s.bulk_1 + share * s.conduction_1 * (s.bulk_2 - s.bulk_1);
    out.body_2[row[k]] = s.bulk_2 + share * s.conduction_2 * (s.bulk_1 - s.bulk_2);
  }
}

/// roots[n] = sqrt((n + 1/2) dx)
std::vector<double> distance_roots(int count, double dx) {
  std::vector<double> roots;
  for (int n = 0; n < count; ++n) roots.push_back(std::sqrt((n + 0.5) * dx));
  return roots;
}

void set_maxima(const ContactSolution& solution, SurfaceTemperatures& out) {
  bool any = false;
  for (std::size_t i = 0; i < solution.state.size(); ++i) {
    if (solution.state[i] == ElementState::exterior) continue;
    out.max_1 = any ? std::max(out.max_1, out.body_1[i]) : out.body_1[i];
    out.max_2 = any ? std::max(out.max_2, out.body_2[i]) : out.body_2[i];
    any = true;
  }
}

}  // namespace

SurfaceTemperatures surface_temperatures(const ContactProblem& problem, const ContactSolution& solution) {
  if (!problem.thermal) refuse("the problem has no thermal properties", "set them");
  const bool contact = problem.thermal->conventions == Conventions::contact;
  const std::vector<double> flux = frictional_heat(problem, solution, problem.thermal->plastic_fraction);
  const Shares s = shares(*problem.thermal, problem.rolling.velocity);
  const Grid2& grid = problem.grid;
  const std::vector<double> roots = distance_roots(grid.nx, grid.dx);
  const double offset_behind = contact && std::cos(problem.rolling.chi) > 0.0 ? 0.5 : -0.5;
  SurfaceTemperatures out{std::vector<double>(grid.size()), std::vector<double>(grid.size()), 0.0, 0.0};
  parallel_for(static_cast<std::size_t>(grid.ny), [&](std::size_t iy) {
    const Row row(grid, static_cast<int>(iy), problem.rolling.chi);
    set_conduction(row, solution.state, grid.dx, offset_behind, s, out);
    add_frictional_rise(row, flux, roots, contact ? 2.0 : 1.0, s, out);
  });
  set_maxima(solution, out);
  return out;
}

void add_surface_temperatures(const ContactProblem& problem, ContactSolution& solution) {
  SurfaceTemperatures temperatures = surface_temperatures(problem, solution);
  solution.temperature_1 = std::move(temperatures.body_1);
  solution.temperature_2 = std::move(temperatures.body_2);
  solution.max_temperature_1 = temperatures.max_1;
  solution.max_temperature_2 = temperatures.max_2;
}

}  // namespace treadmark::kalker
