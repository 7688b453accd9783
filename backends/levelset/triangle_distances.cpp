// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/levelset/triangle_distances.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <unordered_map>

#include <fmt/format.h>

#include "treadmark/backends/levelset/block_index.hpp"
#include "treadmark/backends/offset/vdb_file.hpp"
#include "treadmark/core/check_point.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/helper_process.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::levelset {

namespace {

using Corners = std::array<std::uint32_t, 3>;
constexpr std::uint32_t kNone = ~0u;
constexpr double kCrease = 0.8660254037844387;  ///< cosine of 30 degrees, as of the smooth refinement of meshes

[[noreturn]] void refuse(const TriangleMesh& mesh, const std::string& why, const char* advice = "") {
  throw Error(ErrorKind::input_data, fmt::format("the mesh '{}' {}", mesh.name, why), {}, advice);
}

/// Triangles in voxels, with their neighbours and what is normal to them.
class Skin {
 public:
  Skin(const TriangleMesh& mesh, double voxel, std::optional<Body> body) {
    check(mesh, voxel);
    merge(mesh, voxel);
    connect(mesh);
    orient(body);
    find_normals();
  }

  struct Nearest {
    double distance = 0.0;  ///< signed [voxels]
    double rim = -kFarFromRim;
  };
  /// The distance of p from triangle t, which is nearest.
  Nearest nearest(const Vec3& p, std::uint32_t t) const;

  bool closed() const { return rim_edges_.empty(); }
  const std::vector<Vec3>& vertices() const { return vertices_; }
  const std::vector<Corners>& triangles() const { return triangles_; }

 private:
  void check(const TriangleMesh& mesh, double voxel) const;
  void merge(const TriangleMesh& mesh, double voxel);
  void connect(const TriangleMesh& mesh);
  void orient(std::optional<Body> body);
  void find_normals();
  void index_rim();
  double rim_distance(const Vec3& q) const;

  Vec3 side(std::uint32_t t, int k) const {  // opposite to corner k
    const Corners& c = triangles_[t];
    return vertices_[c[static_cast<std::size_t>((k + 2) % 3)]] - vertices_[c[static_cast<std::size_t>((k + 1) % 3)]];
  }

  std::vector<Vec3> vertices_;
  std::vector<Corners> triangles_;
  std::vector<std::array<std::uint32_t, 3>> neighbours_;  ///< over the side opposite to each corner
  std::vector<Vec3> faces_;                               ///< unit normals
  std::vector<std::array<Vec3, 3>> corners_;              ///< unit normals of the smooth surface at each corner
  std::vector<Vec3> vertex_sums_;                         ///< of the normals about a vertex, by their angles
  std::vector<char> on_rim_;                              ///< vertices
  std::vector<std::array<Vec3, 2>> rim_edges_;
  std::unordered_map<BlockIndex::Place, std::vector<std::uint32_t>, BlockIndex::Hash> rim_near_;
};

void Skin::check(const TriangleMesh& mesh, double voxel) const {
  if (mesh.triangles.empty()) refuse(mesh, "is empty");
  constexpr double kMost = 1 << 24;
  for (const Vec3& v : mesh.vertices)
    if (!v.allFinite()) refuse(mesh, "has a vertex that is not finite");
  for (const Corners& c : mesh.triangles)
    for (const std::uint32_t v : c) {
      if (v >= mesh.vertices.size()) refuse(mesh, "names a vertex that it does not have");
      if (!(mesh.vertices[v].cwiseAbs().maxCoeff() < 0.5 * kMost * voxel))
        refuse(mesh,
               fmt::format("reaches {:.4g} m from its origin, with voxels of {:.4g} mm",
                           mesh.vertices[v].cwiseAbs().maxCoeff(), 1e3 * voxel),
               "is it in metres? or choose greater voxels");
    }
}

/// Corners at the same place are one; triangles without area go.
void Skin::merge(const TriangleMesh& mesh, double voxel) {
  struct PlaceHash {
    std::size_t operator()(const std::array<double, 3>& p) const {
      std::uint64_t h = 0;
      for (const double x : p) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &x, sizeof(bits));
        h = (h ^ bits) * 0x9e3779b97f4a7c15ull, h ^= h >> 31;
      }
      return static_cast<std::size_t>(h);
    }
  };
  std::unordered_map<std::array<double, 3>, std::uint32_t, PlaceHash> known;
  known.reserve(mesh.vertices.size());
  std::vector<std::uint32_t> number(mesh.vertices.size());
  vertices_.reserve(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3& p = mesh.vertices[v];
    // + 0.0 makes one zero of both
    const auto [at, fresh] =
        known.try_emplace({p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}, static_cast<std::uint32_t>(vertices_.size()));
    if (fresh) vertices_.push_back(p / voxel);
    number[v] = at->second;
  }
  constexpr double kLong = 16.0, kMostCovered = 2.5e7;  // voxels, and their squares: some 5 GB while they are made
  double covered = 0.0;
  for (const Corners& c : mesh.triangles) {
    const Corners merged{number[c[0]], number[c[1]], number[c[2]]};
    const Vec3 a = vertices_[merged[1]] - vertices_[merged[0]], b = vertices_[merged[2]] - vertices_[merged[0]];
    constexpr double kFlat = 1e-12;
    const double area = 0.5 * a.cross(b).norm(),
                 longest = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
    if (!(area > kFlat * longest)) continue;
    triangles_.push_back(merged);
    // a sliver takes what is along it
    covered += std::max(area, longest > kLong * kLong ? std::sqrt(longest) : 0.0);
  }
  if (triangles_.empty()) refuse(mesh, "has only triangles without area");
  if (!(covered < kMostCovered))
    throw Error(ErrorKind::configuration,
                fmt::format("the mesh '{}' is {:.3g} m^2 large, too much for voxels of {:.4g} mm", mesh.name,
                            covered * voxel * voxel, 1e3 * voxel),
                {}, "is it in metres? or choose greater voxels, or a smaller region");
}

