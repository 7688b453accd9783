// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/shape.hpp"

#include <cmath>

#include "treadmark/backends/displacement/natural_point.hpp"

namespace treadmark::displacement {

namespace {

/// Difference of a slope over one step to either side of a point where it is 0; one-sided at the rim.
double derivative(double ahead, double behind, double step) {
  if (!std::isnan(ahead) && !std::isnan(behind)) return (ahead - behind) / (2.0 * step);
  if (!std::isnan(ahead)) return ahead / step;
  return std::isnan(behind) ? 0.0 : -behind / step;
}

/// Hessian of a function that is 0 on the base, has unit gradient `normal` at c, and is linear along the normal.
Mat3 base_hessian(const Surface& base, Body body, const Vec3& c, const Vec3& normal) {
  constexpr double kStep = 1e-5, kFarOff = 1e-4;  // [m]
  const double side = body == Body::wheel ? 1.0 : -1.0;
  Pose T;
  T.origin = c;
  const Vec3 n = side * normal, e = std::fabs(n.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  T.rotation.col(2) = n;
  T.rotation.col(1) = n.cross(e).normalized();
  T.rotation.col(0) = T.rotation.col(1).cross(n);
  const Vec2 points[4] = {{kStep, 0.0}, {-kStep, 0.0}, {0.0, kStep}, {0.0, -kStep}};
  double z[4], zx[4], zy[4];
  base.heights_at(T, points, {z, zx, zy});
  for (int k = 0; k < 4; ++k)
    if (std::fabs(z[k]) > kFarOff) zx[k] = zy[k] = std::nan("");  // another sheet in front
  const double xx = derivative(zx[0], zx[1], kStep), yy = derivative(zy[2], zy[3], kStep);
  const double xy = 0.5 * (derivative(zy[0], zy[1], kStep) + derivative(zx[2], zx[3], kStep));
  const Vec3 a = T.rotation.col(0), b = T.rotation.col(1);
  return -side * (xx * a * a.transpose() + yy * b * b.transpose() + xy * (a * b.transpose() + b * a.transpose()));
}

/// The same of a prismatic rail or a round wheel: one principal direction is along the rail, or round the wheel.
Mat3 profile_hessian(Body body, const Vec3& c, const SurfacePoint& below) {
  const NaturalPoint at(body, c);
  const Vec3& n = below.normal_S;
  const Vec3 a = (at.along - n.dot(at.along) * n).normalized(), b = n.cross(a);
  const double along = body == Body::wheel ? n.dot(at.e) / at.r : 0.0;
  return along * a * a.transpose() + (below.curvature_1 + below.curvature_2 - along) * b * b.transpose();
}

}  // namespace

void fill_shape(const Surface& base, Body body, const Vec3& q, const Vec3& c, const SurfacePoint& below,
                const OffsetJet& o, SurfacePoint& point) {
  const Vec3& normal = below.normal_S;
  const NaturalPoint at(body, q);
  const Vec3 e_y = Vec3::UnitY(), grad_u = at.along * at.du_along;
  const Vec3 grad_o = o.d_u * grad_u + o.d_y * e_y;
  const Mat3 around = at.de_along * at.along * at.along.transpose();  // de/dq
  const Mat3 mixed = at.e * at.along.transpose() + at.along * at.e.transpose();
  const Mat3 hess_u = -at.du_along * at.de_along * mixed;
  const Mat3 uy = grad_u * e_y.transpose() + e_y * grad_u.transpose();
  const Mat3 hess_o =
      o.d_uu * grad_u * grad_u.transpose() + o.d_u * hess_u + o.d_uy * uy + o.d_yy * e_y * e_y.transpose();

  // G(q) = B(q - o e): chain rule, with f = normal . e(q)
  const double f = normal.dot(at.e), f_u = normal.dot(at.along);
  const Vec3 grad_f = around * normal;
  const double turn = at.de_along * at.de_along;
  const Mat3 hess_f = -turn * (f * at.along * at.along.transpose() + f_u * mixed);
  const Mat3 J = Mat3::Identity() - at.e * grad_o.transpose() - o.value * around;
  const Vec3 g = J.transpose() * normal;
  const Mat3 H = J.transpose() *
                     (base.constant_profile() ? profile_hessian(body, c, below) : base_hessian(base, body, c, normal)) *
                     J -
                 (f * hess_o + grad_o * grad_f.transpose() + grad_f * grad_o.transpose() + o.value * hess_f);

  const double length = g.norm();
  const Vec3 n = g / length;
  const Vec3 t1 = n.cross(std::fabs(n.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY()).normalized(), t2 = n.cross(t1);
  const double a = t1.dot(H * t1) / length, b = t1.dot(H * t2) / length, d = t2.dot(H * t2) / length;
  const double mean = 0.5 * (a + d), spread = std::hypot(0.5 * (a - d), b);
  point.position_S = q;
  point.normal_S = n;
  point.curvature_1 = mean + spread;
  point.curvature_2 = mean - spread;
  point.u = at.u();
}

}  // namespace treadmark::displacement
