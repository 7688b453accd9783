// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "treadmark/backends/mesh/bvh.hpp"
#include "treadmark/core/check_point.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parallel_blocks.hpp"

namespace treadmark::mesh {

namespace {

constexpr std::uint32_t kLeaf = 4;          ///< triangles in a leaf
constexpr float kOutwards = 1e-6f;          ///< of a normal: more than its rounding to float
constexpr std::uint32_t kTask = 16 * 1024;  ///< triangles of a subtree that one thread builds
constexpr std::size_t kBlock = 1 << 14;     ///< triangles, vertices or nodes that one thread does alike

/// Leaves are full but for the last one, so that the size of a subtree follows from its number of triangles.
std::uint32_t leaf_count(std::uint32_t triangles) { return (triangles + kLeaf - 1) / kLeaf; }
std::uint32_t left_count(std::uint32_t triangles) { return leaf_count(triangles) / 2 * kLeaf; }
std::uint32_t node_count(std::uint32_t triangles) { return 2 * leaf_count(triangles) - 1; }

/// Triangle i becomes what order[i] was; vertices are numbered as triangles name them first.
void reorder(PreparedMesh& mesh, const std::vector<Bvh::Middle>& order) {
  const std::size_t n = order.size();
  std::vector<std::uint32_t> place(n), vertex(mesh.vertices.size(), kNone), from;
  parallel_blocks(n, kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) place[order[i].triangle] = static_cast<std::uint32_t>(i);
  });
  from.reserve(mesh.vertices.size());
  CheckPoint check;
  for (std::size_t i = 0; i < n; ++i) {
    check.pass();
    for (const std::uint32_t v : mesh.triangles[order[i].triangle])
      if (vertex[v] == kNone) {
        vertex[v] = static_cast<std::uint32_t>(from.size());
        from.push_back(v);
      }
  }
  std::vector<Corners> triangles(n), neighbours(n);
  std::vector<Vec3> vertices(from.size());
  parallel_blocks(n, kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t across = mesh.neighbours[order[i].triangle][k];
        triangles[i][k] = vertex[mesh.triangles[order[i].triangle][k]];
        neighbours[i][k] = across == kNone ? kNone : place[across];
      }
  });
  parallel_blocks(from.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) vertices[v] = mesh.vertices[from[v]];
  });
  mesh.triangles = std::move(triangles);
  mesh.neighbours = std::move(neighbours);
  mesh.vertices = std::move(vertices);
}

}  // namespace

Bvh::Bvh(PreparedMesh& mesh) : mesh_(mesh) {
  const auto n = static_cast<std::uint32_t>(mesh.triangles.size());
  nodes_.resize(node_count(n));
  std::vector<Middle> middles(n);
  parallel_blocks(n, kBlock, [&](std::size_t from, std::size_t to) {
    for (std::size_t t = from; t < to; ++t)
      middles[t] = {(mesh.vertices[mesh.triangles[t][0]] + mesh.vertices[mesh.triangles[t][1]] +
                     mesh.vertices[mesh.triangles[t][2]]) /
                        3.0,
                    static_cast<std::uint32_t>(t)};
  });

  // the upper levels first, then their subtrees side by side, then the boxes of the upper levels from below
  nodes_[0].begin = 0;
  nodes_[0].count = n;
  std::vector<std::uint32_t> tasks, upper, level{0}, next;
  for (; !level.empty(); level = std::exchange(next, {})) {
    parallel_for(level.size(), [&](std::size_t k) {
      if (nodes_[level[k]].count > kTask) split(level[k], middles);
    });
    for (const std::uint32_t i : level) {
      const bool small = nodes_[i].count <= kTask;
      (small ? tasks : upper).push_back(i);
      if (!small) next.insert(next.end(), {i + 1, nodes_[i].right});
    }
  }
  parallel_for(tasks.size(), [&](std::size_t k) { split_below(tasks[k], middles); });
  reorder(mesh, middles);
  middles = {};
  parallel_for(tasks.size(), [&](std::size_t k) { close_below(tasks[k]); });
  std::sort(upper.rbegin(), upper.rend());
  for (const std::uint32_t i : upper) close(i);
}

