// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/mesh_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/parallel.hpp"

namespace treadmark::mesh {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kWorthThreads = 4000;
constexpr std::size_t kPacket = RayScene::kPacket;

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

/// The lines of one plane; keeps the last triangle in the plane frame. One object a thread.
class MeshSurface::Lines {
 public:
  Lines(const MeshSurface& surface, const Pose& X_SP) : s_(surface), view_(surface.mesh_, X_SP, surface.facing_) {
    const Vec3 inwards = -view_.side * view_.direction();
    for (int k = 0; k < 3; ++k) inwards_[static_cast<std::size_t>(k)] = static_cast<float>(inwards[k]);
    // rays start a little outside of the box of the mesh
    const Vec3 middle = view_.to_plane(0.5 * (s_.mesh_.low + s_.mesh_.high)), half = 0.5 * (s_.mesh_.high - s_.mesh_.low);
    const double reach = view_.rotation.col(2).cwiseAbs().dot(half);
    start_ = middle.z() + view_.side * (1.01 * reach + 0.01 * half.norm());
  }

  const PlaneView& view() const { return view_; }
  const ProjectedTriangle& triangle() const { return triangle_; }

  /// Where up to kPacket lines meet the mesh.
  void cast(const std::array<Vec2, kPacket>& points, std::size_t count, std::array<LineHit, kPacket>& hits) {
    std::array<std::uint32_t, kPacket> found;
    found.fill(kNone);
    if (s_.scene_) {
      RayScene::Packet rays;
      rays.count = static_cast<int>(count);
      for (std::size_t k = 0; k < count; ++k) {
        const Vec3 from = view_.to_local(points[k].x(), points[k].y(), start_);
        rays.x[k] = static_cast<float>(from.x());
        rays.y[k] = static_cast<float>(from.y());
        rays.z[k] = static_cast<float>(from.z());
      }
      s_.scene_->first_hits(rays, inwards_, found);
    }
    for (std::size_t k = 0; k < count; ++k) hits[k] = resolve(points[k].x(), points[k].y(), found[k]);
  }

  void cast_one(const Vec2& point, LineHit& hit) {
    std::array<LineHit, kPacket> hits;
    cast({point}, 1, hits);
    hit = hits[0];
  }

  /// Height and derivatives at a hit; false if there is none.
  bool evaluate(const LineHit& hit, double x, double y, int derivatives, Evaluated& out) {
    if (hit.cover != Cover::front) return false;
    triangle_.load(s_.mesh_, view_, hit.triangle);
    if (s_.smooth_ && s_.smooth_->evaluate(view_, triangle_, hit, x, y, derivatives, out)) return true;
    out = {};
    out.z = hit.z;
    if (derivatives > 0) {
      const Vec2 slopes = triangle_.slopes();
      out.dzdx = slopes.x();
      out.dzdy = slopes.y();
    }
    return true;
  }

 private:
  /// From the triangle found in single precision to the one that holds the line.
  LineHit resolve(double x, double y, std::uint32_t t) {
    constexpr int kSteps = 6;
    for (int step = 0; step < kSteps && t != kNone; ++step) {
      triangle_.load(s_.mesh_, view_, t);
      const auto e = triangle_.edges(x, y, view_.side);
      if (ProjectedTriangle::cover(e) == Cover::front) {
        if (e[0] > 0.0 && e[1] > 0.0 && e[2] > 0.0) return triangle_.hit(e, Cover::front);
        return on_edge(x, y, e);
      }
      if (!(e[0] + e[1] + e[2] > 0.0)) break;
      const auto across = static_cast<std::size_t>(std::min_element(e.begin(), e.end()) - e.begin());
      t = s_.mesh_.neighbours[t][across];
    }
    return s_.bvh_.outermost(view_, x, y);
  }

  /// On an edge the triangle of the lower number counts, whichever of them was found; a vertex is left to the hierarchy.
  LineHit on_edge(double x, double y, const std::array<double, 3>& e) {
    if (std::count(e.begin(), e.end(), 0.0) > 1) return s_.bvh_.outermost(view_, x, y);
    const auto across = static_cast<std::size_t>(std::find(e.begin(), e.end(), 0.0) - e.begin());
    const std::uint32_t other = s_.mesh_.neighbours[triangle_.index][across];
    const LineHit here = triangle_.hit(e, Cover::front);
    if (other > triangle_.index) return here;  // kNone, too
    triangle_.load(s_.mesh_, view_, other);
    const auto f = triangle_.edges(x, y, view_.side);
    return ProjectedTriangle::cover(f) == Cover::front ? triangle_.hit(f, Cover::front) : here;
  }

