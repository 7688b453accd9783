// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/sampling/seen_vertices.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/parallel.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::sampling {

std::vector<Vec3> seen_vertices(const Surface& surface, Body body, std::span<const Vec3> vertices,
                                const Region& region) {
  constexpr double kSteepest = 0.25882;  // cosine of 75 degrees
  constexpr double kSame = 1e-3;         // [m] what a smooth surface may pass vertices by; parts are thicker
  constexpr std::size_t kChunk = 4096;
  std::vector<char> seen(vertices.size(), 0);
  parallel_for((vertices.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t k = chunk * kChunk; k < std::min(vertices.size(), (chunk + 1) * kChunk); ++k) {
      const Vec3& p = vertices[k];
      const double u = body == Body::rail ? p.x() : std::atan2(p.x(), p.z());
      if (u < region.u_min || u > region.u_max || p.y() < region.y_min || p.y() > region.y_max) continue;
      const Pose X = natural_plane(body, u);
      const Vec2 at(0.0, p.y());
      SurfacePoint found;
      surface.locate(X, {&at, 1}, {&found, 1});
      if (found.status == LocateStatus::outside) continue;
      seen[k] = (found.position_S - p).norm() < kSame && std::abs(found.normal_S.dot(X.rotation.col(2))) > kSteepest;
    }
  });
  std::vector<Vec3> out;
  out.reserve(vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k)
    if (seen[k] != 0) out.push_back(vertices[k]);
  return out;
}

}  // namespace treadmark::sampling
