// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/surface_derivatives.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace treadmark::spline {

void set_geometry(const SurfaceDerivatives& at, SurfacePoint& out) {
  out.position_S = at.p;
  out.normal_S = -at.pu.cross(at.pv).normalized();
  const double e = at.pu.dot(at.pu), f = at.pu.dot(at.pv), g = at.pv.dot(at.pv);
  // Curvature is positive where the surface bends away from the outward normal.
  const double l = -at.puu.dot(out.normal_S), m = -at.puv.dot(out.normal_S), n = -at.pvv.dot(out.normal_S);
  // The second form in unit tangents t1 along pu and t2 at right angles to it: no digits are lost where the two are
  // equal.
  const double skew = f / e, across = g - f * skew;
  const double a = l / e, b = (m - skew * l) / std::sqrt(e * across), c = (n - skew * (2.0 * m - skew * l)) / across;
  const double mean = 0.5 * (a + c), spread = std::hypot(0.5 * (a - c), b);
  out.curvature_1 = mean + spread;
  out.curvature_2 = mean - spread;
}

}  // namespace treadmark::spline