  const MeshSurface& s_;
  PlaneView view_;
  std::array<float, 3> inwards_;
  double start_ = 0.0;
  ProjectedTriangle triangle_;
};

MeshSurface::MeshSurface(PreparedMesh mesh, Body body, const MeshOptions& options, bool single_precision)
    : backend_(options.backend), facing_(body == Body::wheel ? Facing::down : Facing::up), mesh_(std::move(mesh)), bvh_(mesh_) {
  if (single_precision) scene_ = std::make_unique<RayScene>(mesh_);
  if (options.refinement == Refinement::smooth) smooth_.emplace(mesh_, options.crease_angle);
}

Box3 MeshSurface::bounds() const {
  const Vec3 margin = Vec3::Constant(smooth_ ? smooth_->largest_reach() : 0.0);
  return {mesh_.centre + mesh_.low - margin, mesh_.centre + mesh_.high + margin};
}

std::size_t MeshSurface::memory_bytes() const {
  return sizeof(*this) + mesh_.memory_bytes() + bvh_.memory_bytes() + (scene_ ? scene_->memory_bytes() : 0) +
         (smooth_ ? smooth_->memory_bytes() : 0);
}

namespace {

/// Writes what is wanted of one point.
struct Writer {
  const HeightsOut& out;
  int derivatives = 0;
  explicit Writer(const HeightsOut& o) : out(o), derivatives(o.dzdx.empty() && o.dzdy.empty() ? 0 : 1) {}
  void put(std::size_t i, bool hit, const Evaluated& e) const {
    if (!out.z.empty()) out.z[i] = hit ? e.z : kNaN;
    if (!out.dzdx.empty()) out.dzdx[i] = hit ? e.dzdx : kNaN;
    if (!out.dzdy.empty()) out.dzdy[i] = hit ? e.dzdy : kNaN;
  }
};

}  // namespace

void MeshSurface::do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  // packets of 4 x 2 points are compact and meet few triangles
  constexpr int kWide = 4, kHigh = 2;
  const Grid2& g = plane_grid.grid;
  const Writer writer(out);
  const auto rows = [&](std::size_t band) {
    Lines lines(*this, plane_grid.X_SP);
    std::array<Vec2, kPacket> points;
    std::array<std::size_t, kPacket> index;
    std::array<LineHit, kPacket> hits;
    Evaluated e;
    const int begin = static_cast<int>(band) * kHigh, end = std::min(g.ny, begin + kHigh);
    for (int ix0 = 0; ix0 < g.nx; ix0 += kWide) {
      std::size_t count = 0;
      for (int iy = begin; iy < end; ++iy)
        for (int ix = ix0; ix < std::min(g.nx, ix0 + kWide); ++ix) {
          points[count] = Vec2(g.x(ix), g.y(iy));
          index[count++] = g.index(ix, iy);
        }
      lines.cast(points, count, hits);
      for (std::size_t k = 0; k < count; ++k)
        writer.put(index[k], lines.evaluate(hits[k], points[k].x(), points[k].y(), writer.derivatives, e), e);
    }
  };
  const auto bands = static_cast<std::size_t>((g.ny + kHigh - 1) / kHigh);
  if (g.size() < kWorthThreads)
    for (std::size_t band = 0; band < bands; ++band) rows(band);
  else
    parallel_for(bands, rows);
}

void MeshSurface::do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const {
  constexpr std::size_t kChunk = 1024;
  const Writer writer(out);
  const auto work = [&](std::size_t chunk) {
    Lines lines(*this, X_SP);
    std::array<Vec2, kPacket> points;
    std::array<LineHit, kPacket> hits;
    Evaluated e;
    const std::size_t end = std::min(points_P.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; i += kPacket) {
      const std::size_t count = std::min(kPacket, end - i);
      std::copy_n(points_P.begin() + static_cast<std::ptrdiff_t>(i), count, points.begin());
      lines.cast(points, count, hits);
      for (std::size_t k = 0; k < count; ++k)
        writer.put(i + k, lines.evaluate(hits[k], points[k].x(), points[k].y(), writer.derivatives, e), e);
    }
  };
  const std::size_t chunks = (points_P.size() + kChunk - 1) / kChunk;
  if (points_P.size() < kWorthThreads)
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) work(chunk);
  else
    parallel_for(chunks, work);
}

void MeshSurface::do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const {
  Lines lines(*this, X_SP);
  for (std::size_t i = 0; i < points_P.size(); ++i) {
    out[i] = {};
    const double x = points_P[i].x(), y = points_P[i].y();
    LineHit hit;
    Evaluated e;
    lines.cast_one(points_P[i], hit);
    if (!lines.evaluate(hit, x, y, 2, e)) continue;
    out[i].position_S = X_SP.apply({x, y, e.z});
    describe(lines.view(), facing_, e, out[i]);
    out[i].status = bvh_.hides_others(lines.view(), x, y, hit) ? LocateStatus::ambiguous : LocateStatus::converged;
  }
}

HeightBounds MeshSurface::do_height_bounds(const Pose& X_SP, const Rectangle& r) const {
  const PlaneView view(mesh_, X_SP, facing_);
  const double largest = smooth_ ? smooth_->largest_reach() : 0.0;
  return bvh_.bounds(view, r, largest, [&](std::uint32_t t) { return smooth_ ? smooth_->reach(view, t) : 0.0; });
}

}  // namespace treadmark::mesh
