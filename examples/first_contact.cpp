// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Contact of a wheel with a flat on a rail from the library: the program shown in README.md.
#include <cstdio>

#include "treadmark/backends/create.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

int main() {
  using namespace treadmark;
  SurfaceSpec rail{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  SurfaceSpec wheel{Body::wheel, 0.49, StandardProfile{"S1002"}, {.flats = {{.length = 0.16, .depth = 1.4e-3}}}};
  wheelrail::Pair pair({create_surface(rail), create_surface(wheel), /*prismatic_rail=*/true, /*round_wheel=*/false});

  wheelrail::Problem problem;
  problem.track.cant = 1.0 / 40.0;
  problem.wheelset.nominal_radius = 0.49;
  problem.state.position.pitch = 0.1;                         // [rad]
  problem.state.velocity = {.x = 2.0, .pitch = -2.0 / 0.49};  // [m/s], [rad/s]
  problem.vertical_force = 125e3;                             // [N]
  const wheelrail::PairSolution solution = pair.solve(problem);

  for (const auto& patch : solution.patches)
    std::printf("y = %.2f mm, pmax = %.0f MPa\n", 1e3 * patch.frame.X_TC.origin.y(), 1e-6 * patch.contact.max_pressure);
  return solution.status == Status::ok ? 0 : 1;
}
