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
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/platform/ranges.hpp"
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

/// Part of the points, [first, last), whose triangles are wanted, and the range of x about it whose points, on a
/// cylinder copies among them, are looked at.
struct Part {
  std::uint32_t first, last;
  double from, to;
};

Delaunay triangulate(const PlanePoints& points, const Part& part) {
  std::vector<std::pair<Kernel::Point_2, Copy>> all;
  all.reserve(part.last - part.first);
  const auto rank_at = [&](double x) {
    const auto before = [](const Vec2& p, double limit) { return p.x() < limit; };
    return static_cast<std::uint32_t>(std::lower_bound(points.at.begin(), points.at.end(), x, before) -
                                      points.at.begin());
  };
  const int farthest = points.period > 0.0 ? 1 : 0;
  for (int shift = -farthest; shift <= farthest; ++shift) {
    const double moved = shift * points.period;
    const std::uint32_t end = rank_at(part.to - moved);
    for (std::uint32_t rank = rank_at(part.from - moved); rank < end; ++rank)
      all.emplace_back(Kernel::Point_2(points.at[rank].x() + moved, points.at[rank].y()), Copy{rank, shift});
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

/// Lowest and highest of the points.
struct Strip {
  double bottom, top;
};

/// Triangles whose vertex of least rank belongs to the part, as indices of the input that begin with the least one:
/// each once, of the copies on a cylinder the one where that vertex is not moved. Returns false when a circle leaves
/// the range of x that was looked at, so that more points could change the triangle.
bool collect(const Delaunay& delaunay, const PlanePoints& points, const Strip& strip, const Part& part, double longest,
             std::vector<Triangle>& out) {
  bool covered = true;
  out.clear();
  for (auto f = delaunay.finite_faces_begin(); f != delaunay.finite_faces_end(); ++f) {
    const std::array<Copy, 3> v{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
    const auto least =
        std::min_element(v.begin(), v.end(), [](const Copy& a, const Copy& b) { return a.rank < b.rank; });
    if (least->shift != 0 || least->rank < part.first || least->rank >= part.last) continue;
    const std::array<Vec2, 3> p{place(f->vertex(0)), place(f->vertex(1)), place(f->vertex(2))};
    if (std::max({(p[0] - p[1]).norm(), (p[1] - p[2]).norm(), (p[2] - p[0]).norm()}) > longest) continue;
    const double low_x = std::min({p[0].x(), p[1].x(), p[2].x()}), high_x = std::max({p[0].x(), p[1].x(), p[2].x()});
    if (points.period > 0.0 && high_x - low_x > 0.5 * points.period) continue;
    const auto [low, high] = reach(p, strip.bottom, strip.top);
    covered = covered && low >= part.from && high <= part.to;
    Triangle& t = out.emplace_back(Triangle{points.input[v[0].rank], points.input[v[1].rank], points.input[v[2].rank]});
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  return covered;
}

/// Of each part of the points; nothing where they are all on a line.
std::vector<std::vector<Triangle>> triangles_of_parts(const PlanePoints& points, std::size_t parts, double longest) {
  constexpr double kFirstMargin = 2.0;  // longest edges
  constexpr double kNoEnd = std::numeric_limits<double>::infinity();
  const bool cylinder = points.period > 0.0;
  const double first_x = points.at.front().x(), last_x = points.at.back().x();
  const double widest = cylinder ? points.period : last_x - first_x;
  if (!(kFirstMargin * longest * static_cast<double>(parts) < widest)) parts = 1;
  Strip strip{points.at.front().y(), points.at.front().y()};
  for (const Vec2& p : points.at) strip = {std::min(strip.bottom, p.y()), std::max(strip.top, p.y())};
  std::vector<std::vector<Triangle>> found(parts);
  std::vector<char> flat(parts, 0);
  parallel_for(parts, [&](std::size_t k) {
    Part part{static_cast<std::uint32_t>(k * points.at.size() / parts),
              static_cast<std::uint32_t>((k + 1) * points.at.size() / parts), 0.0, 0.0};
    const double low = k == 0 && cylinder ? 0.0 : points.at[part.first].x();
    const double high = k + 1 < parts ? points.at[part.last].x() : cylinder ? points.period : last_x;
    // More of the points around, until the circles of all triangles are covered; two whole copies at most.
    for (double margin = std::min(kFirstMargin * longest, widest);; margin = std::min(2.0 * margin, widest)) {
      part.from = !cylinder && low - margin <= first_x ? -kNoEnd : low - margin;
      part.to = !cylinder && high + margin >= last_x ? kNoEnd : high + margin;
      const Delaunay delaunay = triangulate(points, part);
      flat[k] = delaunay.dimension() < 2;
      if ((!flat[k] && collect(delaunay, points, strip, part, longest, found[k])) || margin >= widest) break;
    }
  });
  if (ranges::all_of(flat, [](char f) { return f != 0; })) found.clear();
  return found;
}

/// Ascending.
std::vector<Triangle> in_order(const std::vector<std::vector<Triangle>>& parts, std::size_t input_points) {
  std::vector<std::uint32_t> begin(input_points + 1, 0);
  for (const auto& part : parts)
    for (const Triangle& t : part) ++begin[t[0] + 1];
  for (std::size_t i = 0; i < input_points; ++i) begin[i + 1] += begin[i];
  std::vector<Triangle> sorted(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (const auto& part : parts)
    for (const Triangle& t : part) sorted[next[t[0]]++] = t;
  constexpr std::size_t kBlock = 4096;
  parallel_blocks(input_points, kBlock, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) std::sort(sorted.begin() + begin[i], sorted.begin() + begin[i + 1]);
  });
  return sorted;
}

}  // namespace

std::vector<Triangle> triangulate_plane(std::span<const Vec2> points, double longest_edge, double period) {
  if (!(longest_edge > 0.0))
    throw Error(ErrorKind::configuration, std::string(kWhat) + ": the longest edge must be positive");
  const PlanePoints prepared = plane_points(points, period, kWhat);
  const double longest = longest_edge / prepared.unit;

  constexpr std::size_t kPart = 1 << 15;  // points: what lies around is little beside it
  const std::size_t parts = std::max<std::size_t>(1, prepared.at.size() / kPart);
  std::vector<std::vector<Triangle>> found = triangles_of_parts(prepared, parts, longest);
  if (found.empty() && parts > 1) found = triangles_of_parts(prepared, 1, longest);
  if (found.empty()) throw_on_a_line(kWhat);
  return in_order(found, points.size());
}

}  // namespace treadmark::scans
