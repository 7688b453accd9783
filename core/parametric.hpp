// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>
#include <span>

#include "treadmark/core/surface.hpp"

namespace treadmark {

/// A point of a surface given by its parameters, and derivatives by them, in the surface's frame. NaN where there is no
/// surface; derivatives also where there is none within the step of a difference.
struct SurfaceJet {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();                    ///< what is not there
  Vec3 p = Vec3::Constant(kNone);                                                              ///< [m]
  Vec3 pu = Vec3::Constant(kNone), pv = Vec3::Constant(kNone);                                 ///< per unit of u and v
  Vec3 puu = Vec3::Constant(kNone), puv = Vec3::Constant(kNone), pvv = Vec3::Constant(kNone);  ///< likewise
  double outward = 1.0;  ///< 1: pu x pv points out of the material, -1: into it

  /// Whether there is a surface.
  bool found() const { return p.x() == p.x(); }
};

/// Evaluation of a surface at its parameters (u, v), which are those of SurfacePoint: u is x of a rail [m], the
/// angle theta of a wheel or roller [rad]; v is the backend's own. A backend that knows them derives from this class
/// beside Surface. Thread-safe as every Surface.
class Parametric {
 public:
  virtual ~Parametric() = default;
  /// out.size() == uv.size().
  virtual void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const = 0;
  /// Whether derivatives are those of the representation itself; false: central differences.
  virtual bool exact_derivatives() const { return true; }
};

/// Pose of the plane at station u in the surface's frame whose heights over (x, y) are z of a rail over (x - u, y), or
/// the radius of a wheel or roller over y at the angle u (x along the circumference). u: as in Parametric.
Pose station_plane(Facing facing, double u);

/// Position and derivatives at parameters as SurfacePoint has them. Of a surface that is not Parametric v is found
/// again along the section at u as Surface::locate tells it, and derivatives are central differences over about 0.1 mm:
/// good to 1e-4 1/m of curvature where the surface is smooth. Errors: Error(configuration) if the sizes differ.
void evaluate(const Surface& surface, std::span<const Vec2> uv, std::span<SurfaceJet> out);

/// Whether derivatives of evaluate() are those of the representation itself, not differences.
bool has_exact_derivatives(const Surface& surface);

/// Normal, principal curvatures and directions of a surface at a point, in its frame.
struct SurfaceShape {
  Vec3 normal = Vec3::Constant(SurfaceJet::kNone);  ///< unit, out of the material
  double curvature_1 = SurfaceJet::kNone;           ///< greater principal curvature [1/m], positive for a convex body
  double curvature_2 = SurfaceJet::kNone;           ///< the lesser one
  Vec3 direction_1 = Vec3::Constant(SurfaceJet::kNone);  ///< unit, of curvature_1; along u where both are equal
  Vec3 direction_2 = Vec3::Constant(SurfaceJet::kNone);  ///< unit, normal x direction_1
};

/// From the two fundamental forms (do Carmo 1976). NaN without derivatives.
SurfaceShape shape_of(const SurfaceJet& jet);

/// Curvature of the surface along a tangent direction [1/m], positive for a convex body: of the normal section there.
double normal_curvature(const SurfaceShape& shape, const Vec3& direction);

}  // namespace treadmark
