// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// The vertices of a mesh as parameters of its surface: they move along their normals, out of the material.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "treadmark/backends/mesh/line_caster.hpp"
#include "treadmark/backends/mesh/mesh_surface.hpp"
#include "treadmark/backends/mesh/prepare.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/surface_change.hpp"

namespace treadmark::mesh {
namespace {

constexpr int kFeltOver = 4;    ///< edges from a vertex to the corners whose fits may feel it
constexpr int kLikeWhole = 10;  ///< edges round it within which those fits are the same as in the whole mesh

/// The triangles round each vertex.
class Fans {
 public:
  explicit Fans(const PreparedMesh& mesh)
      : mesh_(mesh), first_(mesh.vertices.size() + 1, 0), triangles_(3 * mesh.triangles.size()) {
    for (const Corners& corners : mesh.triangles)
      for (const std::uint32_t v : corners) ++first_[v + 1];
    for (std::size_t v = 0; v + 1 < first_.size(); ++v) first_[v + 1] += first_[v];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (const std::uint32_t v : mesh.triangles[t]) triangles_[next[v]++] = static_cast<std::uint32_t>(t);
  }
  std::span<const std::uint32_t> around(std::uint32_t v) const {
    return std::span(triangles_).subspan(first_[v], first_[v + 1] - first_[v]);
  }
  /// By area.
  Vec3 normal(std::uint32_t v) const {
    Vec3 sum = Vec3::Zero();
    for (const std::uint32_t t : around(v)) sum += doubled_area(mesh_, t);
    return sum.normalized();
  }
  /// Of the triangles there [m].
  double size(std::uint32_t v) const {
    double sum = 0.0;
    for (const std::uint32_t t : around(v)) sum += doubled_area(mesh_, t).norm();
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, around(v).size())));
  }
  /// Vertices no more than so many edges away from some.
  std::vector<std::uint32_t> within(std::span<const std::uint32_t> some, int edges) const {
    std::vector<std::uint32_t> out;
    std::unordered_set<std::uint32_t> seen;
    for (const std::uint32_t v : some)
      if (seen.insert(v).second) out.push_back(v);
    for (std::size_t begin = 0; edges > 0; --edges) {
      const std::size_t end = out.size();
      for (; begin < end; ++begin)
        for (const std::uint32_t t : around(out[begin]))
          for (const std::uint32_t v : mesh_.triangles[t])
            if (seen.insert(v).second) out.push_back(v);
    }
    return out;
  }

 private:
  const PreparedMesh& mesh_;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> triangles_;
};

/// The part of a mesh round a vertex, which is moved.
PreparedMesh surroundings(const PreparedMesh& mesh, const Fans& fans, std::uint32_t vertex, const Vec3& by) {
  PreparedMesh out;
  out.name = mesh.name, out.centre = mesh.centre;
  const std::vector<std::uint32_t> near = fans.within({&vertex, 1}, kLikeWhole);
  const std::unordered_set<std::uint32_t> held(near.begin(), near.end());
  std::unordered_map<std::uint32_t, std::uint32_t> place;
  std::unordered_set<std::uint32_t> taken;
  for (const std::uint32_t v : near)
    for (const std::uint32_t t : fans.around(v)) {
      const Corners& corners = mesh.triangles[t];
      if (!std::all_of(corners.begin(), corners.end(), [&](std::uint32_t c) { return held.contains(c); }) ||
          !taken.insert(t).second)
        continue;
      Corners& own = out.triangles.emplace_back();
      for (std::size_t k = 0; k < own.size(); ++k) {
        const auto [at, added] = place.insert({corners[k], static_cast<std::uint32_t>(out.vertices.size())});
        if (added) out.vertices.push_back(mesh.vertices[corners[k]]);
        own[k] = at->second;
      }
    }
  out.vertices[place.at(vertex)] += by;
  out.low = out.high = out.vertices.front();
  for (const Vec3& v : out.vertices) out.low = out.low.cwiseMin(v), out.high = out.high.cwiseMax(v);
  connect(out);
  return out;
}

}  // namespace

std::vector<ShapeParameter> MeshSurface::parameters() const {
  const Fans fans(mesh_);
  std::vector<ShapeParameter> all(mesh_.vertices.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    all[k] = {"vertex_" + std::to_string(k), "m", step_over(fans.size(static_cast<std::uint32_t>(k))),
              mesh_.centre + mesh_.vertices[k]};
  return all;
}

std::shared_ptr<const Surface> MeshSurface::do_change(std::size_t parameter, double amount) const {
  PreparedMesh moved = mesh_;
  Vec3& vertex = moved.vertices[parameter];
  vertex += amount * Fans(mesh_).normal(static_cast<std::uint32_t>(parameter));
  moved.low = moved.low.cwiseMin(vertex), moved.high = moved.high.cwiseMax(vertex);
  return std::make_shared<MeshSurface>(std::move(moved), body(), options_, one_by_one_);
}

/// Facets turn about their vertices in closed form. What a vertex does to the fits round it is differenced, on its
/// surroundings alone.
std::optional<HeightsBy> MeshSurface::do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                                   std::span<const double> weights, std::span<double> by) const {
  const Fans fans(mesh_);
  LineCaster caster(mesh_, bvh_, nullptr, PlaneView(mesh_, X_SP, facing_));
  const Vec3 up = X_SP.rotation.col(2);
  std::vector<std::uint32_t> corners;
  std::unordered_map<std::uint32_t, std::vector<std::size_t>> over;  // points, by triangle
  for (std::size_t i = 0; i < points_P.size(); ++i) {
    const LineHit hit = caster.look(points_P[i].x(), points_P[i].y());
    if (hit.cover != Cover::front) continue;
    const Corners& of = mesh_.triangles[hit.triangle];
    if (smooth_) {
      over[hit.triangle].push_back(i);
      corners.insert(corners.end(), of.begin(), of.end());
      continue;
    }
    const Vec3 normal = doubled_area(mesh_, hit.triangle);
    for (std::size_t k = 0; k < 3; ++k)
      by[of[k]] += weights[i] * hit.b[k] * fans.normal(of[k]).dot(normal) / up.dot(normal);
  }
  if (!smooth_) return HeightsBy::exact;
  constexpr double kStep = 2e-3;  // of a triangle's size
  const std::vector<std::uint32_t> felt = fans.within(corners, kFeltOver);
  parallel_for(felt.size(), [&](std::size_t which) {
    const std::uint32_t vertex = felt[which];
    std::vector<Vec2> points;
    std::vector<double> pulling;
    std::unordered_set<std::uint32_t> taken;
    for (const std::uint32_t v : fans.within({&vertex, 1}, kFeltOver))
      for (const std::uint32_t t : fans.around(v)) {
        const auto here = over.find(t);
        if (here == over.end() || !taken.insert(t).second) continue;
        for (const std::size_t i : here->second) points.push_back(points_P[i]), pulling.push_back(weights[i]);
      }
    const double step = kStep * fans.size(vertex);
    std::vector<double> more(points.size()), less(points.size());
    const auto heights_with = [&](double amount, std::vector<double>& z) {
      const MeshSurface part(surroundings(mesh_, fans, vertex, amount * fans.normal(vertex)), body(), options_, false);
      part.heights_at(X_SP, points, {z, {}, {}});
    };
    heights_with(step, more), heights_with(-step, less);
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (const double rise = more[i] - less[i]; !std::isnan(rise)) sum += pulling[i] * rise;
    by[vertex] += sum / (2.0 * step);
  });
  return HeightsBy::differences;
}

}  // namespace treadmark::mesh
