// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cgal/mesh_holes.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <vector>

namespace treadmark::scans {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Halfedge = Mesh::Halfedge_index;
using Polygon = std::array<std::size_t, 3>;

constexpr double kRimPart = 0.5;  // a border at least this wide, as a part of the longest one's diameter, is a rim too

struct Border {
  Halfedge halfedge;
  std::size_t part;
  double length, diameter;
  bool rim;
};

Vec3 place(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// The connected part of each vertex, named after one of its vertices.
std::vector<std::size_t> parts_of(std::size_t vertices, const std::vector<Polygon>& polygons) {
  std::vector<std::size_t> parent(vertices);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const Polygon& p : polygons)
    for (const std::size_t v : {p[1], p[2]}) {
      const std::size_t a = root(p[0]), b = root(v);
      parent[std::max(a, b)] = std::min(a, b);
    }
  for (std::size_t i = 0; i < vertices; ++i) parent[i] = root(i);
  return parent;
}

/// Turns the parts most of whose area faces away from outward.
void turn_outward(const std::vector<Kernel::Point_3>& points, const std::vector<std::size_t>& part,
                  std::span<const Vec3> outward, std::vector<Polygon>& polygons) {
  std::vector<double> agreement(points.size(), 0.0);
  for (const Polygon& p : polygons) {
    const Vec3 a = place(points[p[0]]);
    const Vec3 area = (place(points[p[1]]) - a).cross(place(points[p[2]]) - a);
    for (const std::size_t v : p)
      if (v < outward.size()) agreement[part[p[0]]] += area.dot(outward[v]);
  }
  for (Polygon& p : polygons) {
    if (agreement[part[p[0]]] < 0.0) std::swap(p[1], p[2]);
    std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());  // the same, whichever way it came
  }
}

std::vector<Border> borders_of(const Mesh& mesh, const std::vector<std::size_t>& part) {
  std::vector<Halfedge> cycles;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(cycles));
  std::vector<Border> borders;
  for (const Halfedge start : cycles) {
    std::vector<Vec3> rim;
    for (const Halfedge h : CGAL::halfedges_around_face(start, mesh)) rim.push_back(place(mesh.point(mesh.target(h))));
    Border border{start, part[mesh.target(start)], 0.0, 0.0, false};
    for (std::size_t i = 0; i < rim.size(); ++i) {
      border.length += (rim[i] - rim[(i + 1) % rim.size()]).norm();
      for (std::size_t j = i + 1; j < rim.size(); ++j)
        border.diameter = std::max(border.diameter, (rim[i] - rim[j]).squaredNorm());
    }
    border.diameter = std::sqrt(border.diameter);
    borders.push_back(border);
  }
  std::vector<const Border*> longest(part.size(), nullptr);
  for (const Border& b : borders)
    if (longest[b.part] == nullptr || b.length > longest[b.part]->length) longest[b.part] = &b;
  for (Border& b : borders) b.rim = &b == longest[b.part] || b.diameter >= kRimPart * longest[b.part]->diameter;
  return borders;
}

/// Whether triangles came out: CGAL may find none and still report success.
bool fill(Mesh& mesh, Halfedge border) {
  std::vector<Mesh::Face_index> faces;
  std::vector<Mesh::Vertex_index> vertices;
  pmp::triangulate_refine_and_fair_hole(mesh, border, std::back_inserter(faces), std::back_inserter(vertices));
  return !faces.empty();
}

void write(const Mesh& mesh, TriangleMesh& out) {
  out.vertices.clear();
  out.triangles.clear();
  std::vector<std::uint32_t> number(mesh.number_of_vertices());
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    number[v] = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.push_back(place(mesh.point(v)));
  }
  for (const Mesh::Face_index f : mesh.faces()) {
    const Halfedge h = mesh.halfedge(f);
    std::array<std::uint32_t, 3> t{number[mesh.source(h)], number[mesh.target(h)], number[mesh.target(mesh.next(h))]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    out.triangles.push_back(t);
  }
  std::sort(out.triangles.begin(), out.triangles.end());
}

}  // namespace

HoleReport close_holes(TriangleMesh& mesh, std::span<const Vec3> outward, double gap, double hole_limit) {
  std::vector<Kernel::Point_3> points;
  points.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) points.emplace_back(v.x(), v.y(), v.z());
  std::vector<Polygon> polygons;
  polygons.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) polygons.push_back({t[0], t[1], t[2]});
  pmp::orient_polygon_soup(points, polygons);
  const std::vector<std::size_t> part = parts_of(points.size(), polygons);
  turn_outward(points, part, outward, polygons);
  Mesh surface;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, surface);

  HoleReport report;
  for (const Border& border : borders_of(surface, part)) {
    if (border.rim) continue;
    if (border.diameter <= gap && fill(surface, border.halfedge)) continue;
    ++report.holes;
    if (border.diameter <= hole_limit && fill(surface, border.halfedge))
      ++report.filled;
    else
      report.largest_left = std::max(report.largest_left, border.diameter);
  }
  write(surface, mesh);
  return report;
}

}  // namespace treadmark::scans
