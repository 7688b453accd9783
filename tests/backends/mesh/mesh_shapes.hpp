// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::mesh::testing {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Triangles over an nu x nv net of points; the last column joins the first one if closed. Diagonals alternate if
/// mixed.
inline TriangleMesh net(int nu, int nv, const std::function<Vec3(int, int)>& point, bool closed = false,
                        bool mixed = false) {
  TriangleMesh mesh;
  mesh.name = "net";
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) mesh.vertices.push_back(point(i, j));
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((i % nu) + nu * j); };
  for (int j = 0; j + 1 < nv; ++j)
    for (int i = 0; i + (closed ? 0 : 1) < nu; ++i) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (mixed && (i + j) % 2 != 0) {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      } else {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      }
    }
  return mesh;
}

/// A rail: the section (y, z)(s), s from 0 to 1, along x from x0 to x1.
inline TriangleMesh rail_net(double x0, double x1, int nx, int ns, const std::function<Vec2(double)>& section) {
  return net(nx, ns, [&](int i, int j) {
    const Vec2 yz = section(static_cast<double>(j) / (ns - 1));
    return Vec3(x0 + (x1 - x0) * i / (nx - 1), yz.x(), yz.y());
  });
}

/// Head of a rail: an arc of the given radius, crown at the origin, over +- angle.
inline std::function<Vec2(double)> arc_section(double radius, double angle) {
  return [=](double s) {
    const double a = angle * (2.0 * s - 1.0);
    return Vec2(radius * std::sin(a), radius * (1.0 - std::cos(a)));
  };
}

/// A wheel: radius r(y), y from y0 to y1, theta over +- half, or all round if half = pi.
inline TriangleMesh wheel_net(double y0, double y1, int ny, double half, int n_theta,
                              const std::function<double(double)>& radius) {
  const bool closed = half >= kPi;
  return net(
      n_theta, ny,
      [&](int i, int j) {
        const double y = y0 + (y1 - y0) * j / (ny - 1);
        const double theta = closed ? -kPi + 2.0 * kPi * i / n_theta : -half + 2.0 * half * i / (n_theta - 1);
        const double r = radius(y);
        return Vec3(r * std::sin(theta), y, r * std::cos(theta));
      },
      closed);
}

/// A barrel tread of nominal radius R and meridian radius m.
inline std::function<double(double)> barrel(double R, double m) {
  return [=](double y) { return R - m + std::sqrt(m * m - y * y); };
}

/// A smooth curved sheet z(x, y) whose vertices are scattered round a net, so that valences and shapes vary.
inline TriangleMesh scattered_sheet(double half, int n, const std::function<double(double, double)>& z, double jitter,
                                    unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-0.5, 0.5);
  const double h = 2.0 * half / (n - 1);
  return net(
      n, n,
      [&](int i, int j) {
        const bool rim_x = i == 0 || i == n - 1, rim_y = j == 0 || j == n - 1;
        const double x = -half + h * (i + (rim_x ? 0.0 : jitter * unit(random)));
        const double y = -half + h * (j + (rim_y ? 0.0 : jitter * unit(random)));
        return Vec3(x, y, z(x, y));
      },
      false, true);
}

inline void shift(TriangleMesh& mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v += by;
}

struct Fields {
  std::vector<double> z, dzdx, dzdy;
};

inline Fields evaluate(const Surface& surface, const Pose& X, const Grid2& grid) {
  Fields f;
  f.z.assign(grid.size(), 0.0);
  f.dzdx = f.dzdy = f.z;
  surface.heights({X, grid}, {f.z, f.dzdx, f.dzdy});
  return f;
}

inline Pose pose(const Vec3& origin, double roll = 0.0, double yaw = 0.0, double pitch = 0.0) {
  return {origin, rotation({roll, yaw, pitch})};
}

/// Outermost crossing of a line with all triangles, one after the other, by solving for it in 3D: another formula than
/// those of the library. NaN if there is none or the outermost one is seen from inside.
inline double brute_height(const TriangleMesh& mesh, const Pose& X, double x, double y, Facing facing) {
  const double side = facing == Facing::down ? 1.0 : -1.0;
  const Vec3 o = X.apply({x, y, 0.0}), d = X.rotation.col(2);
  double best = -std::numeric_limits<double>::infinity(), z = kNaN;
  for (const auto& c : mesh.triangles) {
    const Vec3 a = mesh.vertices[c[0]], e1 = mesh.vertices[c[1]] - a, e2 = mesh.vertices[c[2]] - a;
    Mat3 M;
    M.col(0) = e1;
    M.col(1) = e2;
    M.col(2) = -d;
    const double det = M.determinant();
    if (det == 0.0) continue;
    const Vec3 s = M.inverse() * (o - a);
    if (s.x() < 0.0 || s.y() < 0.0 || s.x() + s.y() > 1.0) continue;
    if (side * s.z() <= best) continue;
    best = side * s.z();
    z = side * e1.cross(e2).dot(d) > 0.0 ? s.z() : kNaN;
  }
  return z;
}

}  // namespace treadmark::mesh::testing
