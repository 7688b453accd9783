// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/tangential_start_archive.hpp"

#include "treadmark/core/grid_archive.hpp"

namespace treadmark::kalker {

void write(const TangentialStart& start, ByteWriter& out) {
  write(start.grid, out);
  for (const bool value : {start.steady, start.forward, start.force_prescribed}) out.put(value);
  for (const auto* field : {&start.traction_x, &start.traction_y, &start.bound, &start.slip_speed}) out.put(*field);
  const Creepage& c = start.creepage;
  for (const double value : {c.xi, c.eta, c.phi, c.spin_x, c.spin_y}) out.put(value);
}

TangentialStart read_tangential_start(ByteReader& in) {
  TangentialStart start;
  start.grid = read_grid(in);
  for (bool* value : {&start.steady, &start.forward, &start.force_prescribed}) in.get(*value);
  for (auto* field : {&start.traction_x, &start.traction_y, &start.bound, &start.slip_speed})
    read_field(in, start.grid, false, *field);
  Creepage& c = start.creepage;
  for (double* value : {&c.xi, &c.eta, &c.phi, &c.spin_x, &c.spin_y}) in.get(*value);
  return start;
}

}  // namespace treadmark::kalker
