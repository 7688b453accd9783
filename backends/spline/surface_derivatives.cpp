// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/surface_derivatives.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace treadmark::spline {

void set_geometry(const SurfaceDerivatives& at, SurfacePoint& out) {
  out.position_S = at.p;
  out.normal_S = -at.pu.cross(at.pv).normalized();
  const double e = at.pu.dot(at.pu), f = at.pu.dot(at.pv), g = at.pv.dot(at.pv);
  // Curvature is positive where the surface bends away from the outward normal.
  const double l = -at.puu.dot(out.normal_S), m = -at.puv.dot(out.normal_S), n = -at.pvv.dot(out.normal_S);
  const double area = e * g - f * f;
  const double mean = 0.5 * (e * n - 2.0 * f * m + g * l) / area;
  const double gauss = (l * n - m * m) / area;
  const double spread = std::sqrt(std::max(0.0, mean * mean - gauss));
  out.curvature_1 = mean + spread;
  out.curvature_2 = mean - spread;
}

}  // namespace treadmark::spline
