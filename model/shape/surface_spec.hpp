// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "treadmark/model/shape/defects.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/slices.hpp"
#include "treadmark/model/shape/solid_shape.hpp"
#include "treadmark/model/shape/spline_surface.hpp"
#include "treadmark/model/shape/surface_doubts.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark {

/// A standard profile from its published formula: "S1002" (wheel), "60E1" (rail).
struct StandardProfile {
  std::string name;
};

/// A tangent-continuous chain of circular arcs and straight lines, symmetric or not, in profile coordinates.
/// Segments run with increasing y from (start_y, start_z) with initial inclination start_angle (atan(dz/dy)) [rad].
/// curvature > 0 bends towards +z (a rail crown is convex upwards, so its z grows on both sides of the crown: curvature
/// > 0).
struct ArcChain {
  /// A straight line or an arc.
  struct Segment {
    double length = 0.0;     ///< arc length [m]
    double curvature = 0.0;  ///< d(angle)/ds [1/m]; 0 = straight
  };
  double start_y = 0.0, start_z = 0.0;  ///< [m]
  double start_angle = 0.0;             ///< [rad]
  std::vector<Segment> segments;
};

struct SurfaceErrors;

/// Everything a backend needs to build one wheel or rail surface.
struct SurfaceSpec {
  Body body = Body::rail;
  double nominal_radius = 0.0;  ///< wheel: radius at profile z = 0 [m]; rail: unused
  std::variant<Profile, SliceSet, StandardProfile, ArcChain, TriangleMesh, SplineSurface, SolidShape> shape;
  Defects defects;
  /// Rail: 0, or the nominal radius of a roller [m]: the profile turned about an axle parallel to y at z =
  /// roller_radius, with profile z = 0 at that radius. x of slices and defects is then the arc length at that radius, 0
  /// at the top. Negative: a ring with the material outside, in which a wheel runs; its axle lies above. Slices and
  /// defects do not fit it.
  double roller_radius = 0.0;
  std::shared_ptr<const SurfaceErrors> errors = {};  ///< of an imported scan (surface_errors.hpp); may be missing
  std::vector<SurfaceDoubt> doubts = {};             ///< of its import
};

}  // namespace treadmark
