// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/assumed_pressure.hpp"

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/solvers/kalker/normal/interpenetration.hpp"

namespace treadmark::kalker {

namespace {

using Pressure = double (*)(const HertzShape&, double, double);

Pressure pressure_of(const ContactProblem& problem) {
  const auto refuse = [](const char* message, const char* advice) {
    throw Error(ErrorKind::configuration, std::string("normal contact: ") + message, {}, advice);
  };
  if (!problem.hertz || !(problem.hertz->semi_axis_x > 0.0) || !(problem.hertz->semi_axis_y > 0.0))
    refuse("an assumed pressure distribution needs a Hertz ellipse", "set problem.hertz with positive semi-axes");
  if (problem.normal_model == NormalModel::elliptic) return hertz_pressure;
  if (problem.normal_model == NormalModel::parabolic) return parabolic_pressure;
  if (!is_semi_double_elliptic(*problem.hertz))
    refuse("the semi-double-elliptic pressure needs semi-axes towards -y and +y", "use hertz_semi_double_elliptic");
  return semi_double_elliptic_pressure;
}

}  // namespace

void assume_pressure(const ContactProblem& problem, NormalOperatorCache& operators, ContactSolution& solution) {
  const Pressure pressure = pressure_of(problem);
  const HertzShape& hertz = *problem.hertz;
  const Grid2& grid = problem.grid;
  ElementBox box;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = grid.index(ix, iy);
      const double x = grid.x(ix), y = grid.y(iy);
      solution.pressure[i] = pressure(hertz, x, y);
      if (!(solution.pressure[i] > 0.0)) continue;
      solution.displacement_n[i] = hertz.approach - hertz.curvature_x * x * x - hertz.curvature_y * y * y;
      box.include(ix, iy);
    }
  solution.approach = hertz.approach;
  if (box.empty())
    solution.status = solution.normal.status = Status::no_contact;
  else if (problem.normal_model == NormalModel::semi_double_elliptic)
    half_space_displacement(operators, problem, box, solution.pressure, solution.displacement_n);
}

}  // namespace treadmark::kalker
