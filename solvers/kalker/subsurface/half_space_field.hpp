// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>

#include "treadmark/solvers/kalker/subsurface/potentials.hpp"

namespace treadmark::kalker {

/// What is computed of the field in a half-space, times 4 pi G; u_xy = d u_x / d y.
enum FieldPart : std::size_t {
  u_x,
  u_y,
  u_z,
  u_xx,
  u_xy,
  u_xz,
  u_yx,
  u_yy,
  u_yz,
  u_zx,
  u_zy,
  u_zz,
  dilatation,  ///< div u / (1 - 2 nu), which exists for incompressible bodies too
  kFieldPartCount
};

using FieldParts = std::array<double, kFieldPartCount>;

/// Load on the surface of the half-space: along x, along y, along z into it.
enum class SurfaceLoad : std::size_t { x = 0, y = 1, normal = 2 };
inline constexpr std::size_t kSurfaceLoads = 3;

/// Field at depth z [m] of loads whose potentials are given, each the weighted sum over what is loaded
/// (Boussinesq 1885, Cerruti 1882; Johnson 1985, sections 3.2 and 3.6).
FieldParts half_space_field(SurfaceLoad load, const Potentials& potentials, double z, double poisson);

}  // namespace treadmark::kalker
