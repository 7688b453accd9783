// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "treadmark/backends/mesh/kernel_types.hpp"
#include "treadmark/backends/mesh/prepared_mesh.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::mesh {

/// Lines beside a rim by no more than this hit it [m]: points computed to lie on a rim carry rounding errors.
inline constexpr double kRimTolerance = 1e-10;

/// The plane frame P seen from the local coordinates of a mesh. Lines run along its z axis.
struct PlaneView {
  Vec3 origin;    ///< of P, local
  Mat3 rotation;  ///< axes of P
  double side;    ///< outwards along z: +1 wheel, -1 rail

  PlaneView(const PreparedMesh& mesh, const Pose& X_SP, Facing facing)
      : origin(X_SP.origin - mesh.centre), rotation(X_SP.rotation), side(facing == Facing::down ? 1.0 : -1.0) {}

  /// In the order of operations of the kernels, so that all agree to the last bit.
  Vec3 to_plane(const Vec3& local) const {
    const double dx = local.x() - origin.x(), dy = local.y() - origin.y(), dz = local.z() - origin.z();
    Vec3 q;
    for (int i = 0; i < 3; ++i) q[i] = (rotation(0, i) * dx + rotation(1, i) * dy) + rotation(2, i) * dz;
    return q;
  }
  Vec3 to_local(double x, double y, double z) const { return origin + rotation * Vec3(x, y, z); }
  Vec3 direction() const { return rotation.col(2); }

  /// The same for kernels.
  PlaneLines lines() const {
    PlaneLines l{{origin.x(), origin.y(), origin.z()}, {}, side};
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) l.rotation[j][i] = rotation(j, i);
    return l;
  }
};

enum class Cover { none, front, back };

/// Where a line meets a triangle.
struct LineHit {
  std::uint32_t triangle = kNone;
  Cover cover = Cover::none;
  bool beside = false;        ///< the line passes a rim within kRimTolerance
  std::array<double, 3> b{};  ///< barycentric coordinates, >= 0, sum 1
  double z = 0.0;             ///< height along the plane normal [m]
};

/// A triangle in the plane frame. Its edge functions are antisymmetric to the last bit, so that two neighbours never
/// both leave out a line (Woop, Benthin & Wald 2013).
struct ProjectedTriangle {
  std::uint32_t index = kNone;
  std::array<Vec3, 3> q{Vec3(0.0, 0.0, 0.0), Vec3(0.0, 0.0, 0.0), Vec3(0.0, 0.0, 0.0)};

  void load(const PreparedMesh& mesh, const PlaneView& view, std::uint32_t t) {
    if (index == t) return;
    index = t;
    for (std::size_t k = 0; k < 3; ++k) q[k] = view.to_plane(mesh.vertices[mesh.triangles[t][k]]);
  }

  /// Twice the areas of the triangles that the point makes with the edges; entry k belongs to the edge opposite to
  /// corner k. All are positive inside a triangle whose outside is seen.
  std::array<double, 3> edges(double x, double y, double side) const {
    const double ax = q[0].x() - x, ay = q[0].y() - y, bx = q[1].x() - x, by = q[1].y() - y, cx = q[2].x() - x,
                 cy = q[2].y() - y;
    return {side * (bx * cy - by * cx), side * (cx * ay - cy * ax), side * (ax * by - ay * bx)};
  }

  static Cover cover(const std::array<double, 3>& e) {
    const double sum = e[0] + e[1] + e[2];
    if (e[0] >= 0.0 && e[1] >= 0.0 && e[2] >= 0.0) return sum > 0.0 ? Cover::front : Cover::none;
    if (e[0] <= 0.0 && e[1] <= 0.0 && e[2] <= 0.0) return Cover::back;
    return Cover::none;
  }

  /// For edge functions of a point inside.
  LineHit hit(const std::array<double, 3>& e, Cover which) const {
    const double inverse = 1.0 / (e[0] + e[1] + e[2]);
    LineHit h{index, which, false, {e[0] * inverse, e[1] * inverse, e[2] * inverse}, 0.0};
    h.z = h.b[0] * q[0].z() + h.b[1] * q[1].z() + h.b[2] * q[2].z();
    return h;
  }

  /// The nearest point of the edges, if it is no farther than kRimTolerance.
  LineHit near_hit(double x, double y, double side) const {
    const auto e = edges(x, y, side);
    const double sum = e[0] + e[1] + e[2];
    LineHit best;
    if (sum == 0.0) return best;
    double nearest = kRimTolerance * kRimTolerance;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = q[(k + 1) % 3], &b = q[(k + 2) % 3];
      const Vec2 along = (b - a).head<2>(), to(x - a.x(), y - a.y());
      const double length = along.squaredNorm();
      const double s = length > 0.0 ? std::clamp(along.dot(to) / length, 0.0, 1.0) : 0.0;
      const double distance = (to - s * along).squaredNorm();
      if (!(distance <= nearest)) continue;
      nearest = distance;
      best.triangle = index;
      best.cover = sum > 0.0 ? Cover::front : Cover::back;
      best.beside = true;
      best.b = {};
      best.b[(k + 1) % 3] = 1.0 - s;
      best.b[(k + 2) % 3] = s;
      best.z = (1.0 - s) * a.z() + s * b.z();
    }
    return best;
  }

  /// Slopes of the plane of the triangle.
  Vec2 slopes() const {
    const Vec3 n = (q[1] - q[0]).cross(q[2] - q[0]);
    return {-n.x() / n.z(), -n.y() / n.z()};
  }
};

}  // namespace treadmark::mesh
