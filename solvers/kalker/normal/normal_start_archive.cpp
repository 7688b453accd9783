// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/normal_start_archive.hpp"

#include "treadmark/core/grid_archive.hpp"

namespace treadmark::kalker {

void write(const NormalStart& start, ByteWriter& out) {
  write(start.grid, out);
  out.put(start.pressure);
}

NormalStart read_normal_start(ByteReader& in) {
  NormalStart start;
  start.grid = read_grid(in);
  read_field(in, start.grid, true, start.pressure);
  return start;
}

}  // namespace treadmark::kalker
