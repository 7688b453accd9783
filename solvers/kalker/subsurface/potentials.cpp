// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/subsurface/potentials.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::kalker {

namespace {

/// r + a without cancellation for negative a: others = r^2 - a^2.
double distance_plus(double r, double a, double others) { return a >= 0.0 ? r + a : others / (r - a); }

/// Primitive over y of d phi / dx: atan(y / x) - atan(y z / (x r)) in one, which is continuous for z > 0.
double angle(double x, double y, double z, double r, double r_minus_z) {
  return std::atan2(x * y * r_minus_z, x * x * r + y * y * z);
}

}  // namespace

Potentials corner_potentials(double x, double y, double z, double least) {
  const double xx = x * x, yy = y * y, zz = z * z, least_square = least * least;
  const double r = std::max(std::sqrt(xx + yy + zz), least);
  const double rx = distance_plus(r, x, std::max(yy + zz, least_square));
  const double ry = distance_plus(r, y, std::max(xx + zz, least_square));
  const double rz = r + z;
  const double log_x = std::log(rx), log_y = std::log(ry), log_z = std::log(rz);
  const double r_minus_z = (xx + yy) / rz;
  const double angle_x = angle(x, y, z, r, r_minus_z), angle_y = angle(y, x, z, r, r_minus_z);

  Potentials p;
  p[phi_x] = y * log_z + z * log_y + x * angle_x;
  p[phi_y] = x * log_z + z * log_x + y * angle_y;
  p[phi_z] = x * log_y + y * log_x - z * (angle_x + angle_y);
  p[phi_xx] = angle_x;
  p[phi_yy] = angle_y;
  p[phi_xy] = log_z;
  p[phi_xz] = log_y;
  p[phi_yz] = log_x;
  p[phi_xxy] = x / (r * rz);
  p[phi_xyy] = y / (r * rz);
  p[phi_xxz] = x / (r * ry);
  p[phi_yyz] = y / (r * rx);
  p[phi_xyz] = 1.0 / r;
  p[phi_xzz] = z / (r * ry);
  p[phi_yzz] = z / (r * rx);
  p[chi_xx] = z * angle_x - x * log_y;
  p[chi_yy] = z * angle_y - y * log_x;
  p[chi_xy] = z * log_z - r;
  p[chi_xxy] = -x / rz;
  p[chi_xyy] = -y / rz;
  return p;
}

}  // namespace treadmark::kalker
