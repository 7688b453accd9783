// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/parametric.hpp"

namespace treadmark::spline {

/// Position and derivatives of a parametric surface at (u, v), surface frame [m].
struct SurfaceDerivatives {
  Vec3 p, pu, pv, puu, puv, pvv;
};

/// With pu x pv pointing into the material (u forward, v such that it does).
SurfaceJet jet_of(const SurfaceDerivatives& at);

/// Likewise: position, outward unit normal and principal curvatures, see shape_of. status and (u, v) are left alone.
void set_geometry(const SurfaceDerivatives& at, SurfacePoint& out);

}  // namespace treadmark::spline
