// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/model/contact/material.hpp"
#include "treadmark/solvers/kalker/subsurface/half_space_field.hpp"
#include "treadmark/solvers/kalker/subsurface/stress_state.hpp"

namespace treadmark::kalker {

/// One of the two bodies seen as the half-space z >= 0: body 2 is mirrored at the surface.
struct HalfSpaceBody {
  bool mirrored = false;
  double shear_modulus = 0.0;  ///< [Pa]
  double poisson = 0.0;

  /// Sign of a traction given on body 1 when it acts on this body, in the body's own axes.
  double traction_sign(SurfaceLoad load) const { return mirrored && load != SurfaceLoad::normal ? -1.0 : 1.0; }
  /// Depth below the body's own surface [m].
  double depth(double z) const { return mirrored ? -z : z; }
};

/// The body that has the points at z [m]. Errors: Error(configuration) for elastic constants without meaning.
HalfSpaceBody body_at(const Material& material, double z);

/// From parts in the body's own axes to a point in the axes of the patch.
SubsurfacePoint subsurface_point(const HalfSpaceBody& body, const Vec3& point, const FieldParts& parts);

}  // namespace treadmark::kalker
