// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/solvers/kalker/subsurface/subsurface_stress.hpp"

namespace treadmark::kalker::testing {

inline const Material kDissimilar{23e9, 82e9, 0.31, 0.26};

/// Tractions that own their fields.
struct Load {
  Grid2 grid;
  std::vector<double> pn, px, py;
  SurfaceTractions view() const { return {grid, pn, px, py}; }
};

inline Load one_element(double size, double pn, double px, double py) {
  return {{0.0, 0.0, size, size, 1, 1}, {pn}, {px}, {py}};
}

/// Smooth tractions of an ellipse, without symmetry.
inline Load patch(int nx, int ny) {
  const double dx = 8e-3 / nx, dy = 6e-3 / ny;
  Load load{{-4e-3 + 0.5 * dx, -3e-3 + 0.5 * dy, dx, dy, nx, ny}, {}, {}, {}};
  for (int iy = 0; iy < ny; ++iy)
    for (int ix = 0; ix < nx; ++ix) {
      const double x = load.grid.x(ix) / 3.5e-3, y = load.grid.y(iy) / 2.5e-3;
      const double p = 1e9 * std::sqrt(std::max(0.0, 1.0 - x * x - y * y));
      load.pn.push_back(p);
      load.px.push_back(0.2 * p * (1.0 + 0.5 * x));
      load.py.push_back(0.1 * p * (y - 0.3));
    }
  return load;
}

inline SubsurfacePoint at(const Load& load, const Material& material, const Vec3& point) {
  return subsurface_stress(load.view(), material, std::span(&point, 1)).front();
}

}  // namespace treadmark::kalker::testing
