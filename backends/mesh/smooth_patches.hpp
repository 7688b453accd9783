// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/mesh/patch.hpp"
#include "treadmark/backends/mesh/plane_view.hpp"
#include "treadmark/backends/mesh/vertex_fit.hpp"

namespace treadmark::mesh {

/// Heights and derivatives along the plane normal at a hit.
struct Evaluated {
  double z = 0.0, dzdx = 0.0, dzdy = 0.0;
  double dzdxx = 0.0, dzdxy = 0.0, dzdyy = 0.0;
};

/// The smooth surface through the vertices. Where a line meets a facet at barycentric coordinates b, its height solves
///   G = sum_i w_i(b) f_i = 0,   f_i(point) = n_i . (point - vertex_i) - P_i(u, v),
/// with the cubics P_i of the three corners and the weights of blend_weights. Heights are of order 4 in the size of the
/// triangles where the surface is smooth, slopes of order 3, curvatures of order 2; vertices are met exactly; across
/// edges the surface is continuous, and its slopes are up to order 4. b belongs to the facet, so that heights along
/// other directions give a surface that differs by order 5. At creases both sides run through the vertices, and their
/// curves between them differ by order 4 where the fits are cubic. Where the solution is farther from the facet than
/// reach() allows, or the line grazes, the facet counts.
class SmoothPatches {
 public:
  /// Keeps a reference to the mesh.
  SmoothPatches(const PreparedMesh& mesh, double crease_angle);

  /// derivatives: how many orders are wanted, 0 to 2. False: the facet counts.
  bool evaluate(const PlaneView& view, const ProjectedTriangle& triangle, const LineHit& hit, double x, double y,
                int derivatives, Evaluated& out) const;

  /// The triangle made ready for kernels; places: its corners in the plane frame. False for needles, which evaluate()
  /// takes.
  bool prepare(const PatchKernel& kernel, const PlaneLines& lines, std::uint32_t triangle, const double* places,
               double* patch) const;

  /// Greatest distance along the plane normal between the facet and the surface over it [m].
  double reach(const PlaneView& view, std::uint32_t triangle) const;
  /// Along the mean normal of the corners [m], and that mean.
  double bulge(std::uint32_t triangle) const { return static_cast<double>(bulge_[triangle]); }
  Vec3 mean_of_normals(std::uint32_t triangle) const;
  double largest_reach() const { return kSteepest * static_cast<double>(largest_bulge_); }

  std::size_t memory_bytes() const {
    return fits_.memory_bytes() + bulge_.capacity() * sizeof(float) + needle_.capacity() / 8;
  }

 private:
  static constexpr double kSteepest = 10.0;  ///< longest way along a line, in bulges

  std::array<VertexFit, 3> fits_of(std::uint32_t triangle) const;
  bool solve(const std::array<VertexFit, 3>& fits, const std::array<double, 3>& w, const Vec3& start,
             const Vec3& direction, double side, double& t) const;
  PatchSource source_of(std::uint32_t triangle) const;
  double sampled_bulge(std::uint32_t triangle) const;

  const PreparedMesh& mesh_;
  VertexFits fits_;
  std::vector<float> bulge_;  ///< along the mean normal of the corners [m]
  std::vector<bool> needle_;
  float largest_bulge_ = 0.0f;
};

}  // namespace treadmark::mesh
