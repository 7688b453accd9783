// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/contact_gradient.hpp"

#include <algorithm>
#include <numeric>

namespace treadmark::kalker {

FieldWeights weights_of(const ContactProblem& problem, const ContactSolution& solution, Quantity quantity) {
  const Grid2& grid = problem.grid;
  const std::vector<double>& p = solution.pressure;
  const double area = grid.cell_area();
  const auto x_of = [&](std::size_t i) { return grid.x(static_cast<int>(i) % grid.nx); };
  const auto y_of = [&](std::size_t i) { return grid.y(static_cast<int>(i) / grid.nx); };
  // of tractions, where the solution has any.
  const auto put = [&](std::vector<double>& field, const auto& weight) {
    for (std::size_t i = 0; i < solution.traction_x.size(); ++i) field.push_back(weight(i));
  };
  FieldWeights out;
  out.pressure.assign(grid.size(), 0.0);
  switch (quantity) {
    case Quantity::force_n:
      out.pressure.assign(grid.size(), area);
      break;
    case Quantity::approach:
      out.approach = 1.0;
      break;
    case Quantity::max_pressure:
      out.pressure[static_cast<std::size_t>(std::max_element(p.begin(), p.end()) - p.begin())] = 1.0;
      break;
    case Quantity::middle_x:
    case Quantity::middle_y: {
      const auto place = [&](std::size_t i) { return quantity == Quantity::middle_x ? x_of(i) : y_of(i); };
      double sum = 0.0, moment = 0.0;
      for (std::size_t i = 0; i < p.size(); ++i) sum += p[i], moment += p[i] * place(i);
      for (std::size_t i = 0; i < p.size(); ++i) out.pressure[i] = (place(i) - moment / sum) / sum;
      break;
    }
    case Quantity::elastic_energy:
      for (std::size_t i = 0; i < p.size(); ++i) out.pressure[i] = area * solution.displacement_n[i];
      put(out.traction_x, [&](std::size_t i) { return area * solution.displacement_x[i]; });
      put(out.traction_y, [&](std::size_t i) { return area * solution.displacement_y[i]; });
      break;
    case Quantity::force_x:
      put(out.traction_x, [&](std::size_t) { return area; });
      break;
    case Quantity::force_y:
      put(out.traction_y, [&](std::size_t) { return area; });
      break;
    case Quantity::moment_n:
      put(out.traction_x, [&](std::size_t i) { return -area * y_of(i); });
      put(out.traction_y, [&](std::size_t i) { return area * x_of(i); });
      break;
    case Quantity::frictional_power: {
      const bool rolling = problem.regime == Regime::steady || problem.regime == Regime::transient;
      const double scale = area * (rolling ? problem.rolling.velocity : 1.0);
      const auto slips = [&](std::size_t i) { return solution.state[i] == ElementState::slip; };
      put(out.traction_x, [&](std::size_t i) { return slips(i) ? scale * solution.slip_x[i] : 0.0; });
      put(out.traction_y, [&](std::size_t i) { return slips(i) ? scale * solution.slip_y[i] : 0.0; });
      put(out.slip_x, [&](std::size_t i) { return slips(i) ? scale * solution.traction_x[i] : 0.0; });
      put(out.slip_y, [&](std::size_t i) { return slips(i) ? scale * solution.traction_y[i] : 0.0; });
      break;
    }
  }
  return out;
}

}  // namespace treadmark::kalker
