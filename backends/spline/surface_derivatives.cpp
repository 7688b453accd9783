// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/surface_derivatives.hpp"

namespace treadmark::spline {

SurfaceJet jet_of(const SurfaceDerivatives& at) { return {at.p, at.pu, at.pv, at.puu, at.puv, at.pvv, -1.0}; }

void set_geometry(const SurfaceDerivatives& at, SurfacePoint& out) {
  const SurfaceShape shape = shape_of(jet_of(at));
  out.position_S = at.p;
  out.normal_S = shape.normal;
  out.curvature_1 = shape.curvature_1;
  out.curvature_2 = shape.curvature_2;
}

}  // namespace treadmark::spline
