// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/mesh/bvh.hpp"
#include "treadmark/backends/mesh/ray_scene.hpp"

namespace treadmark::mesh {

/// Finds where lines of one plane meet the mesh. Keeps the last triangle in the plane frame: one object a thread.
class LineCaster {
 public:
  static constexpr std::size_t kPacket = RayScene::kPacket;

  /// scene may be null: the hierarchy does it all.
  LineCaster(const PreparedMesh& mesh, const Bvh& bvh, const RayScene* scene, const PlaneView& view);

  const PlaneView& view() const { return view_; }

  /// Up to kPacket lines.
  void cast(const std::array<Vec2, kPacket>& points, std::size_t count, std::array<LineHit, kPacket>& hits);

  /// One line, by the hierarchy.
  LineHit look(double x, double y);

  /// The triangle of a hit in the plane frame.
  const ProjectedTriangle& triangle(const LineHit& hit) {
    triangle_.load(mesh_, view_, hit.triangle);
    return triangle_;
  }

 private:
  LineHit resolve(double x, double y, std::uint32_t t);
  LineHit on_edge(double x, double y, const std::array<double, 3>& e);

  const PreparedMesh& mesh_;
  const Bvh& bvh_;
  const RayScene* scene_;
  PlaneView view_;
  std::array<float, 3> inwards_{};
  double start_ = 0.0;
  ProjectedTriangle triangle_;
};

}  // namespace treadmark::mesh