/// Halves a node that is no leaf.
void Bvh::split(std::uint32_t node, std::vector<Middle>& middles) {
  Node& self = nodes_[node];
  const auto first = middles.begin() + self.begin, end = first + self.count;
  if (self.count > kTask) check_cancelled();
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (auto it = first; it != end; ++it) {
    low = low.cwiseMin(it->at);
    high = high.cwiseMax(it->at);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t left = left_count(self.count);
  std::nth_element(first, first + left, end, [axis](const Middle& a, const Middle& b) {
    return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.triangle < b.triangle;
  });
  self.right = node + 1 + node_count(left);
  nodes_[node + 1].begin = self.begin;
  nodes_[node + 1].count = left;
  nodes_[self.right].begin = self.begin + left;
  nodes_[self.right].count = self.count - left;
}

void Bvh::split_below(std::uint32_t node, std::vector<Middle>& middles) {
  nodes_[node].right = 0;
  if (nodes_[node].count <= kLeaf) return;
  split(node, middles);
  split_below(node + 1, middles);
  split_below(nodes_[node].right, middles);
}

void Bvh::close_below(std::uint32_t node) {
  if (nodes_[node].right != 0) {
    close_below(node + 1);
    close_below(nodes_[node].right);
  }
  close(node);
}

/// The direction in which the triangles of a node are thinnest, about: the slab perpendicular to their mean normal.
void Bvh::add_slab(Node& node) const {
  constexpr std::uint32_t kLargest = 4096;  ///< triangles of a node that is worth it
  std::fill_n(node.slab_normal, 3, 0.0f);
  node.slab_low = node.slab_high = node.margin = 0.0f;
  if (node.count > kLargest) return;
  Vec3 normal = Vec3::Zero();
  for (std::uint32_t i = node.begin; i < node.begin + node.count; ++i) normal += doubled_area(mesh_, i);
  const double length = normal.norm();
  if (!(length > 0.0)) return;
  for (int k = 0; k < 3; ++k)
    normal[k] = static_cast<double>(node.slab_normal[k] = static_cast<float>(normal[k] / length));
  const Vec3 middle(node.middle[0], node.middle[1], node.middle[2]);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::uint32_t i = node.begin; i < node.begin + node.count; ++i)
    for (const std::uint32_t v : mesh_.triangles[i]) {
      const double at = normal.dot(mesh_.vertices[v] - middle);
      low = std::min(low, at);
      high = std::max(high, at);
    }
  constexpr double kRounding = 1e-7;  // of a float, and more
  node.slab_low = static_cast<float>(low - kRounding * std::fabs(low) - kBoxRounding);
  node.slab_high = static_cast<float>(high + kRounding * std::fabs(high) + kBoxRounding);
}

/// Box and normals of a node from its children or its triangles.
void Bvh::close(std::uint32_t number) {
  Node& node = nodes_[number];
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  std::fill_n(node.normal_low, 3, std::numeric_limits<float>::infinity());
  std::fill_n(node.normal_high, 3, -std::numeric_limits<float>::infinity());
  if (node.right != 0) {
    for (const Node* child : {&nodes_[number + 1], &nodes_[node.right]})
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], child->middle[k] - child->half[k]);
        high[k] = std::max(high[k], child->middle[k] + child->half[k]);
        node.normal_low[k] = std::min(node.normal_low[k], child->normal_low[k]);
        node.normal_high[k] = std::max(node.normal_high[k], child->normal_high[k]);
      }
  }
  for (std::uint32_t i = node.begin; node.right == 0 && i < node.begin + node.count; ++i) {
    for (const std::uint32_t v : mesh_.triangles[i]) {
      low = low.cwiseMin(mesh_.vertices[v]);
      high = high.cwiseMax(mesh_.vertices[v]);
    }
    const Vec3 n = doubled_area(mesh_, i).normalized();
    for (int k = 0; k < 3; ++k) {
      const auto component = static_cast<float>(n[k]);
      node.normal_low[k] = std::min(node.normal_low[k], component - kOutwards);
      node.normal_high[k] = std::max(node.normal_high[k], component + kOutwards);
    }
  }
  for (int k = 0; k < 3; ++k) {
    node.middle[k] = 0.5 * (low[k] + high[k]);
    node.half[k] = 0.5 * (high[k] - low[k]);
  }
  add_slab(node);
}

void Bvh::add_surface(const std::function<About(std::uint32_t)>& about) {
  about_.resize(mesh_.triangles.size());
  const auto widen = [](Node& node, std::size_t k, float low, float high) {
    node.normal_low[k] = std::min(node.normal_low[k], low);
    node.normal_high[k] = std::max(node.normal_high[k], high);
  };
  parallel_blocks(nodes_.size(), kBlock, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      Node& node = nodes_[i];
      if (node.right != 0) continue;
      for (std::uint32_t t = node.begin; t < node.begin + node.count; ++t) {
        const About surface = about(t);
        about_[t][0] = std::nextafter(static_cast<float>(surface.distance), std::numeric_limits<float>::infinity());
        node.margin = std::max(node.margin, about_[t][0]);
        for (std::size_t k = 0; k < 3; ++k) {
          const float component = about_[t][k + 1] = static_cast<float>(surface.normal[static_cast<int>(k)]);
          widen(node, k, component - kOutwards, component + kOutwards);
        }
      }
    }
  });
  CheckPoint check;
  for (std::size_t i = nodes_.size(); i-- > 0;) {  // children come behind
    check.pass();
    Node& node = nodes_[i];
    if (node.right == 0) continue;
    for (const Node* child : {&nodes_[i + 1], &nodes_[node.right]}) {
      node.margin = std::max(node.margin, child->margin);
      for (std::size_t k = 0; k < 3; ++k) widen(node, k, child->normal_low[k], child->normal_high[k]);
    }
  }
}

}  // namespace treadmark::mesh
