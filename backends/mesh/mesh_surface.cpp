// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/mesh_surface.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/backends/mesh/grid_heights.hpp"
#include "treadmark/backends/mesh/line_caster.hpp"
#include "treadmark/backends/mesh/point_heights.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::mesh {

namespace {

constexpr std::size_t kLinesWorthThreads = 1000;

/// Normal, principal curvatures and parameters of a point of known derivatives.
void describe(const PlaneView& view, Facing facing, const Evaluated& e, SurfacePoint& point) {
  const double p = e.dzdx, q = e.dzdy, length = std::sqrt(1.0 + p * p + q * q);
  point.normal_S = view.side / length * (view.rotation * Vec3(-p, -q, 1.0));
  // second fundamental form in orthonormal tangents
  const Vec3 n = Vec3(-p, -q, 1.0) / length, t1 = Vec3(1.0, 0.0, p).normalized(), t2 = n.cross(t1);
  const auto form = [&](const Vec3& a, const Vec3& b) {
    return -view.side / length *
           (e.dzdxx * a.x() * b.x() + e.dzdxy * (a.x() * b.y() + a.y() * b.x()) + e.dzdyy * a.y() * b.y());
  };
  const double a = form(t1, t1), b = form(t1, t2), c = form(t2, t2);
  const double mean = 0.5 * (a + c), spread = std::hypot(0.5 * (a - c), b);
  point.curvature_1 = mean + spread;
  point.curvature_2 = mean - spread;
  point.u = facing == Facing::down ? std::atan2(point.position_S.x(), point.position_S.z()) : point.position_S.x();
  point.v = point.position_S.y();
}

}  // namespace

MeshSurface::MeshSurface(PreparedMesh mesh, Body body, const MeshOptions& options, bool one_by_one)
    : options_(options),
      facing_(body == Body::wheel ? Facing::down : Facing::up),
      one_by_one_(one_by_one),
      mesh_(std::move(mesh)),
      bvh_(mesh_) {
  if (!one_by_one_) scene_ = ray_scene(mesh_);
  if (options.refinement != Refinement::smooth) return;
  smooth_.emplace(mesh_, options.crease_angle);
  bvh_.add_surface([&](std::uint32_t t) { return Bvh::About{smooth_->bulge(t), smooth_->mean_of_normals(t)}; });
}

Box3 MeshSurface::bounds() const {
  const Vec3 margin = Vec3::Constant(smooth_ ? smooth_->largest_reach() : 0.0);
  return {mesh_.centre + mesh_.low - margin, mesh_.centre + mesh_.high + margin};
}

std::size_t MeshSurface::memory_bytes() const {
  return sizeof(*this) + mesh_.memory_bytes() + bvh_.memory_bytes() + (scene_ ? scene_->memory_bytes() : 0) +
         (smooth_ ? smooth_->memory_bytes() : 0);
}

void MeshSurface::do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  const Grid2& g = plane_grid.grid;
  const PlaneView view(mesh_, plane_grid.X_SP, facing_);
  if (!one_by_one_ && g.size() > 1) return grid_heights(mesh_, bvh_, smooth(), view, g, Results(out));
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) plain_height(view, g.x(ix), g.y(iy), Results(out), g.index(ix, iy));
}

void MeshSurface::plain_height(const PlaneView& view, double x, double y, const Results& results, std::size_t i) const {
  LineCaster caster(mesh_, bvh_, nullptr, view);
  const LineHit hit = caster.look(x, y);
  if (hit.cover != Cover::front) return results.miss(i);
  if (!one_by_one_) {  // as in grids and lists
    const PlaneLines lines = view.lines();
    PointHeights heights(mesh_, smooth(), view, lines, results);
    heights.add(i, x, y, hit, caster.triangle(hit));
    return heights.finish();
  }
  const Evaluated e = evaluate_hit(smooth(), view, caster.triangle(hit), hit, x, y, results.slopes ? 1 : 0);
  results.put(i, e.z, e.dzdx, e.dzdy);
}

void MeshSurface::do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const {
  constexpr std::size_t kChunk = 1024;
  constexpr std::size_t kPacket = LineCaster::kPacket;
  const Results results(out);
  const PlaneView view(mesh_, X_SP, facing_);
  if (one_by_one_) {
    for (std::size_t i = 0; i < points_P.size(); ++i) plain_height(view, points_P[i].x(), points_P[i].y(), results, i);
    return;
  }
  const PlaneLines lines = view.lines();
  const auto work = [&](std::size_t chunk) {
    LineCaster caster(mesh_, bvh_, scene_.get(), view);
    PointHeights heights(mesh_, smooth(), view, lines, results);
    std::array<Vec2, kPacket> points;
    std::array<LineHit, kPacket> hits;
    const std::size_t end = std::min(points_P.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; i += kPacket) {
      const std::size_t count = std::min(kPacket, end - i);
      std::copy_n(points_P.begin() + static_cast<std::ptrdiff_t>(i), count, points.begin());
      caster.cast(points, count, hits);
      for (std::size_t k = 0; k < count; ++k) {
        if (hits[k].cover == Cover::front)
          heights.add(i + k, points[k].x(), points[k].y(), hits[k], caster.triangle(hits[k]));
        else
          results.miss(i + k);
      }
    }
    heights.finish();
  };
  const std::size_t chunks = (points_P.size() + kChunk - 1) / kChunk;
  if (points_P.size() < kLinesWorthThreads)
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) work(chunk);
  else
    parallel_for(chunks, work);
}

void MeshSurface::do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const {
  const PlaneView view(mesh_, X_SP, facing_);
  LineCaster caster(mesh_, bvh_, scene_.get(), view);
  std::array<Vec2, LineCaster::kPacket> packet;
  std::array<LineHit, LineCaster::kPacket> hits;
  for (std::size_t i = 0; i < points_P.size(); ++i) {
    out[i] = {};
    const double x = points_P[i].x(), y = points_P[i].y();
    if (i % packet.size() == 0) {
      const std::size_t count = std::min(packet.size(), points_P.size() - i);
      std::copy_n(points_P.begin() + static_cast<std::ptrdiff_t>(i), count, packet.begin());
      caster.cast(packet, count, hits);
    }
    const LineHit& hit = hits[i % packet.size()];
    if (hit.cover != Cover::front) continue;
    const Evaluated e = evaluate_hit(smooth(), view, caster.triangle(hit), hit, x, y, 2);
    out[i].position_S = X_SP.apply({x, y, e.z});
    describe(view, facing_, e, out[i]);
    out[i].status = bvh_.hides_others(view, x, y, hit) ? LocateStatus::ambiguous : LocateStatus::converged;
  }
}

HeightBounds MeshSurface::do_height_bounds(const Pose& X_SP, const Rectangle& r) const {
  const PlaneView view(mesh_, X_SP, facing_);
  const BoundsQuery query{0.5 * (r.x_min + r.x_max), 0.5 * (r.y_min + r.y_max), 0.5 * (r.x_max - r.x_min),
                          0.5 * (r.y_max - r.y_min)};
  const BoundsFound found = fastest_kernel<BoundsKernel>().find(bvh_.arrays(), view.lines(), query);
  if (found.low > found.high) return {0.0, 0.0, true};
  return {found.low, found.high, false};
}

}  // namespace treadmark::mesh