void Skin::connect(const TriangleMesh& mesh) {
  struct Edge {
    std::uint64_t ends;
    std::uint32_t triangle;
    int side;
    bool forwards;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * triangles_.size());
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles_[t][static_cast<std::size_t>((k + 1) % 3)],
                          b = triangles_[t][static_cast<std::size_t>((k + 2) % 3)];
      edges.push_back({std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), t, k, a < b});
    }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.ends != b.ends ? a.ends < b.ends : a.triangle < b.triangle; });
  neighbours_.assign(triangles_.size(), {kNone, kNone, kNone});
  const auto place = [&](const Edge& e) {
    const Vec3& p = vertices_[static_cast<std::uint32_t>(e.ends)];
    return fmt::format("({:.6g}, {:.6g}, {:.6g}) voxels", p.x(), p.y(), p.z());
  };
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].ends == edges[i].ends) ++end;
    if (end - i > 2)
      refuse(mesh, fmt::format("has an edge of {} triangles at {}", end - i, place(edges[i])),
             "repair it in a mesh program");
    if (end - i == 2) {
      if (edges[i].forwards == edges[i + 1].forwards)
        refuse(mesh, fmt::format("has neighbours that do not agree on the outside at {}", place(edges[i])),
               "turn its triangles in a mesh program");
      neighbours_[edges[i].triangle][static_cast<std::size_t>(edges[i].side)] = edges[i + 1].triangle;
      neighbours_[edges[i + 1].triangle][static_cast<std::size_t>(edges[i + 1].side)] = edges[i].triangle;
    }
    i = end;
  }
}

/// Closed triangles enclose a positive volume; most of open ones face away from the axle, or up. Those that are left of
/// a closed body face all ways: they enclose what they enclosed.
void Skin::orient(std::optional<Body> body) {
  constexpr double kDecisive = 1e-3;
  double volume = 0.0, outwards = 0.0, all = 0.0;
  bool open = false;
  const Vec3& base = vertices_[triangles_[0][0]];
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    for (const std::uint32_t n : neighbours_[t]) open = open || n == kNone;
    const Corners& c = triangles_[t];
    const Vec3 &p = vertices_[c[0]], area = (vertices_[c[1]] - p).cross(vertices_[c[2]] - p);
    volume += (p - base).dot(area);
    const double facing = body == Body::wheel ? area.dot(Vec3(p.x(), 0.0, p.z()).normalized()) : -area.z();
    outwards += facing, all += std::fabs(facing);
  }
  if (open && !body) return;
  if (!((open && std::fabs(outwards) > kDecisive * all ? outwards : volume) < 0.0)) return;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    std::swap(triangles_[t][1], triangles_[t][2]);
    std::swap(neighbours_[t][1], neighbours_[t][2]);
  }
}

