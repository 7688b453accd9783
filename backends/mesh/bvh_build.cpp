// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "treadmark/backends/mesh/bvh.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::mesh {

namespace {

constexpr std::uint32_t kLeaf = 4;             ///< triangles in a leaf
constexpr std::uint32_t kTask = 16 * 1024;     ///< triangles of a subtree that one thread builds

/// Leaves are full but for the last one, so that the size of a subtree follows from its number of triangles.
std::uint32_t leaf_count(std::uint32_t triangles) { return (triangles + kLeaf - 1) / kLeaf; }
std::uint32_t left_count(std::uint32_t triangles) { return leaf_count(triangles) / 2 * kLeaf; }
std::uint32_t node_count(std::uint32_t triangles) { return 2 * leaf_count(triangles) - 1; }

}  // namespace

Bvh::Bvh(const PreparedMesh& mesh) : mesh_(mesh) {
  const auto n = static_cast<std::uint32_t>(mesh.triangles.size());
  nodes_.resize(node_count(n));
  order_.resize(n);
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<Vec3> middles(n);
  for (std::uint32_t t = 0; t < n; ++t)
    middles[t] =
        (mesh.vertices[mesh.triangles[t][0]] + mesh.vertices[mesh.triangles[t][1]] + mesh.vertices[mesh.triangles[t][2]]) / 3.0;

  // the upper levels first, then their subtrees side by side, then the boxes of the upper levels from below
  build(0, 0, n, middles, kTask);
  std::vector<std::uint32_t> tasks, upper;
  for (std::vector<std::uint32_t> open{0}; !open.empty();) {
    const std::uint32_t i = open.back();
    open.pop_back();
    if (nodes_[i].count <= kTask) {
      tasks.push_back(i);
      continue;
    }
    upper.push_back(i);
    open.push_back(i + 1);
    open.push_back(nodes_[i].right);
  }
  parallel_for(tasks.size(), [&](std::size_t k) { build(tasks[k], nodes_[tasks[k]].begin, nodes_[tasks[k]].count, middles, 0); });
  std::sort(upper.rbegin(), upper.rend());
  for (const std::uint32_t i : upper) close(i);
}

void Bvh::build(std::uint32_t node, std::uint32_t begin, std::uint32_t count, const std::vector<Vec3>& middles,
                std::uint32_t stop_at) {
  Node& self = nodes_[node];
  self.begin = begin;
  self.count = count;
  self.right = 0;
  if (count <= stop_at) return;
  if (count > kLeaf) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (std::uint32_t i = begin; i < begin + count; ++i) {
      low = low.cwiseMin(middles[order_[i]]);
      high = high.cwiseMax(middles[order_[i]]);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const std::uint32_t left = left_count(count);
    const auto first = order_.begin() + begin;
    std::nth_element(first, first + left, first + count, [&](std::uint32_t a, std::uint32_t b) {
      return middles[a][axis] != middles[b][axis] ? middles[a][axis] < middles[b][axis] : a < b;
    });
    self.right = node + 1 + node_count(left);
    build(node + 1, begin, left, middles, stop_at);
    build(self.right, begin + left, count - left, middles, stop_at);
  }
  if (stop_at == 0) close(node);
}

/// Box and normals of a node from its children or its triangles.
void Bvh::close(std::uint32_t node) {
  Node& self = nodes_[node];
  if (self.right != 0) {
    const Node &a = nodes_[node + 1], &b = nodes_[self.right];
    self.low = a.low.cwiseMin(b.low);
    self.high = a.high.cwiseMax(b.high);
    for (std::size_t k = 0; k < 3; ++k) {
      self.normal_low[k] = std::min(a.normal_low[k], b.normal_low[k]);
      self.normal_high[k] = std::max(a.normal_high[k], b.normal_high[k]);
    }
    return;
  }
  constexpr float kOutwards = 1e-6f;  // more than the rounding to float
  self.low = Vec3::Constant(std::numeric_limits<double>::infinity());
  self.high = -self.low;
  self.normal_low.fill(std::numeric_limits<float>::infinity());
  self.normal_high.fill(-std::numeric_limits<float>::infinity());
  for (std::uint32_t i = self.begin; i < self.begin + self.count; ++i) {
    for (const std::uint32_t v : mesh_.triangles[order_[i]]) {
      self.low = self.low.cwiseMin(mesh_.vertices[v]);
      self.high = self.high.cwiseMax(mesh_.vertices[v]);
    }
    const Vec3 n = doubled_area(mesh_, order_[i]).normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto component = static_cast<float>(n[static_cast<int>(k)]);
      self.normal_low[k] = std::min(self.normal_low[k], component - kOutwards);
      self.normal_high[k] = std::max(self.normal_high[k], component + kOutwards);
    }
  }
}

}  // namespace treadmark::mesh
