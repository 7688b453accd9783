// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::testing {

/// Points with numbers that differ in every place, stresses symmetric.
inline io::SubsurfaceBlock sample_block(int nx, int ny, int nz) {
  io::SubsurfaceBlock block{nx, ny, nz, {}};
  for (int iz = 0; iz < nz; ++iz)
    for (int iy = 0; iy < ny; ++iy)
      for (int ix = 0; ix < nx; ++ix) {
        io::SubsurfaceValue v;
        v.point = {1e-3 * ix, 1e-3 * iy - 1e-3 / 3.0, 5e-4 * iz};
        v.displacement = 1e-6 * Vec3(ix + 0.1, iy + 0.2, iz + 1.0 / 7.0);
        v.stress << 1.1, 2.2, 3.3, 2.2, 4.4, 5.5, 3.3, 5.5, 6.6;
        v.stress *= -1e8 * (1 + ix + 10 * iy + 100 * iz) / 3.0;
        v.hydrostatic = v.stress.trace() / 3.0;
        v.von_mises = 1e8 + ix;
        v.tresca = 1.1e8 + iy;
        v.principal = Vec3(3e8, 2e8 + iz, -1e8);
        block.values.push_back(v);
      }
  return block;
}

}  // namespace treadmark::testing