void Skin::find_normals() {
  const std::size_t count = triangles_.size();
  faces_.resize(count);
  std::vector<std::array<double, 3>> angles(count);
  vertex_sums_.assign(vertices_.size(), Vec3::Zero());
  on_rim_.assign(vertices_.size(), 0);
  std::vector<std::uint32_t> first(vertices_.size() + 1, 0), around(3 * count);
  for (std::uint32_t t = 0; t < count; ++t) {
    const Corners& c = triangles_[t];
    faces_[t] = side(t, 2).cross(-side(t, 1)).normalized();
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const Vec3 a = -side(t, (k + 1) % 3), b = side(t, (k + 2) % 3);
      angles[t][at] = std::atan2(a.cross(b).norm(), a.dot(b));
      vertex_sums_[c[at]] += angles[t][at] * faces_[t];
      ++first[c[at] + 1];
      if (neighbours_[t][at] != kNone) continue;
      const std::uint32_t from = c[(at + 1) % 3], to = c[(at + 2) % 3];
      on_rim_[from] = on_rim_[to] = 1;
      rim_edges_.push_back({vertices_[from], vertices_[to]});
    }
  }
  for (std::size_t v = 0; v < vertices_.size(); ++v) first[v + 1] += first[v];
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t t = 0; t < count; ++t)
    for (const std::uint32_t v : triangles_[t]) around[next[v]++] = t;
  corners_.resize(count);
  parallel_blocks(count, 1 << 12, [&](std::size_t from, std::size_t to) {
    for (std::size_t t = from; t < to; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = triangles_[t][k];
        Vec3 sum = Vec3::Zero();
        for (std::uint32_t i = first[v]; i < first[v + 1]; ++i) {
          const std::uint32_t other = around[i];
          if (faces_[other].dot(faces_[t]) < kCrease) continue;
          for (std::size_t m = 0; m < 3; ++m)
            if (triangles_[other][m] == v) sum += angles[other][m] * faces_[other];
        }
        corners_[t][k] = sum.normalized();
      }
  });
  index_rim();
}

constexpr double kRimCell = kFarFromRim;  ///< edge of the cells in which edges of the rim are looked for [voxels]

BlockIndex::Place rim_cell(const Vec3& p) {
  return {to_whole<std::int32_t>(std::floor(p.x() / kRimCell)), to_whole<std::int32_t>(std::floor(p.y() / kRimCell)),
          to_whole<std::int32_t>(std::floor(p.z() / kRimCell))};
}

/// Each edge stands in all cells from which it may be nearer than a cell's edge.
void Skin::index_rim() {
  CheckPoint check;
  for (std::uint32_t e = 0; e < rim_edges_.size(); ++e) {
    check.pass();
    const auto& [a, b] = rim_edges_[e];
    const int pieces = to_whole<int>(std::ceil(2.0 * (b - a).norm() / kRimCell)) + 1;
    for (int i = 0; i <= pieces; ++i) {
      const BlockIndex::Place at = rim_cell(a + (b - a) * i / pieces);
      for (int k = 0; k < 27; ++k) {
        auto& here = rim_near_[{at[0] + k / 9 - 1, at[1] + k / 3 % 3 - 1, at[2] + k % 3 - 1}];
        if (here.empty() || here.back() != e) here.push_back(e);
      }
    }
  }
}

/// Of a place within, at most kFarFromRim.
double Skin::rim_distance(const Vec3& q) const {
  double nearest = kFarFromRim;
  const auto found = rim_near_.find(rim_cell(q));
  if (found == rim_near_.end()) return nearest;
  for (const std::uint32_t e : found->second) {
    const auto& [a, b] = rim_edges_[e];
    const double s = std::clamp((q - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (q - a - s * (b - a)).norm());
  }
  return nearest;
}

/// Barycentric weights of the point of a triangle that is nearest to p (Ericson 2005).
Vec3 nearest_weights(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {1.0 - d1 / (d1 - d3), d1 / (d1 - d3), 0.0};
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {1.0 - d2 / (d2 - d6), 0.0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0.0, 1.0 - w, w};
  }
  const double all = va + vb + vc;
  return {va / all, vb / all, vc / all};
}

