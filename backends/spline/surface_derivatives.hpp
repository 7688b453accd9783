// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/surface.hpp"

namespace treadmark::spline {

/// Position and derivatives of a parametric surface at (u, v), surface frame [m].
struct SurfaceDerivatives {
  Vec3 p, pu, pv, puu, puv, pvv;
};

/// With pu x pv pointing into the material (u forward, v such that it does): position, outward unit normal and
/// principal curvatures from the two fundamental forms (do Carmo 1976). status and (u, v) are left alone.
void set_geometry(const SurfaceDerivatives& at, SurfacePoint& out);

}  // namespace treadmark::spline
