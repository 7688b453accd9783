// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/line_caster.hpp"

#include <algorithm>

namespace treadmark::mesh {

LineCaster::LineCaster(const PreparedMesh& mesh, const Bvh& bvh, const RayScene* scene, const PlaneView& view)
    : mesh_(mesh), bvh_(bvh), scene_(scene), view_(view) {
  if (!scene_) return;
  const Vec3 inwards = -view_.side * view_.direction();
  for (int k = 0; k < 3; ++k) inwards_[static_cast<std::size_t>(k)] = static_cast<float>(inwards[k]);
  // rays start a little outside of the box of the mesh
  const Vec3 middle = view_.to_plane(0.5 * (mesh_.low + mesh_.high)), half = 0.5 * (mesh_.high - mesh_.low);
  const double reach = view_.rotation.col(2).cwiseAbs().dot(half);
  start_ = middle.z() + view_.side * (1.01 * reach + 0.01 * half.norm());
}

void LineCaster::cast(const std::array<Vec2, kPacket>& points, std::size_t count, std::array<LineHit, kPacket>& hits) {
  std::array<std::uint32_t, kPacket> found;
  found.fill(kNone);
  if (scene_) {
    RayScene::Packet rays;
    rays.count = static_cast<int>(count);
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 from = view_.to_local(points[k].x(), points[k].y(), start_);
      rays.x[k] = static_cast<float>(from.x());
      rays.y[k] = static_cast<float>(from.y());
      rays.z[k] = static_cast<float>(from.z());
    }
    scene_->first_hits(rays, inwards_, found);
  }
  for (std::size_t k = 0; k < count; ++k) hits[k] = resolve(points[k].x(), points[k].y(), found[k]);
}

LineHit LineCaster::look(double x, double y) {
  const LineHit hit = bvh_.outermost(view_, x, y);
  if (hit.cover != Cover::front || hit.beside) return hit;
  triangle_.load(mesh_, view_, hit.triangle);
  const auto e = triangle_.edges(x, y, view_.side);
  return std::count(e.begin(), e.end(), 0.0) == 1 ? on_edge(x, y, e) : hit;
}

/// From the triangle found in single precision to the one that holds the line.
LineHit LineCaster::resolve(double x, double y, std::uint32_t t) {
  constexpr int kSteps = 6;
  for (int step = 0; step < kSteps && t != kNone; ++step) {
    triangle_.load(mesh_, view_, t);
    const auto e = triangle_.edges(x, y, view_.side);
    if (ProjectedTriangle::cover(e) == Cover::front) {
      if (e[0] > 0.0 && e[1] > 0.0 && e[2] > 0.0) return triangle_.hit(e, Cover::front);
      return std::count(e.begin(), e.end(), 0.0) == 1 ? on_edge(x, y, e) : bvh_.outermost(view_, x, y);
    }
    if (!(e[0] + e[1] + e[2] > 0.0)) break;
    const auto across = static_cast<std::size_t>(std::min_element(e.begin(), e.end()) - e.begin());
    t = mesh_.neighbours[t][across];
  }
  return look(x, y);
}

/// On an edge the triangle of the lower number counts, whichever of them was found.
LineHit LineCaster::on_edge(double x, double y, const std::array<double, 3>& e) {
  const auto across = static_cast<std::size_t>(std::find(e.begin(), e.end(), 0.0) - e.begin());
  const std::uint32_t other = mesh_.neighbours[triangle_.index][across];
  const LineHit here = triangle_.hit(e, Cover::front);
  if (other > triangle_.index) return here;  // kNone, too
  triangle_.load(mesh_, view_, other);
  const auto f = triangle_.edges(x, y, view_.side);
  return ProjectedTriangle::cover(f) == Cover::front ? triangle_.hit(f, Cover::front) : here;
}

}  // namespace treadmark::mesh
