// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cgal/advancing_front.hpp"

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <iterator>

#include "treadmark/core/random.hpp"

namespace treadmark::scans {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// No two candidates of a regular grid shall be equally plausible (CGAL settles that by where they lie in memory), and
/// exactly plane data shall be no special case: the triangles are those of points moved by this much, at most, in each
/// direction.
constexpr double kJitter = 1e-6;

/// Plausibility as CGAL has it, except that long edges are out.
struct BoundedEdges {
  double longest_squared;
  template <class Front, class Cell>
  double operator()(const Front& front, Cell& cell, const int& index) const {
    for (int i = 1; i <= 3; ++i) {
      const auto& a = cell->vertex((index + i) % 4)->point();
      const auto& b = cell->vertex((index + i % 3 + 1) % 4)->point();
      if (CGAL::squared_distance(a, b) > longest_squared) return front.infinity();
    }
    return front.smallest_radius_delaunay_sphere(cell, index);
  }
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> advance_front(std::span<const Vec3> points, double longest_edge) {
  Random random(1);
  const auto jitter = [&] { return (2.0 * random.uniform() - 1.0) * kJitter; };
  std::vector<Kernel::Point_3> jittered;
  jittered.reserve(points.size());
  for (const Vec3& p : points) {
    const double dx = jitter(), dy = jitter(), dz = jitter();
    jittered.emplace_back(p.x() + dx, p.y() + dy, p.z() + dz);
  }
  std::vector<std::array<std::size_t, 3>> facets;
  CGAL::advancing_front_surface_reconstruction(jittered.begin(), jittered.end(), std::back_inserter(facets),
                                               BoundedEdges{longest_edge * longest_edge});
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(facets.size());
  for (const auto& f : facets)
    triangles.push_back(
        {static_cast<std::uint32_t>(f[0]), static_cast<std::uint32_t>(f[1]), static_cast<std::uint32_t>(f[2])});
  // CGAL writes them in the order in which their parts lie in memory. Which way a part is turned is left to chance as
  // well.
  const auto key = [](std::array<std::uint32_t, 3> t) {
    std::sort(t.begin(), t.end());
    return t;
  };
  std::sort(triangles.begin(), triangles.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  return triangles;
}

}  // namespace treadmark::scans
