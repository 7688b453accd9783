// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cgal/plane_triangulation.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/scans/cgal/plane_points.hpp"

namespace treadmark::scans {

namespace {

constexpr const char* kWhat = "triangulation of points in a plane";

/// A vertex: place among the PlanePoints, and by how many periods it is moved.
struct Copy {
  std::uint32_t rank = 0;
  int shift = 0;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Copy, Kernel>;
// Ties of the circle test are broken by the order of the points (symbolic perturbation), hence one result, in whatever
// order the points are inserted, and the same one for each copy.
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;

/// The points, and copies of those within `margin` of the seam.
Delaunay triangulate(const PlanePoints& points, double margin) {
  std::vector<std::pair<Kernel::Point_2, Copy>> all;
  all.reserve(points.at.size());
  const auto add = [&](std::uint32_t rank, int shift) {
    all.emplace_back(Kernel::Point_2(points.at[rank].x() + shift * points.period, points.at[rank].y()),
                     Copy{rank, shift});
  };
  for (std::uint32_t rank = 0; rank < points.at.size(); ++rank) {
    add(rank, 0);
    if (points.period > 0.0 && points.at[rank].x() < margin) add(rank, 1);
    if (points.period > 0.0 && points.at[rank].x() >= points.period - margin) add(rank, -1);
  }
  return Delaunay(all.begin(), all.end());
}

Vec2 place(const Delaunay::Vertex_handle& v) { return {v->point().x(), v->point().y()}; }
double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// How far, along x, the circumcircle reaches from `low` to `high` where it is over the strip of the points (bottom to
/// top).
std::pair<double, double> reach(const std::array<Vec2, 3>& p, double bottom, double top) {
  const Vec2 b = p[1] - p[0], c = p[2] - p[0];
  const double twice = 2.0 * cross(b, c);
  const Vec2 centre((c.y() * b.squaredNorm() - b.y() * c.squaredNorm()) / twice,
                    (b.x() * c.squaredNorm() - c.x() * b.squaredNorm()) / twice);
  const double radius2 = centre.squaredNorm(), y = p[0].y() + centre.y();
  const double outside = std::max({0.0, bottom - y, y - top});
  const double half = std::sqrt(std::max(0.0, radius2 - outside * outside));
  const double low = std::min({p[0].x(), p[1].x(), p[2].x()}), high = std::max({p[0].x(), p[1].x(), p[2].x()});
  if (!std::isfinite(half)) return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  return {std::min(low, p[0].x() + centre.x() - half), std::max(high, p[0].x() + centre.x() + half)};
}

/// Each triangle of a cylinder once, as three ranks: of its copies the one whose vertex of least rank is not moved.
/// Returns false when a circle leaves the range of x that `margin` covers, so that more copies could change the
/// triangle.
bool collect(const Delaunay& delaunay, const PlanePoints& points, double longest, double margin,
             std::vector<Triangle>& out) {
  double bottom = points.at.front().y(), top = bottom;
  for (const Vec2& p : points.at) {
    bottom = std::min(bottom, p.y());
    top = std::max(top, p.y());
  }
  bool covered = true;
  out.clear();
  for (auto f = delaunay.finite_faces_begin(); f != delaunay.finite_faces_end(); ++f) {
    const std::array<Vec2, 3> p{place(f->vertex(0)), place(f->vertex(1)), place(f->vertex(2))};
    if (std::max({(p[0] - p[1]).norm(), (p[1] - p[2]).norm(), (p[2] - p[0]).norm()}) > longest) continue;
    const std::array<Copy, 3> v{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
    if (points.period > 0.0) {
      const auto least =
          std::min_element(v.begin(), v.end(), [](const Copy& a, const Copy& b) { return a.rank < b.rank; });
      const double low_x = std::min({p[0].x(), p[1].x(), p[2].x()}), high_x = std::max({p[0].x(), p[1].x(), p[2].x()});
      if (least->shift != 0 || high_x - low_x > 0.5 * points.period) continue;
      const auto [low, high] = reach(p, bottom, top);
      covered = covered && low > -margin && high < points.period + margin;
    }
    out.push_back({v[0].rank, v[1].rank, v[2].rank});
  }
  return covered;
}

/// Indices of the input, each triangle beginning with its least one, triangles ascending.
std::vector<Triangle> in_order(const std::vector<Triangle>& ranks, const PlanePoints& points,
                               std::size_t input_points) {
  std::vector<std::uint32_t> begin(input_points + 1, 0);
  const auto translate = [&](Triangle t) {
    for (std::uint32_t& v : t) v = points.input[v];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  for (const Triangle& t : ranks) ++begin[translate(t)[0] + 1];
  for (std::size_t i = 0; i < input_points; ++i) begin[i + 1] += begin[i];
  std::vector<Triangle> sorted(ranks.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (const Triangle& t : ranks) {
    const Triangle translated = translate(t);
    sorted[next[translated[0]]++] = translated;
  }
  for (std::size_t i = 0; i < input_points; ++i) std::sort(sorted.begin() + begin[i], sorted.begin() + begin[i + 1]);
  return sorted;
}

}  // namespace

std::vector<Triangle> triangulate_plane(std::span<const Vec2> points, double longest_edge, double period) {
  if (!(longest_edge > 0.0))
    throw Error(ErrorKind::configuration, std::string(kWhat) + ": the longest edge must be positive");
  const PlanePoints prepared = plane_points(points, period, kWhat);
  const double longest = longest_edge / prepared.unit;

  // Copies near the seam until the circles of all triangles are covered; two whole copies at most.
  constexpr double kFirstMargin = 2.0;  // longest edges
  std::vector<Triangle> ranks;
  for (double margin = std::min(kFirstMargin * longest, prepared.period);;
       margin = std::min(2.0 * margin, prepared.period)) {
    const Delaunay delaunay = triangulate(prepared, margin);
    if (delaunay.dimension() < 2) throw_on_a_line(kWhat);
    if (collect(delaunay, prepared, longest, margin, ranks) || margin >= prepared.period) break;
  }
  return in_order(ranks, prepared, points.size());
}

}  // namespace treadmark::scans
