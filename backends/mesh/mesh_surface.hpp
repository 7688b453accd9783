// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "treadmark/backends/mesh/bvh.hpp"
#include "treadmark/backends/mesh/make.hpp"
#include "treadmark/backends/mesh/point_heights.hpp"
#include "treadmark/backends/mesh/ray_scene.hpp"
#include "treadmark/backends/mesh/smooth_patches.hpp"

namespace treadmark::mesh {

/// A wheel or rail of triangles. Grids are filled triangle by triangle (tile_kernel.hpp). For lists single precision
/// finds a triangle (RayScene), double precision walks from there to the one that holds the line; misses, insides and
/// walks that end at a rim are decided by the hierarchy in double precision, and all of it where there is no RayScene.
/// The first triangle on a line from outside counts; if it shows its inside, the line misses. With a RayScene a line of
/// a list that passes within the accuracy of single precision (1e-8 m at 0.5 m from the centre of the mesh) of a fold
/// that hides another part may get either of the two heights; everywhere else the fold is sharp to rounding. u = x [m]
/// or theta [rad], v = y [m].
class MeshSurface final : public Surface {
 public:
  /// one_by_one: as make_mesh_oracle.
  MeshSurface(PreparedMesh mesh, Body body, const MeshOptions& options, bool one_by_one);

  std::string_view backend() const override { return options_.backend; }
  Facing facing() const override { return facing_; }
  Box3 bounds() const override;
  std::size_t memory_bytes() const override;
  /// All vertices, along their normals out of the material.
  std::vector<ShapeParameter> parameters() const override;
  std::size_t parameter_count() const override { return mesh_.vertices.size(); }

 private:
  Body body() const { return facing_ == Facing::down ? Body::wheel : Body::rail; }
  std::shared_ptr<const Surface> do_change(std::size_t parameter, double amount) const override;
  std::optional<HeightsBy> do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                        std::span<const double> weights, std::span<double> by) const override;
  void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const override;
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override;
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override;
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const override;

  /// One line by the hierarchy alone, to results i.
  void plain_height(const PlaneView& view, double x, double y, const Results& results, std::size_t i) const;
  const SmoothPatches* smooth() const { return smooth_ ? &*smooth_ : nullptr; }

  MeshOptions options_;
  Facing facing_;
  bool one_by_one_;
  PreparedMesh mesh_;
  Bvh bvh_;
  std::unique_ptr<const RayScene> scene_;  ///< may be null
  std::optional<SmoothPatches> smooth_;
};

}  // namespace treadmark::mesh
