// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/subsurface/half_space_field.hpp"

namespace treadmark::kalker {

namespace {

/// u = (-z phi_xz - (1 - 2 nu) phi_x, -z phi_yz - (1 - 2 nu) phi_y, -z phi_zz + 2 (1 - nu) phi_z)
FieldParts normal_field(const Potentials& p, double z, double poisson) {
  const double one_2nu = 1.0 - 2.0 * poisson, two_2nu = 2.0 - 2.0 * poisson;
  const double phi_zz = -p[phi_xx] - p[phi_yy], phi_zzz = -p[phi_xxz] - p[phi_yyz];
  FieldParts f;
  f[u_x] = -z * p[phi_xz] - one_2nu * p[phi_x];
  f[u_y] = -z * p[phi_yz] - one_2nu * p[phi_y];
  f[u_z] = -z * phi_zz + two_2nu * p[phi_z];
  f[u_xx] = -z * p[phi_xxz] - one_2nu * p[phi_xx];
  f[u_yy] = -z * p[phi_yyz] - one_2nu * p[phi_yy];
  f[u_zz] = -z * phi_zzz + one_2nu * phi_zz;
  f[u_xy] = f[u_yx] = -z * p[phi_xyz] - one_2nu * p[phi_xy];
  f[u_xz] = -z * p[phi_xzz] - two_2nu * p[phi_xz];
  f[u_yz] = -z * p[phi_yzz] - two_2nu * p[phi_yz];
  f[u_zx] = -z * p[phi_xzz] + two_2nu * p[phi_xz];
  f[u_zy] = -z * p[phi_yzz] + two_2nu * p[phi_yz];
  f[dilatation] = 2.0 * phi_zz;
  return f;
}

/// u = (2 phi_z - z phi_xx + 2 nu chi_xx, -z phi_xy + 2 nu chi_xy, -z phi_xz + (1 - 2 nu) phi_x)
FieldParts field_of_x(const Potentials& p, double z, double poisson) {
  const double two_nu = 2.0 * poisson, one_2nu = 1.0 - two_nu;
  const double phi_zz = -p[phi_xx] - p[phi_yy], phi_xxx = -p[phi_xyy] - p[phi_xzz], chi_xxx = -p[chi_xyy] - p[phi_xz];
  FieldParts f;
  f[u_x] = 2.0 * p[phi_z] - z * p[phi_xx] + two_nu * p[chi_xx];
  f[u_y] = -z * p[phi_xy] + two_nu * p[chi_xy];
  f[u_z] = -z * p[phi_xz] + one_2nu * p[phi_x];
  f[u_xx] = 2.0 * p[phi_xz] - z * phi_xxx + two_nu * chi_xxx;
  f[u_xy] = 2.0 * p[phi_yz] - z * p[phi_xxy] + two_nu * p[chi_xxy];
  f[u_xz] = 2.0 * phi_zz - z * p[phi_xxz] - one_2nu * p[phi_xx];
  f[u_yx] = -z * p[phi_xxy] + two_nu * p[chi_xxy];
  f[u_yy] = -z * p[phi_xyy] + two_nu * p[chi_xyy];
  f[u_yz] = -z * p[phi_xyz] - one_2nu * p[phi_xy];
  f[u_zx] = -z * p[phi_xxz] + one_2nu * p[phi_xx];
  f[u_zy] = -z * p[phi_xyz] + one_2nu * p[phi_xy];
  f[u_zz] = -z * p[phi_xzz] - two_nu * p[phi_xz];
  f[dilatation] = 2.0 * p[phi_xz];
  return f;
}

/// x and y change places.
Potentials exchanged(const Potentials& p) {
  Potentials q;
  q[phi_x] = p[phi_y], q[phi_y] = p[phi_x], q[phi_z] = p[phi_z];
  q[phi_xx] = p[phi_yy], q[phi_yy] = p[phi_xx], q[phi_xy] = p[phi_xy], q[phi_xz] = p[phi_yz], q[phi_yz] = p[phi_xz];
  q[phi_xxy] = p[phi_xyy], q[phi_xyy] = p[phi_xxy], q[phi_xxz] = p[phi_yyz], q[phi_yyz] = p[phi_xxz];
  q[phi_xyz] = p[phi_xyz], q[phi_xzz] = p[phi_yzz], q[phi_yzz] = p[phi_xzz];
  q[chi_xx] = p[chi_yy], q[chi_yy] = p[chi_xx], q[chi_xy] = p[chi_xy];
  q[chi_xxy] = p[chi_xyy], q[chi_xyy] = p[chi_xxy];
  return q;
}

FieldParts exchanged(const FieldParts& f) {
  return {f[u_y],  f[u_x],  f[u_z],  f[u_yy], f[u_yx], f[u_yz],      f[u_xy],
          f[u_xx], f[u_xz], f[u_zy], f[u_zx], f[u_zz], f[dilatation]};
}

}  // namespace

FieldParts half_space_field(SurfaceLoad load, const Potentials& potentials, double z, double poisson) {
  switch (load) {
    case SurfaceLoad::x:
      return field_of_x(potentials, z, poisson);
    case SurfaceLoad::y:
      return exchanged(field_of_x(exchanged(potentials), z, poisson));
    case SurfaceLoad::normal:
      break;
  }
  return normal_field(potentials, z, poisson);
}

}  // namespace treadmark::kalker
