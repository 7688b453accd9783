// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>

namespace treadmark::kalker {

/// Derivatives of the potentials of a point load on the half-space z >= 0,
///   chi = z ln(z + r) - r,   phi = d chi / dz = ln(z + r),   r = |(x, y, z)|,
/// both harmonic; letters after the bar of the name are coordinates of differentiation. Derivatives not listed follow
/// from harmonicity and d chi / dz = phi.
enum Potential : std::size_t {
  phi_x,
  phi_y,
  phi_z,
  phi_xx,
  phi_yy,
  phi_xy,
  phi_xz,
  phi_yz,
  phi_xxy,
  phi_xyy,
  phi_xxz,
  phi_yyz,
  phi_xyz,
  phi_xzz,
  phi_yzz,
  chi_xx,
  chi_yy,
  chi_xy,
  chi_xxy,
  chi_xyy,
  kPotentialCount
};

using Potentials = std::array<double, kPotentialCount>;

/// Double primitives over x and y of these derivatives at a corner: (x, y, z) [m] is the field point minus the corner,
/// z >= 0. The double difference over the corners of a rectangle is the integral over a uniform load of 1 on it
/// (Love 1929); parts that drop out of it are left out. Where a primitive is unbounded (at the surface on an edge of
/// the rectangle) the distance is taken as `least` [m]; where it has several limits their mean is returned.
Potentials corner_potentials(double x, double y, double z, double least);

}  // namespace treadmark::kalker
