// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <vector>

#include "treadmark/backends/mesh/patch.hpp"
#include "treadmark/backends/mesh/prepared_mesh.hpp"

namespace treadmark::mesh {

/// The surface near a vertex as a height over its tangent plane: w = P(u, v) with P(0, 0) = 0, cubic,
/// P = c0 u + c1 v + c2 u^2 + c3 u v + c4 v^2 + c5 u^3 + c6 u^2 v + c7 u v^2 + c8 v^3.
struct VertexFit {
  Vec3 origin;  ///< the vertex, local
  Vec3 axis_u, axis_v, normal;
  std::array<double, 9> c{};

  double height(double u, double v) const {
    return u * (c[0] + u * (c[2] + u * c[5]) + v * (c[3] + u * c[6])) + v * (c[1] + v * (c[4] + u * c[7] + v * c[8]));
  }
  double slope_u(double u, double v) const {
    return c[0] + u * (2.0 * c[2] + 3.0 * u * c[5]) + v * (c[3] + 2.0 * u * c[6] + v * c[7]);
  }
  double slope_v(double u, double v) const {
    return c[1] + v * (2.0 * c[4] + 3.0 * v * c[8]) + u * (c[3] + 2.0 * v * c[7] + u * c[6]);
  }
  double bend_uu(double u, double v) const { return 2.0 * c[2] + 6.0 * u * c[5] + 2.0 * v * c[6]; }
  double bend_uv(double u, double v) const { return c[3] + 2.0 * u * c[6] + 2.0 * v * c[7]; }
  double bend_vv(double u, double v) const { return 2.0 * c[4] + 2.0 * u * c[7] + 6.0 * v * c[8]; }
};

/// What is kept of a fit, and back. The normal must have been rounded to single precision before the fit, so that
/// rounding leaves out 1e-7 of what the surface rises over its tangent plane, and turns no plane.
KeptFit kept(const VertexFit& fit);
VertexFit restored(const KeptFit& kept, const Vec3& origin);

/// One fit for every vertex and, at creases, for every smooth sector of triangles round it.
struct VertexFits {
  std::vector<KeptFit> fits;
  std::vector<Corners> of_corner;  ///< fit of each corner of each triangle; empty where it has the vertex's number

  const Corners& of(const PreparedMesh& mesh, std::uint32_t triangle) const {
    return of_corner.empty() ? mesh.triangles[triangle] : of_corner[triangle];
  }
  std::size_t memory_bytes() const {
    return fits.capacity() * sizeof(KeptFit) + of_corner.capacity() * sizeof(Corners);
  }
};

/// Weighted least squares over the two rings of triangles round a vertex, or three and more where two do not determine
/// a cubic (rims, corners). Where three do not either the polynomial has fewer terms: quadratic, cubic across and
/// linear along (long thin triangles), plane. Neighbours are reached over edges that turn by at most crease_angle
/// [rad]. Runs in parallel.
VertexFits fit_vertices(const PreparedMesh& mesh, double crease_angle);

/// The shortest height over the longest side is below this: the normal says nothing.
inline constexpr double kSliver = 1e-3;
bool is_sliver(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace treadmark::mesh
