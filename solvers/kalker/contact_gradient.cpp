// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/contact_gradient.hpp"

#include <algorithm>
#include <numeric>

namespace treadmark::kalker {

FieldWeights weights_of(const ContactProblem& problem, const ContactSolution& solution, Quantity quantity) {
  const Grid2& grid = problem.grid;
  const std::vector<double>& p = solution.pressure;
  FieldWeights out;
  out.pressure.assign(grid.size(), 0.0);
  switch (quantity) {
    case Quantity::force_n:
      out.pressure.assign(grid.size(), grid.cell_area());
      break;
    case Quantity::approach:
      out.approach = 1.0;
      break;
    case Quantity::max_pressure:
      out.pressure[static_cast<std::size_t>(std::max_element(p.begin(), p.end()) - p.begin())] = 1.0;
      break;
    case Quantity::middle_x:
    case Quantity::middle_y: {
      const auto place = [&](std::size_t i) {
        const int at = static_cast<int>(i);
        return quantity == Quantity::middle_x ? grid.x(at % grid.nx) : grid.y(at / grid.nx);
      };
      double sum = 0.0, moment = 0.0;
      for (std::size_t i = 0; i < p.size(); ++i) sum += p[i], moment += p[i] * place(i);
      for (std::size_t i = 0; i < p.size(); ++i) out.pressure[i] = (place(i) - moment / sum) / sum;
      break;
    }
    case Quantity::elastic_energy:
      for (std::size_t i = 0; i < p.size(); ++i) out.pressure[i] = grid.cell_area() * solution.displacement_n[i];
      break;
  }
  return out;
}

}  // namespace treadmark::kalker