Skin::Nearest Skin::nearest(const Vec3& p, std::uint32_t t) const {
  const Corners& c = triangles_[t];
  const std::array<Vec3, 3> v{vertices_[c[0]], vertices_[c[1]], vertices_[c[2]]};
  const Vec3 w = nearest_weights(v[0], v[1], v[2], p);
  const Vec3 q = w[0] * v[0] + w[1] * v[1] + w[2] * v[2], away = p - q;
  const auto& n = corners_[t];
  const Vec3 smooth = (w[0] * n[0] + w[1] * n[1] + w[2] * n[2]).normalized();
  // the face, edge or corner that is nearest, and whether the surface is smooth there
  constexpr double kOne = 1.0 - 1e-9;
  Vec3 normal = faces_[t];
  bool rim = false, crease = false;
  const int zeros = (w[0] == 0.0) + (w[1] == 0.0) + (w[2] == 0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = w[static_cast<Eigen::Index>(k)];
    if (zeros == 1 && weight == 0.0) {
      const std::uint32_t other = neighbours_[t][k];
      rim = other == kNone;
      if (!rim) normal += faces_[other], crease = faces_[t].dot(faces_[other]) < kCrease;
    }
    if (zeros == 2 && weight != 0.0) {
      normal = vertex_sums_[c[k]];
      rim = on_rim_[c[k]] != 0;
      crease = n[k].dot(normal) < kOne * normal.norm();
    }
  }
  // over the triangle the smooth surface is a paraboloid, whose normals at the corners are known (Nagata 2005)
  double over = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    over += 0.5 * w[static_cast<Eigen::Index>(i)] * w[static_cast<Eigen::Index>(j)] * (n[j] - n[i]).dot(v[j] - v[i]);
  }
  Nearest found;
  if (rim) {
    const double height = away.dot(smooth);
    found.distance = height - over;
    found.rim = std::min(static_cast<double>(kFarFromRim), (away - height * smooth).norm());
    return found;
  }
  found.distance = (crease ? std::copysign(away.norm(), away.dot(normal)) : away.dot(smooth)) - over;
  found.rim = rim_edges_.empty() ? -kFarFromRim : -rim_distance(q);
  return found;
}

/// By OpenVDB, of nodes in a band about the triangles.
std::vector<offset::NearestBlock> nearest_triangles(const Skin& skin, const TriangleMesh& mesh) {
  constexpr int kLongestSilence = 3600;  // [s]
  const std::vector<Corners>& corners = skin.triangles();
  std::unique_ptr<Channel> channel = offset::start_openvdb(mesh.name, kLongestSilence);
  std::string fault;
  std::vector<offset::NearestBlock> found;
  talk_to(
      channel,
      [&](Channel& c) {
        c.put(offset::VdbTask::nearest);
        c.put_list(skin.vertices());
        c.put_list(corners);
        c.put(kHalfWidth);
        c.put(static_cast<std::int64_t>(thread_count()));
        fault = c.take_list<std::string>();
        if (fault.empty()) found = c.take_list<std::vector<offset::NearestBlock>>();
      },
      [&] {
        return Error(ErrorKind::configuration, fmt::format("OpenVDB broke down over the mesh '{}'", mesh.name), {},
                     "is there enough memory? take larger voxels");
      });
  if (!fault.empty()) refuse(mesh, fault);
  return found;
}

}  // namespace

TriangleDistances distances_of(const TriangleMesh& mesh, double voxel, std::optional<Body> body) {
  const Skin skin(mesh, voxel, body);
  const std::vector<offset::NearestBlock> found = nearest_triangles(skin, mesh);
  TriangleDistances out;
  out.closed = skin.closed();
  out.grid.name = mesh.name;
  out.grid.voxel = voxel;
  out.grid.blocks.resize(found.size());
  if (!out.closed) out.rim.resize(found.size());
  parallel_blocks(found.size(), kBlocksAtOnce, [&](std::size_t from, std::size_t to) {
    for (std::size_t b = from; b < to; ++b) {
      DistanceGrid::Block& block = out.grid.blocks[b];
      block.first = found[b].first;
      std::vector<float> rim(DistanceGrid::kNodes, -kFarFromRim);
      bool near_rim = false;
      for (int node = 0; node < DistanceGrid::kNodes; ++node) {
        const auto at = static_cast<std::size_t>(node);
        if (found[b].triangle[at] < 0) continue;
        const Vec3 p(block.first[0] + (node >> 6), block.first[1] + (node >> 3 & 7), block.first[2] + (node & 7));
        const Skin::Nearest nearest = skin.nearest(p, static_cast<std::uint32_t>(found[b].triangle[at]));
        block.value[at] = static_cast<float>(nearest.distance);
        block.known[static_cast<std::size_t>(node >> 6)] |= std::uint64_t{1} << (node & 63);
        rim[at] = static_cast<float>(nearest.rim);
        near_rim = near_rim || nearest.rim > -kFarFromRim;
      }
      if (near_rim) out.rim[b] = std::move(rim);
    }
  });
  return out;
}

}  // namespace treadmark::levelset
