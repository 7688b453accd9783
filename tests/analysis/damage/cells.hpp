// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/constants.hpp"
#include "treadmark/model/damage/surface_record.hpp"

namespace treadmark::damage {

/// Rows of a cylinder of this radius or of a plane, without a surface below them.
inline SurfaceCells cells_of(Body body, double radius, int nu, double dy, int ny) {
  SurfaceCells cells;
  cells.body = body;
  cells.nu = nu;
  cells.du = body == Body::wheel ? 2.0 * kPi / nu : nu == 1 ? 1.0 : 1e-3;
  cells.y0 = -0.5 * dy * (ny - 1), cells.dy = dy, cells.ny = ny;
  cells.radius.assign(static_cast<std::size_t>(ny), body == Body::wheel ? radius : 1.0);
  return cells;
}

}  // namespace treadmark::damage
