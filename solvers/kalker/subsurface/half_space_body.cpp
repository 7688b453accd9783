// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/subsurface/half_space_body.hpp"

#include <numbers>
#include <string>

#include "treadmark/core/error.hpp"

namespace treadmark::kalker {

HalfSpaceBody body_at(const Material& material, double z) {
  const HalfSpaceBody body = z < 0.0 ? HalfSpaceBody{true, material.shear_modulus_2, material.poisson_2}
                                     : HalfSpaceBody{false, material.shear_modulus_1, material.poisson_1};
  if (!(body.shear_modulus > 0.0) || !(body.poisson > -1.0) || !(body.poisson <= 0.5))
    throw Error(ErrorKind::configuration,
                std::string("stresses below the surface: body ") + (body.mirrored ? "2" : "1") +
                    " has the shear modulus " + std::to_string(body.shear_modulus) + " Pa and Poisson's ratio " +
                    std::to_string(body.poisson),
                {}, "a shear modulus is positive, Poisson's ratio above -1 and at most 0.5");
  return body;
}

SubsurfacePoint subsurface_point(const HalfSpaceBody& body, const Vec3& point, const FieldParts& f) {
  const double compliance = 0.25 * std::numbers::inv_pi / body.shear_modulus;
  const Vec3 to_patch(1.0, 1.0, body.mirrored ? -1.0 : 1.0);
  SubsurfacePoint out;
  out.point = point;
  out.displacement = compliance * to_patch.cwiseProduct(Vec3(f[u_x], f[u_y], f[u_z]));
  Mat3 gradient;
  gradient << f[u_xx], f[u_xy], f[u_xz], f[u_yx], f[u_yy], f[u_yz], f[u_zx], f[u_zy], f[u_zz];
  out.gradient = compliance * to_patch.asDiagonal() * gradient * to_patch.asDiagonal();
  // Hooke's law; nu / (1 - 2 nu) div u by way of the part, for bodies that are incompressible.
  out.stress = body.shear_modulus * (out.gradient + out.gradient.transpose() +
                                     2.0 * body.poisson * compliance * f[dilatation] * Mat3::Identity());
  set_invariants(out);
  return out;
}

}  // namespace treadmark::kalker
