// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/sampling/convert_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::sampling {
namespace {

constexpr std::size_t kLeastPoints = 4;

/// Wheel points run with decreasing y.
Profile ordered(Body body, std::vector<double> y, std::vector<double> z, std::string name) {
  if (body == Body::wheel) {
    std::reverse(y.begin(), y.end());
    std::reverse(z.begin(), z.end());
  }
  Profile profile;
  profile.body = body;
  profile.y = std::move(y);
  profile.z = std::move(z);
  profile.name = std::move(name);
  return profile;
}

}  // namespace

TriangleMesh to_mesh(const PointGrid& points, std::string name) {
  TriangleMesh mesh;
  mesh.name = std::move(name);
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> vertex(points.h.size(), kNone);
  const std::size_t nu = points.u.size(), ny = points.y.size();
  mesh.vertices.reserve(points.h.size());
  mesh.triangles.reserve(2 * points.h.size());
  for (std::size_t iu = 0; iu < nu; ++iu)
    for (std::size_t iy = 0; iy < ny; ++iy)
      if (points.present(iu, iy)) {
        vertex[points.index(iu, iy)] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(points.point(iu, iy));
      }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a == kNone || b == kNone || c == kNone) return;
    // counter-clockwise from outside: u then y turns towards +z (rail, inside) or outwards (wheel)
    if (points.body == Body::rail)
      mesh.triangles.push_back({a, c, b});
    else
      mesh.triangles.push_back({a, b, c});
  };
  for (std::size_t iu = 0; iu + 1 < nu + (points.closed ? 1 : 0); ++iu, check_cancelled())
    for (std::size_t iy = 0; iy + 1 < ny; ++iy) {
      const std::size_t next = (iu + 1) % nu;
      const std::uint32_t p00 = vertex[points.index(iu, iy)], p10 = vertex[points.index(next, iy)];
      const std::uint32_t p01 = vertex[points.index(iu, iy + 1)], p11 = vertex[points.index(next, iy + 1)];
      // the diagonal of equilateral triangles, or by turns, so that the mesh prefers no direction
      bool rising = points.stagger > 0.0 ? iy % 2 == 1 : (iu + iy) % 2 == 0;
      if (p00 == kNone || p10 == kNone || p01 == kNone || p11 == kNone) rising = p10 == kNone || p01 == kNone;
      if (rising) {
        add(p00, p10, p11);
        add(p00, p11, p01);
      } else {
        add(p00, p10, p01);
        add(p10, p11, p01);
      }
    }
  return mesh;
}

SliceSet to_slices(const PointGrid& points, double nominal_radius, std::string name) {
  const double zero = points.body == Body::wheel ? nominal_radius : 0.0;
  SliceSet slices;
  slices.body = points.body;
  slices.name = std::move(name);
  for (std::size_t iu = 0; iu < points.u.size(); ++iu) {
    check_cancelled();
    std::vector<double> y, z;
    std::size_t last = 0;
    for (std::size_t iy = 0; iy < points.y.size(); ++iy) {
      if (!points.present(iu, iy)) continue;
      if (!y.empty() && last + 1 != iy)
        throw Error(ErrorKind::input_data,
                    slices.name + ": the section at u = " + std::to_string(points.u[iu]) +
                        " has a gap at y = " + std::to_string(1e3 * points.y[iy]) + " mm and cannot become a slice",
                    {}, "use a mesh, or limit the region");
      last = iy;
      y.push_back(points.own_y.empty() ? points.y[iy] : points.own_y[points.index(iu, iy)]);
      z.push_back(points.h[points.index(iu, iy)] - zero);
    }
    if (y.size() < kLeastPoints)
      throw Error(ErrorKind::input_data,
                  slices.name + ": the section at u = " + std::to_string(points.u[iu]) + " has fewer than four points");
    slices.u.push_back(points.u[iu]);
    slices.profiles.push_back(ordered(points.body, std::move(y), std::move(z), slices.name));
  }
  if (points.closed) {
    slices.u.push_back(slices.u.front() + 2.0 * std::numbers::pi);
    slices.profiles.push_back(slices.profiles.front());
  }
  return slices;
}

Profile median_section(const PointGrid& points, double nominal_radius, std::string name) {
  const double zero = points.body == Body::wheel ? nominal_radius : 0.0;
  std::vector<double> y, z, column;
  for (std::size_t iy = 0; iy < points.y.size(); ++iy) {
    column.clear();
    for (std::size_t iu = 0; iu < points.u.size(); ++iu)
      if (points.present(iu, iy)) column.push_back(points.h[points.index(iu, iy)]);
    if (column.empty()) continue;
    const auto middle = column.begin() + static_cast<std::ptrdiff_t>(column.size() / 2);
    std::nth_element(column.begin(), middle, column.end());
    y.push_back(points.y[iy]);
    z.push_back(*middle - zero);
  }
  if (y.size() < kLeastPoints) throw Error(ErrorKind::input_data, name + ": there is no section to take as a base");
  return ordered(points.body, std::move(y), std::move(z), std::move(name));
}

}  // namespace treadmark::sampling
